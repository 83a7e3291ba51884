"""Property tests judge results, never speed.

A busy machine is no failure, and the same code has the same examples.

Others are searched for with `pytest --hypothesis-profile search`.
"""

import pytest
from hypothesis import HealthCheck, settings

pytest_plugins = ["short_scenario"]

settings.register_profile("search", deadline=None, suppress_health_check=[HealthCheck.too_slow])
settings.register_profile("steady", settings.get_profile("search"), derandomize=True)
settings.load_profile("steady")

# takes minutes, and the other processes of `-n` have enough to do meanwhile
FIRST = "test_compiled.py"


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Begin with what takes longest, so that nobody waits for it alone at the end."""
    items.sort(key=lambda item: item.path.name != FIRST)
