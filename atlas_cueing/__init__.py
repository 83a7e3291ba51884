"""Washout-free motion cueing for platforms of unbounded rotation.

JSBSim in, wheel velocity profiles out.
"""


def __getattr__(name: str) -> str:
    """Look up `__version__` when it is asked for.

    importlib.metadata takes as long to load as a third of --help.
    """
    if name != "__version__":
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from importlib.metadata import version

    return version("atlas_cueing")
