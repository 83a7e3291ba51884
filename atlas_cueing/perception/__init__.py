"""What a head makes of motion: the organs of balance, and the perception built upon them.

It knows neither vehicles nor cabins: specific force and angular rate go in, in axes fixed in the
head. `vestibular` has the organs' transfer functions, for whole signals at once; `canals` the same
canals tick by tick; `observer` what is perceived of tilt and turn.
"""

from .canals import Canals
from .observer import OBSERVER, Observer, ObserverParameters
from .vestibular import CANALS, OTOLITHS, Organ, Sensing

__all__ = [
    "CANALS",
    "OBSERVER",
    "OTOLITHS",
    "Canals",
    "Observer",
    "ObserverParameters",
    "Organ",
    "Sensing",
]
