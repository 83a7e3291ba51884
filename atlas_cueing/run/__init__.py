"""TO WRITE."""

from .build import build_pipeline, prepare
from .evaluate import Evaluation, Evaluator, evaluate_flight, evaluate_log
from .fly import RunResult, run_scenario
from .output import PAGE, check_output
from .stop_request import StopRequest

__all__ = [
    "PAGE",
    "Evaluation",
    "Evaluator",
    "RunResult",
    "StopRequest",
    "build_pipeline",
    "check_output",
    "evaluate_flight",
    "evaluate_log",
    "prepare",
    "run_scenario",
]
