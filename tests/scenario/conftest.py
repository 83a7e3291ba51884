from collections.abc import Callable
from pathlib import Path

import pytest

from atlas_cueing.errors import ScenarioError
from atlas_cueing.scenario import load_scenario

Refused = Callable[..., list[str]]


@pytest.fixture
def refused(tmp_path: Path) -> Refused:
    """The mistakes of a scenario text, as lines without the folder."""

    def lines(text: str, *overrides: str) -> list[str]:
        path = tmp_path / "bad.toml"
        path.write_text(text)
        with pytest.raises(ScenarioError) as refusal:
            load_scenario(path, overrides)
        assert str(refusal.value) == "\n".join(str(mistake) for mistake in refusal.value.mistakes)
        return str(refusal.value).replace(f"{tmp_path}/", "").splitlines()

    return lines
