import logging
from pathlib import Path

import jsbsim
import pytest

from atlas_cueing.vehicles import JsbsimVehicle, ScriptFlight, own_scripts
from atlas_cueing.vehicles.jsbsim.jsbsim_log import LOGGER, capture

from ..flying import event, write_script


def record(log: jsbsim.FGLogger, level: jsbsim.LogLevel, *parts: str) -> None:
    log.set_level(level)
    log.format(jsbsim.LogFormat.RED)
    for part in parts:
        log.message(part)
    log.flush()


def test_fragments_become_one_record_on_one_line(caplog: pytest.LogCaptureFixture) -> None:
    with caplog.at_level(logging.INFO, LOGGER.name):
        log = capture()
        record(log, jsbsim.LogLevel.STDOUT, "one\n", "  two ", "three\n")
        record(log, jsbsim.LogLevel.INFO, "four")
    assert caplog.record_tuples == [
        (LOGGER.name, logging.INFO, "one two three"),
        (LOGGER.name, logging.INFO, "four"),
    ]


@pytest.mark.parametrize("level", list(jsbsim.LogLevel))
def test_every_level_of_jsbsim_has_one_here(
    level: jsbsim.LogLevel, caplog: pytest.LogCaptureFixture
) -> None:
    with caplog.at_level(logging.DEBUG, LOGGER.name):
        record(capture(), level, "text")
    assert len(caplog.records) == 1
    assert (caplog.records[0].levelno >= logging.WARNING) == (
        level.name in {"WARN", "ERROR", "FATAL"}
    )


def test_empty_records_are_dropped(caplog: pytest.LogCaptureFixture) -> None:
    with caplog.at_level(logging.DEBUG, LOGGER.name):
        record(capture(), jsbsim.LogLevel.ERROR, "\n")
    assert not caplog.records


def test_the_last_error_is_kept_for_our_own_messages() -> None:
    log = capture()
    record(log, jsbsim.LogLevel.ERROR, "no such thing")
    record(log, jsbsim.LogLevel.INFO, "by the way")
    assert log.complaint == "no such thing"


def test_file_and_line_lead_the_record(caplog: pytest.LogCaptureFixture) -> None:
    log = capture()
    with caplog.at_level(logging.ERROR, LOGGER.name):
        log.set_level(jsbsim.LogLevel.ERROR)
        log.file_location("a.xml", 7)
        log.message("bad")
        log.flush()
    assert caplog.messages == ["a.xml:7: bad"]


def test_notifications_of_a_script_are_logged_at_info(
    tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    script = write_script(tmp_path / "notify.xml", event("fcs/elevator-cmd-norm", "0.1"))
    with caplog.at_level(logging.INFO, LOGGER.name):
        vehicle = JsbsimVehicle(ScriptFlight(script))
        while vehicle.advance():
            pass
    told = [
        record
        for record in caplog.records
        if "execution at" in record.getMessage() or "(Event" in record.getMessage()
    ]
    assert told
    assert all(record.levelno == logging.INFO for record in told)


def test_loading_is_not_reported_part_by_part(caplog: pytest.LogCaptureFixture) -> None:
    with caplog.at_level(logging.DEBUG, LOGGER.name):
        JsbsimVehicle(ScriptFlight(own_scripts()["c1722"]))
    assert len(caplog.records) < 50  # some 1000 by default, which cost more than the loading
