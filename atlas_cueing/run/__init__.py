"""TO WRITE."""

from .build import build_pipeline, prepare
from .evaluate import Evaluation, Evaluator, evaluate_flight, evaluate_log
from .fly import run_scenario
from .output import PAGE, check_output
from .result import LiveFigures, RunResult
from .stop_request import StopRequest

__all__ = [
    "PAGE",
    "Evaluation",
    "Evaluator",
    "LiveFigures",
    "RunResult",
    "StopRequest",
    "build_pipeline",
    "check_output",
    "evaluate_flight",
    "evaluate_log",
    "prepare",
    "run_scenario",
]
