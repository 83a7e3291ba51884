"""Figures of a run, computed from its logged columns, in one pass."""

from .consistency import Consistency, consistency, reintegrate
from .deviation import vehicle_attitude
from .engaged_segment import engaged_segment
from .limit_use import LimitUse, limit_use, violations
from .metrics import Metrics, metrics
from .run_columns import BLOCK_TICKS, Columns, RunColumns, gathered

__all__ = [
    "BLOCK_TICKS",
    "Columns",
    "Consistency",
    "LimitUse",
    "Metrics",
    "RunColumns",
    "consistency",
    "engaged_segment",
    "gathered",
    "limit_use",
    "metrics",
    "reintegrate",
    "vehicle_attitude",
    "violations",
]
