"""From a log to a verdict, a picture and a comparison, by arithmetic of its own."""

from .checks.plant_topics import plant_notes
from .comparison import Comparison, compare_logs
from .cue_again import cue_again
from .finding import Finding
from .flight_alone import FlightReview, is_flight_alone, review_flight
from .recorded_run import RecordedRun, open_log, open_run, run_of
from .recovery import Recovered, advice, recover_log
from .verdict import Review, judge, review_log

__all__ = [
    "Comparison",
    "Finding",
    "FlightReview",
    "RecordedRun",
    "Recovered",
    "Review",
    "advice",
    "compare_logs",
    "cue_again",
    "is_flight_alone",
    "judge",
    "open_log",
    "open_run",
    "plant_notes",
    "recover_log",
    "review_flight",
    "review_log",
    "run_of",
]
