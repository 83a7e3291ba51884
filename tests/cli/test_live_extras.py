"""The key of a sender of set points."""

import os
import tracemalloc
from contextlib import AbstractContextManager
from pathlib import Path
from threading import Thread
from typing import Any

import pytest

from atlas_cueing.cli.live_extras import drives as drives_of
from atlas_cueing.errors import InputError
from atlas_cueing.live.input.shared_key import LARGEST_KEY
from atlas_cueing.scenario import load_scenario

HERE = "127.0.0.1:5600"
SCENARIO = Path(__file__).parents[2] / "scenarios/signal_sway.toml"


def drives(address: str, key: Path) -> AbstractContextManager[Any]:
    return drives_of(address, key, load_scenario(SCENARIO), listen=True)


def test_a_file_of_the_largest_size_will_do(tmp_path: Path) -> None:
    """What is around the key does not count."""
    (tmp_path / "key").write_bytes(b"k" * 32 + b"\n" * (LARGEST_KEY - 32))
    with drives(HERE, tmp_path / "key") as (senders, _):
        assert len(senders) == 1


@pytest.mark.parametrize("size", [LARGEST_KEY + 1, 256 * 2**20])
def test_a_key_that_is_too_large_is_not_read(size: int, tmp_path: Path) -> None:
    with (tmp_path / "key").open("wb") as file:
        file.truncate(size)
    tracemalloc.start()
    try:
        with (
            pytest.raises(InputError, match=r"--key .*key: too large, allowed: size <= 4096 bytes"),
            drives(HERE, tmp_path / "key"),
        ):
            pytest.fail("nobody is to be driven")
        assert tracemalloc.get_traced_memory()[1] < 2**20
    finally:
        tracemalloc.stop()


def test_a_key_that_never_ends(tmp_path: Path) -> None:
    """Whoever writes it into the pipe is cut off: of 64 MB, only what a pipe holds was taken."""
    os.mkfifo(tmp_path / "key")
    written = []

    def write() -> None:
        with (tmp_path / "key").open("wb", buffering=0) as pipe:
            try:
                written.extend(pipe.write(bytes(65536)) for _ in range(1024))
            except BrokenPipeError:
                written.append(0)

    writer = Thread(target=write, daemon=True)
    writer.start()
    with pytest.raises(InputError, match="too large"), drives(HERE, tmp_path / "key"):
        pytest.fail("nobody is to be driven")
    writer.join(timeout=60.0)
    assert written[-1] == 0
    assert sum(written) < 2**20


@pytest.mark.parametrize(("content", "message"), [(b"", "holds no key"), (b" \n", "holds no key")])
def test_no_key(content: bytes, message: str, tmp_path: Path) -> None:
    (tmp_path / "key").write_bytes(content)
    with pytest.raises(InputError, match=message), drives(HERE, tmp_path / "key"):
        pytest.fail("nobody is to be driven")
