"""One run in a process of its own."""

import resource
from dataclasses import fields
from pathlib import Path
from tempfile import TemporaryDirectory

from ..errors import InputError, OutputError
from ..run import RunResult, run_scenario
from ..scenario import load_scenario
from .job import Job
from .job_result import JobResult
from .run_id import run_id


def confine(memory: float) -> None:
    """Bound this process to `memory` GB of address space, without core dumps."""
    _, hard = resource.getrlimit(resource.RLIMIT_AS)
    bound = int(memory * 1e9)
    resource.setrlimit(
        resource.RLIMIT_AS, (bound if hard == resource.RLIM_INFINITY else min(bound, hard), hard)
    )
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


def fly_alone(job: Job, workdir: Path) -> JobResult:
    """Fly the job, write its log into the folder `workdir`, and return the result.

    Raises only what ends the process.
    """
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
            result = run_scenario(scenario, workdir / f"{job.id}.mcap")
    except MemoryError:
        result = RunResult(
            "out_of_memory", f"needs more than {job.limits.memory:g} GB", left_by(job, workdir)
        )
    except OutputError as error:
        result = RunResult("recording_failed", str(error))
    except InputError as error:
        # the scenario was checked when it was planned, so it is the model that does not load
        result = RunResult("vehicle_failed", str(error).replace(f"{folder}/", ""))
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
