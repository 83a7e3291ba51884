"""Puts a run together from a scenario: vehicle, pipeline, recorder, evaluation.

The composition root that run, batch, live and review have in common.
"""

from .build import build_pipeline, prepare
from .evaluate import Evaluation, Evaluator, evaluate_flight, evaluate_log
from .fly import run_scenario
from .load_promises import broken_promises
from .open_recorder import PACKAGES, open_recorder
from .open_vehicle import flight_length, open_vehicle
from .output import PAGE, Kind, check_output
from .result import METHOD_FAILED, LiveFigures, RunResult
from .stop_request import StopRequest
from .ticks import ticks

__all__ = [
    "METHOD_FAILED",
    "PACKAGES",
    "PAGE",
    "Evaluation",
    "Evaluator",
    "Kind",
    "LiveFigures",
    "RunResult",
    "StopRequest",
    "broken_promises",
    "build_pipeline",
    "check_output",
    "evaluate_flight",
    "evaluate_log",
    "flight_length",
    "open_recorder",
    "open_vehicle",
    "prepare",
    "run_scenario",
    "ticks",
]
