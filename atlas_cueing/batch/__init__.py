"""Runs without a clock: a scenario goes in, a finished log and its figures come out."""

from .output import check_output
from .run import RunResult, run_scenario

__all__ = ["RunResult", "check_output", "run_scenario"]
