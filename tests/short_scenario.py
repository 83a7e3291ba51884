"""A flight of one second, for tests of what flies scenarios."""

from collections.abc import Callable
from pathlib import Path

import pytest

from atlas_cueing.scenario import Scenario, load_scenario

SCRIPT = """
name = "short"
duration_s = 1.0
[vehicle]
script = "c1722"
[platform]
preset = "atlas-2.9m"
[recording]
chunk_ticks = 16
"""

Load = Callable[..., Scenario]


@pytest.fixture
def load(tmp_path: Path) -> Load:
    """A scenario of one second with overrides."""

    def scenario(*overrides: str) -> Scenario:
        (tmp_path / "s.toml").write_text(SCRIPT)
        return load_scenario(tmp_path / "s.toml", overrides)

    return scenario
