"""The real-time loop: the same pipeline against the clock, from a simulator to the drives.

    source -> supervisor, ride (states, courses, pipeline) -> guard -> set points, ring -> recorder,
    viewer, Foxglove

Nothing behind the ring can hold the loop up; nothing before the guard can move the platform beyond
its limits.
"""
