"""The table of all cueing methods. To add one, write its module and put its name here."""

from collections.abc import Mapping
from importlib import import_module

from .method import Method

_MODULES = (
    "attitude",
    "blend",
    "force",
    "perceptual",
    "hedge",
    "classical",
    "still",
    "preview",
)

METHODS: Mapping[str, Method] = {
    name: import_module(f".{name}", __package__).METHOD for name in _MODULES
}
CAUSAL_METHODS = tuple(name for name, method in METHODS.items() if not method.needs_flight)
"""The methods that need the past alone, so that they fly anywhere."""

DEFAULT_METHOD = "hedge"
