"""The recorded vehicle of a log through another method, other parameters or another platform."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from ..errors import InputError, OutputError, ScenarioError
from ..run import open_recorder, prepare, ticks
from ..scenario import Scenario, recorded_vehicle, regular_vehicle
from ..scenario.cueing_table import TABLES
from ..scenario.load import resolve
from ..scenario.overrides import parse_overrides
from ..scenario.reading import read_toml
from .attachments import SCENARIO, as_inside, unpacked
from .flight_alone import scenario_of_flight
from .recorded_run import open_log

_FLOWN = ("vehicle", "duration_s")  # keys of what has been flown already


def cue_again(path: str | Path, settings: Sequence[str], output: str | Path) -> Scenario:
    """Cue the flight of a log anew, and write the result as the log `output`.

    The `KEY=VALUE` settings go on top of the scenario that the log `path` carries.

    Without settings, cue, motion and wheels are the log's own to the last bit. With another method,
    what the old one had by default is left to the new one's defaults, as in a run; what was set for
    the old one stays where the new one knows the key. States, result and reason are the flight's,
    so they are kept. A log that holds no scenario, such as an imported flight, is cued by the
    settings alone. Gives the scenario. Raises InputError (nothing was written) for settings that do
    not fit or do not name what is missing, and for a log without a flight that can be cued;
    LogError for a log that is damaged.
    """
    _refuse_flown(settings)
    output = Path(output)
    log = open_log(path)
    bare = SCENARIO not in log.attachments
    recorded = regular_vehicle(log) if bare else recorded_vehicle(log)
    with unpacked(log) as folder:
        if bare:
            (folder / SCENARIO).write_text(scenario_of_flight(log, settings), "utf-8")
        try:
            scenario = _cued_by(folder / SCENARIO, [_from_here(text) for text in settings])
        except ScenarioError as error:
            raise InputError(
                *(as_inside(ScenarioError([mistake]), folder) for mistake in error.mistakes)
            ) from error
        attachments = scenario.attachments()
    vehicle, pipeline = prepare(scenario, recorded)
    recorder = open_recorder(
        scenario,
        output,
        flown=log.metadata,
        attachments=attachments,
        recued_from=log.path.name,
    )
    try:
        for block in ticks(vehicle, pipeline):
            for tick in block:
                recorder.append(tick)
        for status in log.statuses:
            recorder.status(status.time, status.state, status.reason)
        ended = "ok" if bare else ""  # a flight alone has no end but its own
        recorder.close(log.metadata.get("result", ended), log.metadata.get("reason", ""))
    except OutputError:
        recorder.abandon()
        recorder.part.unlink(missing_ok=True)  # half of it is of no use: the flight is still there
        raise
    return scenario


def _cued_by(file: Path, settings: Sequence[str]) -> Scenario:
    """The log's scenario with the settings on top. Raises ScenarioError with every mistake."""
    data, overrides = read_toml(file), parse_overrides(settings)
    old = data.get("cueing")
    if isinstance(old, dict) and overrides.get(("cueing", "method"), old.get("method")) != old.get(
        "method"
    ):
        # a log's scenario names every value, so that the old method's defaults would pass for
        # somebody's wish
        method = TABLES.get(str(old.get("method")))
        data["cueing"] = _changed(old, method().model_dump(mode="json") if method else {}) | {
            "method": old.get("method")
        }
    return resolve(data, overrides, file)


def _changed(table: Mapping[str, Any], defaults: Mapping[str, Any]) -> dict[str, Any]:
    """What differs from the defaults, in tables within as well."""
    changed = {}
    for key, value in table.items():
        default = defaults.get(key)
        if isinstance(value, dict) and isinstance(default, dict):
            changed[key] = _changed(value, default)
        elif value != default:
            changed[key] = value
    return changed


def _refuse_flown(settings: Sequence[str]) -> None:
    for text in settings:
        if text.partition("=")[0].strip().partition(".")[0] in _FLOWN:
            raise InputError(
                f"--set: {text}: the flight is the recorded one; allowed: keys of cueing, platform,"
                " recording, name"
            )


def _from_here(text: str) -> str:
    """Look for a platform file where the command was called.

    The log's files are unpacked somewhere else.
    """
    key, _, value = text.partition("=")
    if key.strip() != "platform.file":
        return text
    return f"platform.file={Path(value.strip().strip(chr(34))).resolve()}"
