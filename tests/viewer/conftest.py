from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from review.conftest import fly

from atlas_cueing.review import RecordedRun, open_run
from atlas_cueing.scenario import Platform, load_platform
from atlas_cueing.viewer.server import close_server, open_server

from .browsing import launched


@pytest.fixture(scope="session")
def run(tmp_path_factory: pytest.TempPathFactory) -> RecordedRun:
    """Six seconds in which everything moves."""
    return open_run(fly(tmp_path_factory.mktemp("viewer")))


@pytest.fixture(scope="session")
def log(run: RecordedRun) -> Path:
    return run.log.path


@pytest.fixture(scope="session")
def platform() -> Platform:
    return load_platform("atlas-2.9m")


@pytest.fixture
def server() -> Iterator[Any]:
    """A page that nobody looks at."""
    served = open_server(0)
    yield served
    close_server(served)


@pytest.fixture(scope="module")
def browser() -> Iterator[Any]:
    """Chromium without a window."""
    with launched() as chromium:
        yield chromium
