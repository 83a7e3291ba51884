"""Figures of a review and of a comparison for papers: SVG and PDF by matplotlib (extra `plot`).

Only the modules here know matplotlib.
"""

from .paper_figure import FIGURE_KINDS, check_plot, figure_kind
from .write_figure import write_comparison_figure, write_ride_figure

__all__ = [
    "FIGURE_KINDS",
    "check_plot",
    "figure_kind",
    "write_comparison_figure",
    "write_ride_figure",
]
