"""Figures of a run, computed from its logged columns."""

from .consistency import consistency, reintegrate
from .deviation import vehicle_attitude
from .flight import Columns, Flight
from .limits import limit_use, violations
from .metrics import metrics
from .ridden import ridden

__all__ = [
    "Columns",
    "Flight",
    "consistency",
    "limit_use",
    "metrics",
    "reintegrate",
    "ridden",
    "vehicle_attitude",
    "violations",
]
