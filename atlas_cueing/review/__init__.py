"""From a log to a verdict, a picture and a comparison, by arithmetic of its own."""

from .comparison import Comparison, compare
from .cue_again import recue
from .finding import Finding
from .recorded_run import RecordedRun, open_log, open_run
from .recovery import Recovered, advice, recover
from .verdict import Review, judge, review

__all__ = [
    "Comparison",
    "Finding",
    "RecordedRun",
    "Recovered",
    "Review",
    "advice",
    "compare",
    "judge",
    "open_log",
    "open_run",
    "recover",
    "recue",
    "review",
]
