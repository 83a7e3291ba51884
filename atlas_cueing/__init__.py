"""Washout-free motion cueing for platforms of unbounded rotation.

JSBSim, recorded or made-up motion in, wheel velocity profiles out. What there is for Python:

    load_scenario(file, settings)    a Scenario: what flies, how it is cued, on which platform
    load_platform(name_or_file)      a Platform: geometry, limits, the rider's head, masses
    run_scenario(scenario, log)      fly it into a log, with figures: a RunResult
    build_pipeline(scenario, dt)     a Pipeline to step by oneself: cueing, smoothing, wheels
    read_log(log)                    a Log: columns as numpy arrays, or pandas data frames
    review_log(log)                  a Review: a log judged by arithmetic of its own
    evaluate_log(log, platform)      an Evaluation: figures and violations of a log
    platform_loads(platform, ...)    Loads: forces, torques and power of states

Pipeline, VehicleState, Cue and Motion are what flows. SI and radians throughout; frames are in
the names: q_WS turns vectors of the cabin (S) into the platform's (W); B is the vehicle's body,
forward-right-down; N is north-east-down. Bad input raises an `AtlasError` of `atlas_cueing.errors`
that names file, key, value and what is allowed. Each name is imported when it is first used.
"""

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .loads import platform_loads as platform_loads
    from .pipeline import Pipeline as Pipeline
    from .recording import read_log as read_log
    from .review import review_log as review_log
    from .run import build_pipeline as build_pipeline
    from .run import evaluate_log as evaluate_log
    from .run import run_scenario as run_scenario
    from .scenario import load_platform as load_platform
    from .scenario import load_scenario as load_scenario
    from .signals import Cue as Cue
    from .signals import Motion as Motion
    from .signals import VehicleState as VehicleState

_PUBLIC = {  # name to where it is
    "Cue": "signals",
    "Motion": "signals",
    "Pipeline": "pipeline",
    "VehicleState": "signals",
    "build_pipeline": "run",
    "evaluate_log": "run",
    "load_platform": "scenario",
    "load_scenario": "scenario",
    "platform_loads": "loads",
    "read_log": "recording",
    "review_log": "review",
    "run_scenario": "run",
}


def __getattr__(name: str) -> Any:
    """Look up `__version__`, `__all__` and the public names when they are asked for.

    Loading them all takes a second, and importlib.metadata a third of --help.
    """
    if name in _PUBLIC:
        from importlib import import_module

        return getattr(import_module(f"{__name__}.{_PUBLIC[name]}"), name)
    if name == "__all__":
        return [*_PUBLIC]
    if name != "__version__":
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from importlib.metadata import version

    return version("atlas_cueing")


def __dir__() -> list[str]:
    return [*globals(), *_PUBLIC, "__version__"]
