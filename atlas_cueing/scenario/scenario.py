"""The scenario file, and the scenario that it becomes together with its platform."""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated, Any

import tomli_w
from pydantic import BeforeValidator

from ..cueing import DEFAULT_METHOD, needs_flight
from ..errors import InputError, StartError
from ..printable import is_name
from ..recording.recorder import MAX_CHUNK_TICKS
from ..vehicles import Flight
from ..vehicles.jsbsim.user_models import read_users
from .cueing_table import TABLES, CueingTable
from .mistakes import FileNamer, nearest
from .platform_file import Platform, presets
from .platform_name import NAME
from .tables import ScenarioTable, number, object_to, refuse, says, text, whole
from .vehicle_table import VehicleTable

# The other topics are what the run is evaluated from.
DISPENSABLE_TOPICS = ("/tf",)
_MOST_SKIPPED = 20  # topics; a log has eight
_LONGEST_DESCRIPTION = 2000  # characters; it goes into every log of a sweep
_LARGEST_MODEL = 8 << 20  # bytes, of a user's aircraft with all its files; it goes into every log
_SHORT = text(
    f"a text of at most {_LONGEST_DESCRIPTION} characters",
    lambda written: len(written) <= _LONGEST_DESCRIPTION,
)


def _known_preset(value: Any) -> str:
    if not isinstance(value, str) or value not in presets():
        raise refuse(f"a platform of the package; {nearest(str(value), presets())}")
    return value


def _dispensable(value: Any) -> str:
    if value not in DISPENSABLE_TOPICS:
        raise refuse(f"{', '.join(DISPENSABLE_TOPICS)}; a run is evaluated from the others")
    return str(value)


class PlatformChoice(ScenarioTable):
    """`[platform]`: exactly one of `preset` and `file`, which `load` checks.

    The file may be anywhere that the user may read, for it is data: a small regular file of checked
    numbers, or it is refused. Only what is a program, a script, has to lie in the scenario's
    folder.
    """

    preset: Annotated[
        Annotated[str, BeforeValidator(_known_preset)] | None, says("platform of the package")
    ] = None
    file: Annotated[
        Annotated[str, text("path of a platform file, from the scenario's folder", is_name)] | None,
        says("platform file of one's own"),
    ] = None


def _as_tuple(value: Any) -> Any:
    if not isinstance(value, list | tuple) or len(value) > _MOST_SKIPPED:
        raise refuse("a list of topics")
    return tuple(value)


class RecordingTable(ScenarioTable):
    """`[recording]`: ticks in one chunk of the log, and topics left out."""

    chunk_ticks: Annotated[
        int,
        whole(1, MAX_CHUNK_TICKS),
        says("ticks in one chunk of the log, which is what a killed run loses"),
    ] = 512
    skip: Annotated[
        tuple[Annotated[str, BeforeValidator(_dispensable)], ...],
        BeforeValidator(_as_tuple),
        says("topics that are left out of the log"),
    ] = ()


def _many_runs(_: Any) -> None:
    raise object_to(
        "a sweep stands for many runs; fly them with: atlas-cueing batch FILE -o FOLDER"
    )


class ScenarioFile(ScenarioTable):
    """A scenario file.

    Validate it with `context={"folder": ...}`, where a user's files are looked for.
    """

    name: Annotated[str, NAME, says("name of the run, and of its log")]
    description: Annotated[str, _SHORT, says("what it is for, in words")] = ""
    duration_s: Annotated[
        Annotated[float, number(0.0, 86400.0, above=True)] | None,
        says("end of the flight, at the latest"),
    ] = None
    vehicle: VehicleTable
    platform: PlatformChoice
    cueing: CueingTable = TABLES[DEFAULT_METHOD]()
    recording: RecordingTable = RecordingTable()
    sweep: Annotated[None, BeforeValidator(_many_runs)] = None  # `load_variants` takes it out


@dataclass(frozen=True, slots=True)
class Scenario:
    """A scenario: the file with every override in it, and its platform.

    It also knows the folder of the user's files.

    trust_models: whether a user's script or aircraft may be flown; without it everything but the
        flight can be had.
    source, name_platform: the scenario file, and which file a key of the platform came from, for
        messages.
    """

    file: ScenarioFile
    platform: Platform
    folder: Path
    trust_models: bool = False
    source: str = ""
    name_platform: FileNamer = field(default_factory=lambda: FileNamer("platform"), compare=False)

    @property
    def name(self) -> str:
        """Name, fit for a file name."""
        return self.file.name

    @property
    def flight(self) -> Flight:
        """What the vehicle flies without a clock.

        Raises InputError when that flies only live, or is a program that is not trusted.
        """
        flight = self.live_flight
        if flight.live_only:
            raise InputError(flight.live_only)
        return flight

    @property
    def needs_whole_flight(self) -> bool:
        """Whether the cueing has to know the whole flight before the first cue.

        A method that plans does, and one that looks ahead. Such a scenario cannot fly live.
        """
        return needs_flight(self.file.cueing.parameters())

    @property
    def live_flight(self) -> Flight:
        """What the vehicle flies in real time, whatever its source.

        Raises InputError for a program that is not trusted.
        """
        self._check_trust()
        return self._flight

    @property
    def _flight(self) -> Flight:
        return self.file.vehicle.flight(self.folder)

    def inputs(self) -> tuple[Path, ...]:
        """Return the files beside the scenario's own that it is made of; they may be missing."""
        flight, platform = self._flight, self.file.platform.file
        files = [] if platform is None else [self.folder / platform]
        files += self.file.cueing.files()
        return (*files, *flight.large_files().values(), *flight.files().values())

    @contextmanager
    def naming_file(self) -> Iterator[None]:
        """Around the start of a flight: a StartError gets the scenario file and the whole key."""
        try:
            yield
        except StartError as error:
            raise InputError(f"{self.source}: vehicle.{error}") from error

    def _check_trust(self) -> None:
        program = self.file.vehicle.program(self.folder)
        if program and not self.trust_models:
            kind, path = program
            raise InputError(
                f"{path}: this {kind} is not one of JSBSim's own, and it is a program; if you trust"
                " whoever wrote it, fly it with --trust-models"
            )

    def scenario_toml(self) -> str:
        """The scenario with all defaults written out.

        Its platform is `platform.toml`, and a user's script lies beside it.
        """
        table = _plain(self.file)
        table["vehicle"] = self.file.vehicle.portable(self.folder)
        table["platform"] = {"file": "platform.toml"}
        table["cueing"]["method"] = self.file.cueing.declaration.name
        return tomli_w.dumps(table)

    def platform_toml(self) -> str:
        """The platform with all defaults and overrides written out."""
        return tomli_w.dumps(_plain(self.platform))

    def attachments(self) -> dict[str, bytes]:
        """Files that fly this scenario again when put into one folder: path in it to content."""
        files = _read_all(self._flight.files())
        tables = {"scenario.toml": self.scenario_toml(), "platform.toml": self.platform_toml()}
        files |= self.file.cueing.declaration.files
        return files | {name: table.encode(errors="replace") for name, table in tables.items()}


def _plain(table: ScenarioTable) -> dict[str, Any]:
    """The table as TOML can hold it: keys without a value left out."""
    return table.model_dump(exclude_none=True)


def _read_all(files: dict[str, Path]) -> dict[str, bytes]:
    contents = {relative: read_users(path) for relative, path in files.items()}
    size = sum(map(len, contents.values()))
    if size > _LARGEST_MODEL:
        raise InputError(
            f"{next(iter(files.values()))}: with what it names {size} bytes, allowed:"
            f" {_LARGEST_MODEL}"
        )
    return contents
