"""TO WRITE."""

from .build import build, prepare
from .evaluate import Evaluation, Evaluator, evaluate, evaluate_flight
from .fly import RunResult, run_scenario
from .output import PAGE, check_output
from .stop_request import Interrupt

__all__ = [
    "PAGE",
    "Evaluation",
    "Evaluator",
    "Interrupt",
    "RunResult",
    "build",
    "check_output",
    "evaluate",
    "evaluate_flight",
    "prepare",
    "run_scenario",
]
