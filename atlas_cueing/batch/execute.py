"""One run in a process of its own."""

import resource
from dataclasses import fields
from pathlib import Path
from tempfile import TemporaryDirectory

from ..errors import InputError, OutputError
from ..run import RunResult, open_vehicle, run_scenario
from ..scenario import Scenario, load_scenario
from ..signals import Vehicle
from ..vehicles import KeptFlight, RememberedVehicle
from .job import Job
from .job_result import REFUSED, JobResult
from .run_id import run_id


def confine(memory: float, beside: int = 0) -> None:
    """Bound this process to `memory` GB of address space, without core dumps.

    beside: bytes that the worker keeps for all of its runs, which are not counted.
    """
    _, hard = resource.getrlimit(resource.RLIMIT_AS)
    bound = int(memory * 1e9) + beside
    resource.setrlimit(
        resource.RLIMIT_AS, (bound if hard == resource.RLIM_INFINITY else min(bound, hard), hard)
    )
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


class OneFlight:
    """The flight of a job: the kept one, or the model's, which is then kept if that is possible.

    kept: a flight of the same vehicle that is there already. most_bytes: what a new one may take.
    """

    def __init__(self, kept: KeptFlight | None = None, most_bytes: int = 0) -> None:
        self._kept = kept
        self._most = most_bytes
        self._flown: RememberedVehicle | None = None
        self.unbegun = False  # the model did not load, or its flight did not begin

    def opened(self, scenario: Scenario) -> Vehicle:
        """Give the vehicle at its first state. Raises what `open_vehicle` raises."""
        if self._kept:
            return self._kept.vehicle()
        try:
            vehicle = open_vehicle(scenario)
        except InputError:
            self.unbegun = True
            raise
        if not self._most:
            return vehicle
        self._flown = RememberedVehicle(vehicle, self._most)
        return self._flown

    def new(self) -> KeptFlight | None:
        """Give the flight that was flown now, to its end; None when there is no such."""
        return self._flown.flight() if self._flown else None


def fly_alone(job: Job, workdir: Path, flight: OneFlight | None = None) -> JobResult:
    """Fly the job, write its log into the folder `workdir`, and return the result.

    flight: gives the vehicle; by default the model flies.

    Raises only what ends the process.
    """
    flight = flight or OneFlight()
    try:
        with TemporaryDirectory(prefix="atlas_cueing_") as folder:
            for name, content in job.files.items():
                path = Path(folder) / name
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_bytes(content.encode("latin-1"))
            for name, original in job.large.items():
                (Path(folder) / name).symlink_to(original)
            scenario = load_scenario(Path(folder) / "scenario.toml", trust_models=job.trust_models)
            here = run_id(scenario)
            if here != job.id:
                differs = f"this worker would fly {here}: its versions are not the driver's"
                return JobResult("worker_differs", differs, id=job.id)
            log = workdir / f"{job.id}.mcap"
            result = run_scenario(scenario, log, opened=flight.opened)
    except MemoryError:
        result = RunResult(
            "out_of_memory", f"needs more than {job.limits.memory:g} GB", left_by(job, workdir)
        )
    except OutputError as error:
        result = RunResult("recording_failed", str(error))
    except InputError as error:
        word = "vehicle_failed" if flight.unbegun else REFUSED
        result = RunResult(word, str(error).replace(f"{folder}/", ""))
    except OSError as error:
        result = RunResult("recording_failed", f"{type(error).__name__}: {error}")
    except Exception as error:  # noqa: BLE001 - one failed run must not end the others
        reason = f"{type(error).__name__}: {error}"
        result = RunResult("failed", reason, left_by(job, workdir))
    return _of_job(job, result)


def _of_job(job: Job, result: RunResult) -> JobResult:
    """Return the result of the run as that of its job; its log is named relative to it."""
    values = {item.name: getattr(result, item.name) for item in fields(result)}
    return JobResult(**values | {"log": result.log and Path(result.log.name), "id": job.id})


def left_by(job: Job, workdir: Path) -> Path | None:
    """Return the name of the log that a run left in its `workdir`, a .part or a complete one."""
    names = (f"{job.id}.mcap.part", f"{job.id}.mcap")
    return next((Path(name) for name in names if (workdir / name).is_file()), None)
