"""A decaying state carried from one row of a signal to the next."""

# mypyc: runs every tick


def carried(start: float, decay: float, added: list[float]) -> list[float]:
    """Return the states z' = decay z + x: the start, then one behind each x that is added."""
    state = start
    states = [state]
    for x in added:
        state = decay * state + x
        states.append(state)
    return states
