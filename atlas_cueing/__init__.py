"""Washout-free motion cueing for platforms of unbounded rotation.

JSBSim in, wheel velocity profiles out.
"""

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .loads import platform_loads as platform_loads
    from .scenario import load_platform as load_platform

_PUBLIC = {"load_platform": "scenario", "platform_loads": "loads"}  # name to where it is


def __getattr__(name: str) -> Any:
    """Look up `__version__` and the public functions when they are asked for.

    importlib.metadata takes as long to load as a third of --help.
    """
    if name in _PUBLIC:
        from importlib import import_module

        return getattr(import_module(f"{__name__}.{_PUBLIC[name]}"), name)
    if name != "__version__":
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from importlib.metadata import version

    return version("atlas_cueing")
