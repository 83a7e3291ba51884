"""What makes two runs the same: everything that their logs depend on."""

from functools import cache
from hashlib import file_digest, sha256
from importlib.metadata import version
from pathlib import Path

from ..errors import InputError
from ..run import PACKAGES
from ..scenario import Scenario

# of the hash: 2^48, so that among a million runs two are mixed up with probability 0.002
_DIGITS = 12
_LONGEST_NAME = 60  # bytes of each readable part; file names end at 255


def run_id(scenario: Scenario) -> str:
    """Name and hash of a run, fit for a file name.

    A function of the resolved scenario, platform, script and versions.
    """
    flight = scenario.flight
    method = scenario.file.cueing.declaration
    names = _plain(flight.name)[:_LONGEST_NAME], _plain(method.name)[:_LONGEST_NAME]
    parts = _cut(scenario.name), *names
    own = {f"method/{key}": value.encode() for key, value in method.metadata().items()}
    large = {f"file/{name}": _file_hash(path) for name, path in flight.large_files().items()}
    return f"{'-'.join(parts)}-{digest(scenario.attachments() | large | own)[:_DIGITS]}"


def flight_id(scenario: Scenario) -> str:
    """Hash of what the vehicle does, which is the same for whatever rides it.

    A function of the vehicle's table, the duration and the files of the flight, each known by its
    place, size and time of change: for one batch, whose runs are checked by `run_id` as well.
    """
    flight, file = scenario.flight, scenario.file
    files = {**flight.files(), **flight.large_files()}
    parts = {f"file/{name}": _stamp(path) for name, path in files.items()}
    keys = repr((file.vehicle, file.duration_s, scenario.trust_models))
    return digest(parts | {"keys": keys.encode(errors="backslashreplace")})[:_DIGITS]


def _stamp(path: Path) -> bytes:
    try:
        found = path.stat()
    except OSError as error:
        raise InputError(f"{path}: cannot be read: {error.strerror}") from error
    return repr((path.resolve(), found.st_size, found.st_mtime_ns)).encode(errors="replace")


def _file_hash(path: Path) -> bytes:
    try:
        with path.open("rb") as file:
            return file_digest(file, "sha256").digest()
    except OSError as error:
        raise InputError(f"{path}: cannot be read: {error.strerror}") from error


def _cut(name: str) -> str:
    return name.encode()[:_LONGEST_NAME].decode(errors="ignore")


def digest(files: dict[str, bytes]) -> str:
    """Hash (hex) of files by name and of the versions here."""
    total = sha256()
    for name, content in sorted(
        (files | {f"version/{name}": _version(name) for name in PACKAGES}).items()
    ):
        total.update(f"{name}\0{len(content)}\0".encode())
        total.update(content)
    return total.hexdigest()


@cache
def _version(package: str) -> bytes:
    return version(package).encode()


def _plain(name: str) -> str:
    return "".join(c if c.isascii() and (c.isalnum() or c in "._-") else "_" for c in name)
