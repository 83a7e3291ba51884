"""The simulated platform of a live ride, by the command's options."""

from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from ..errors import InputError

if TYPE_CHECKING:
    from ..run import RunResult
    from ..scenario import Scenario
    from .live_extras import DriveLink

Told = Callable[["RunResult"], "RunResult"]


@contextmanager
def simulated(
    link: "DriveLink", scenario: "Scenario", *, priority: bool
) -> Iterator[tuple["DriveLink", Told]]:
    """Start a simulated platform at home, if it was asked for.

    Yield the link to the drives, and what adds the plant's own figures and topic to a result.

    Raises InputError for options that are for other drives, and a platform that makes no plant.
    """
    if not link.plant:
        yield link, lambda result: result
        return
    _check(link)
    from ..live.control.pose import Pose
    from ..live.plant_process import PlantProcess

    with ExitStack() as stack:
        process = PlantProcess(scenario.platform, Pose(), priority=priority)
        stack.callback(process.finish)

        def told(result: "RunResult") -> "RunResult":
            """End the platform; return the result with what it did, which goes into the log."""
            rows = process.finish()
            if result.log is None or result.live is None or not Path(result.log).exists():
                return result
            from ..live.plant_truth import add_plant

            return replace(result, live=replace(result.live, plant=add_plant(result.log, rows)))

        yield replace(link, address=process.address), told


def check_feedback(feedback: str, link: "DriveLink") -> None:
    """Raise InputError for a feedback without drives that tell of the cabin's sensors."""
    if feedback == "none":
        return
    if not (link.address or link.plant):
        raise InputError(f"--feedback {feedback} is for --setpoints HOST:PORT or --plant")
    if not link.listen:
        raise InputError(
            f"--feedback {feedback} needs the drives' status, which --no-drive-status turns off"
        )


def _check(link: "DriveLink") -> None:
    given = {
        "--setpoints": link.address,
        "--key": link.key,
        "--from": link.stated,
        "--pose": link.pose,
        "--no-drive-status": not link.listen,
    }
    for option, value in given.items():
        if value:
            raise InputError(f"{option} is for real drives, and --plant simulates them")
