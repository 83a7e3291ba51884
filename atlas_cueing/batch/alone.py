"""One run in a process that is its own."""

import os
import resource
import sys
from pathlib import Path
from tempfile import TemporaryDirectory

from ..errors import InputError, OutputError
from ..scenario import load_scenario
from .order import Order
from .record import Record, keep
from .run import RunResult, run_scenario
from .run_id import run_id

_PARENT_DEATH = 1  # PR_SET_PDEATHSIG of Linux's prctl
_SIGKILL = 9


def confine(memory: float) -> None:
    """Bound this process to `memory` GB of address space, without core dumps, and let it die with its parent (on Linux)."""
    _, hard = resource.getrlimit(resource.RLIMIT_AS)
    bound = int(memory * 1e9)
    resource.setrlimit(resource.RLIMIT_AS, (bound if hard == resource.RLIM_INFINITY else min(bound, hard), hard))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    if sys.platform == "linux":
        import ctypes

        ctypes.CDLL(None).prctl(_PARENT_DEATH, _SIGKILL, 0, 0, 0)


def fly_alone(order: Order) -> Record:
    """Fly the order, write log and record into its folder, and give the record. Raises only what ends the process."""
    record = _flown(order)
    if record.final:
        try:
            keep(record, Path(order.folder))
        except OSError as error:
            return Record(order.id, "recording_failed", f"{order.id}.json: {error.strerror}")
    return record


def _flown(order: Order) -> Record:
    try:
        with TemporaryDirectory(prefix="atlas_cueing_") as folder:
            for name, content in order.files.items():
                (Path(folder) / name).write_bytes(content.encode("latin-1"))
            scenario = load_scenario(Path(folder) / "scenario.toml", trust_models=order.trust_models)
            here = run_id(scenario)
            if here != order.id:
                return Record(order.id, "worker_differs", f"this worker would fly {here}: its versions are not the driver's")
            result = run_scenario(scenario, Path(order.folder) / f"{order.id}.mcap")
    except MemoryError:
        return Record(order.id, "out_of_memory", f"needs more than {order.limits.memory:g} GB", _left(order))
    except OutputError as error:
        return Record(order.id, "recording_failed", str(error))
    except InputError as error:  # the scenario was checked when it was planned, so it is the model that does not load
        return Record(order.id, "vehicle_failed", str(error))
    except OSError as error:
        return Record(order.id, "recording_failed", f"{type(error).__name__}: {error}")
    except Exception as error:  # noqa: BLE001 - one run's mishap is no other's
        return Record(order.id, "failed", f"{type(error).__name__}: {error}", _left(order))
    return _record(order, result)


def _record(order: Order, result: RunResult) -> Record:
    found = result.evaluation
    figures = (result.ticks, result.duration, result.wall, found.violations, found.metrics, found.limit_use)
    log = os.path.relpath(result.log, order.folder)
    return Record(order.id, result.result, result.reason, log, *figures)


def _left(order: Order) -> str:
    """Name of the log that there is, complete or a .part; empty when there is none."""
    names = (f"{order.id}.mcap.part", f"{order.id}.mcap")
    return next((name for name in names if (Path(order.folder) / name).is_file()), "")
