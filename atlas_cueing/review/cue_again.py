"""The recorded vehicle of a log through another method, other parameters or another platform."""

from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

from ..cueing.own.own_method import RESERVED
from ..cueing.own.sources import is_file_reference
from ..errors import InputError, LogError, MethodError, OutputError, ScenarioError
from ..recording import Log, McapRecorder
from ..run import METHOD_FAILED, open_recorder, prepare, ticks
from ..scenario import Scenario, recorded_vehicle, regular_vehicle
from ..scenario.cueing_table import TABLES
from ..scenario.load import resolve
from ..scenario.overrides import parse_overrides
from ..scenario.reading import read_toml
from ..signals import Tick
from .attachments import SCENARIO, as_inside, unpacked
from .flight_alone import scenario_of_flight
from .recorded_run import open_log
from .recovery import advice

_FLOWN = ("vehicle", "duration_s")  # keys of what has been flown already


def cue_again(
    path: str | Path, settings: Sequence[str], output: str | Path, *, trust_models: bool = False
) -> Scenario:
    """Cue the flight of a log anew, and write the result as the log `output`.

    The `KEY=VALUE` settings go on top of the scenario that the log `path` carries.

    Without settings, cue, motion and wheels are the log's own to the last bit. With another method,
    what the old one had by default is left to the new one's defaults, as in a run; what was set for
    the old one stays where the new one knows the key. States, result and reason are the flight's,
    so they are kept; an own method that fails ends the log there, as in a run. A log that holds no
    scenario, such as an imported flight, is cued by the settings alone. Gives the scenario.

    trust_models: whether a cueing method in a file may be run, the log's or one in the settings.

    Raises InputError (nothing was written) for settings that do not fit or do not name what is
    missing, for a log without a flight that can be cued, and for one by a method that is not to be
    had, or not as it was: no other method stands in for it; also for a log
    that is damaged.
    """
    _refuse_flown(settings)
    output = Path(output)
    log = _input(Path(path))
    bare = SCENARIO not in log.attachments
    recorded = regular_vehicle(log) if bare else recorded_vehicle(log)
    scenario, attachments = _scenario_for(log, settings, trust_models)
    if not bare:
        _check_method(log, scenario, settings)
    vehicle, pipeline = prepare(scenario, recorded)
    recorder = open_recorder(
        scenario,
        output,
        flown=_without_method(log.metadata),
        attachments=attachments,
        recued_from=log.path.name,
    )
    try:
        failure = _cue_into(recorder, ticks(vehicle, pipeline))
        _end(recorder, log, failure, "ok" if bare else "")  # a flight alone has no end but its own
    except OutputError:
        recorder.abandon()
        recorder.part.unlink(missing_ok=True)  # half of it is of no use: the flight is still there
        raise
    return scenario


def _input(path: Path) -> Log:
    """Read a log that is input here. Raises InputError for whatever is no log, or a damaged one."""
    try:
        return open_log(path)
    except LogError as error:
        todo = advice(path)
        raise InputError(*error.lines, *([f"{path}: {todo}"] if todo else [])) from error


def _scenario_for(
    log: Log, settings: Sequence[str], trusted: bool
) -> tuple[Scenario, dict[str, bytes]]:
    """The log's scenario, or that of a flight alone, with the settings on top; its attachments."""
    with unpacked(log) as folder:
        if SCENARIO not in log.attachments:
            (folder / SCENARIO).write_text(scenario_of_flight(log, settings), "utf-8")
        try:
            here = [_from_here(text) for text in settings]
            scenario = _cued_by(folder / SCENARIO, here, trusted)
        except ScenarioError as error:
            raise InputError(
                *(as_inside(ScenarioError([mistake]), folder) for mistake in error.mistakes)
            ) from error
        return scenario, scenario.attachments()


def _end(recorder: McapRecorder, log: Log, failure: MethodError | None, ended: str) -> None:
    """Finish the new log with the flight's states and result, or with the method's failure.

    ended: the result of a log that names none.
    """
    for status in log.statuses:
        if failure is None or status.time < failure.time:
            recorder.status(status.time, status.state, status.reason)
    result, reason = log.metadata.get("result", ended), log.metadata.get("reason", "")
    if failure:
        result, reason = METHOD_FAILED, str(failure)
        recorder.status(failure.time, result, reason)
    recorder.close(result, reason)


def _cue_into(recorder: McapRecorder, blocks: Iterable[list[Tick]]) -> MethodError | None:
    """Record the ticks; the error of an own method that ends them."""
    try:
        for block in blocks:
            for tick in block:
                recorder.append(tick)
    except MethodError as error:
        return error
    return None


def _without_method(metadata: Mapping[str, str]) -> dict[str, str]:
    """What a log says of its flight and its end; of the method the new one tells."""
    return {key: value for key, value in metadata.items() if not key.startswith("method_")}


def _check_method(log: Log, scenario: Scenario, settings: Sequence[str]) -> None:
    """Refuse a method that is not the one which the log says it was cued by."""
    if ("cueing", "method") in parse_overrides(settings):
        return
    method = scenario.file.cueing.declaration
    here = {"method": method.name, **method.metadata()}
    keys = [key for key in {**log.metadata, **here} if key.partition("_")[0] == "method"]
    differ = [key for key in keys if log.metadata.get(key) != here.get(key)]
    if differ and "method" in log.metadata:
        then = ", ".join(f"{key} = {log.metadata.get(key, '')!r}" for key in differ)
        now = ", ".join(f"{key} = {here.get(key, '')!r}" for key in differ)
        raise InputError(
            f"log {log.path}: was cued by a method that is not here as it was: {then}; here: {now};"
            " have it as it was, or choose one with --set cueing.method=NAME"
        )


def _cued_by(file: Path, settings: Sequence[str], trusted: bool) -> Scenario:
    """The log's scenario with the settings on top. Raises ScenarioError with every mistake."""
    data, overrides = read_toml(file), parse_overrides(settings)
    old = data.get("cueing")
    if isinstance(old, dict) and overrides.get(("cueing", "method"), old.get("method")) != old.get(
        "method"
    ):
        # a log's scenario names every value, so that the old method's defaults would pass for
        # somebody's wish
        method = TABLES.get(str(old.get("method")))
        # without its program nobody knows what the defaults of an own method were
        kept = old if method else {key: old[key] for key in RESERVED if key in old}
        data["cueing"] = _changed(kept, method().model_dump(mode="json") if method else {}) | {
            "method": old.get("method")
        }
    return resolve(data, overrides, file, trust_models=trusted)


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
    if key.strip() == "platform.file":
        return f"platform.file={Path(value.strip().strip(chr(34))).resolve()}"
    if key.strip() == "cueing.method" and is_file_reference(value.strip()):
        return f"cueing.method={Path(value.strip()).resolve()}"
    return text
