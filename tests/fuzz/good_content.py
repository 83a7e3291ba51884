"""Good files of each format, which the targets get spoilt."""

from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
from flight_data import recorders
from flight_data.truth import plain_csv, truth
from recording.layouts import LAYOUTS, rewritten

from atlas_cueing.recording import McapRecorder
from atlas_cueing.rotation import IDENTITY, ZERO
from atlas_cueing.signals import Cue, Motion, Tick, VehicleState, WheelSpeeds

SCENARIO = b"""
name = "a"
duration_s = 1.0
[vehicle]
aircraft = "f16"
rate_hz = 60
initial = { altitude_m = 100, airspeed_m_s = 5.0, trim = true }
input = [ { time_s = 0.1, property = "fcs/elevator-cmd-norm", value = -0.2, ramp_s = 1 } ]
[platform]
preset = "atlas-1.5m"
[cueing]
method = "force"
force_gain = [1, 0.5, 1]
stage = { planner = "onset", travel_m = 0.5 }
[recording]
skip = ["/tf"]
[sweep]
cueing.method = ["blend", "force"]
vehicle.rate_hz = { low = 50, high = 60 }
draws = 2
"""


def _ticks(count: int) -> list[Tick]:
    def tick(t: float) -> Tick:
        motion = Motion(t, IDENTITY, ZERO, ZERO, ZERO, ZERO, ZERO, (0.0, 0.0))
        cue = Cue(t, IDENTITY, ZERO, ZERO, ZERO, ZERO)
        return Tick(
            VehicleState(t, IDENTITY, ZERO, (0.0, 0.0, -9.8)),
            cue,
            motion,
            WheelSpeeds(t, ZERO, ZERO),
        )

    return [tick(0.01 * k) for k in range(count)]


def good_log() -> bytes:
    """A whole log of ours."""
    with TemporaryDirectory() as folder:
        path = Path(folder) / "x.mcap"
        recorder = McapRecorder(
            path, head_S=ZERO, metadata={}, attachments={"scenario.toml": SCENARIO}, chunk_ticks=4
        )
        recorder.status(0.0, "running", "")
        for tick in _ticks(12):
            recorder.append(tick)
        recorder.close("ok", "")
        return path.read_bytes()


def logs_of_others() -> list[bytes]:
    """The good log as other programs write it."""
    with TemporaryDirectory() as folder:
        own, other = Path(folder) / "own.mcap", Path(folder) / "other.mcap"
        own.write_bytes(good_log())
        return [
            rewritten(own, other, LAYOUTS[name]).read_bytes()
            for name in ("lz4", "no chunks, no checksums", "beside others")
        ]


def recordings() -> dict[str, bytes]:
    """A good file of each format that `import` takes, by the name of its map."""
    flown = truth(np.arange(150) / 100.0, 1.0)
    with TemporaryDirectory() as name:
        folder = Path(name)
        bag = recorders.ros_bag(folder / "bag", flown, "MCAP")
        return {
            "csv": plain_csv(folder / "a.csv", flown).read_bytes(),
            "px4": recorders.ulog(folder / "a.ulg", flown).read_bytes(),
            "ardupilot": recorders.dataflash(folder / "a.bin", flown).read_bytes(),
            "ros-imu": next(bag.glob("*.mcap")).read_bytes(),
        }
