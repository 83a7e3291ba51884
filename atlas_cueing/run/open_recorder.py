"""The log of a run: what stands in it beside the ticks, in one place for every way to fly."""

from collections.abc import Callable, Mapping
from functools import cache
from importlib.metadata import version
from pathlib import Path
from typing import Final

from ..loads import load_columns
from ..recording import McapRecorder
from ..rotations import Array
from ..scenario import Scenario

PACKAGES: Final = ("atlas_cueing", "jsbsim", "ruckig")  # whose versions a log depends on
_FLIES: Final = "jsbsim"  # the one whose version belongs to the flight, not to its cueing


def open_recorder(
    scenario: Scenario,
    log: Path,
    *,
    observer: Callable[[Array], None] | None = None,
    flown: Mapping[str, str] | None = None,
    attachments: Mapping[str, bytes] | None = None,
    started_ns: int | None = None,
    attitude: bool = False,
    **more: str,
) -> McapRecorder:
    """Open the log of a run of `scenario`.

    Args:
        scenario: what is recorded.
        log: where the complete log will be.
        observer: takes the numbers of each chunk (see `McapRecorder`).
        flown: metadata of another log whose flight this is; kept where this one has none.
        attachments: files by name; those of the scenario by default.
        started_ns: makes it a live log: wall clock at its start, ns since 1970.
        attitude: that of a live log is corrected.
        more: further metadata.

    Raises:
        OutputError: the log cannot be written there.
    """
    recording, platform = scenario.file.recording, scenario.platform
    origin = _told(scenario, live=started_ns is not None) if flown is None else flown
    return McapRecorder(
        log,
        head_S=platform.head_S,
        metadata={**origin, **_metadata(scenario, flown is None), **more},
        attachments=scenario.attachments() if attachments is None else attachments,
        # a live log is written out by time, in chunks of the recorder's own length
        **({"chunk_ticks": recording.chunk_ticks} if started_ns is None else {}),
        skip_topics=recording.skip,
        observer=observer,
        started_ns=started_ns,
        attitude=attitude,
        loads=load_columns(platform.load_model()) if platform.has_loads else None,
    )


def _told(scenario: Scenario, live: bool) -> Mapping[str, str]:
    """Return what is known of where the flight is from, which asks for its files."""
    return (scenario.live_flight if live else scenario.flight).told()


def _metadata(scenario: Scenario, flies: bool) -> dict[str, str]:
    return {
        "scenario": scenario.name,
        "method": scenario.file.cueing.declaration.name,
        **scenario.file.cueing.declaration.metadata(),
        "platform": scenario.platform.name,
        **{f"{name}_version": _version(name) for name in PACKAGES if flies or name != _FLIES},
    }


@cache  # 0.3 ms each, which every run of a batch would take
def _version(package: str) -> str:
    return version(package)
