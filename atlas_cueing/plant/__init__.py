"""A simulated platform: a sphere on wheels that slip, sensors, and a loop that holds it.

It is apart from the pipeline, with which it shares rotations only, so that what it finds of a
log's schedule is a second opinion.
"""

from .attitude_loop import FEEDBACKS
from .fly_plant import PlantRun, fly_plant
from .plant_figures import DEFINITIONS, plant_figures
from .plant_log import write_plant_log
from .plant_settings import plant_table
from .real_time_plant import PLANT_ROW, RealTimePlant

__all__ = [
    "DEFINITIONS",
    "FEEDBACKS",
    "PLANT_ROW",
    "PlantRun",
    "RealTimePlant",
    "fly_plant",
    "plant_figures",
    "plant_table",
    "write_plant_log",
]
