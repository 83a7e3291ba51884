"""Wheels laid out for what flights ask of them: searched over real motions, every tick of them.

layout          a symmetric layout in a few numbers, and the platform that has it
ridden          what logs ask of the sphere, whatever its wheels
measure         figures of a layout over them
objective       what a layout can be good at, and which of many are worth having
layout_search   mixtures of objectives, each by differential evolution
front           search, check at every tick, choice
spread          all cores or a cluster; what is done is kept
design_page     the picture
"""

from .design_page import design_page
from .front import Front, Rated, design_stamp, search_front
from .layout import Layout, layout_of, with_layout
from .layout_search import Problem
from .measure import has_rows
from .objective import OBJECTIVES, USUAL, check_objectives
from .ridden import FlightName, Ridden, log_files, read_flights
from .spread import Crew, Kept, spread
from .variation import ranges_of

__all__ = [
    "OBJECTIVES",
    "USUAL",
    "Crew",
    "FlightName",
    "Front",
    "Kept",
    "Layout",
    "Problem",
    "Rated",
    "Ridden",
    "check_objectives",
    "design_page",
    "design_stamp",
    "has_rows",
    "layout_of",
    "log_files",
    "ranges_of",
    "read_flights",
    "search_front",
    "spread",
    "with_layout",
]
