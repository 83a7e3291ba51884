"""A cueing method of a user's own that fails in real time."""

from pathlib import Path

from atlas_cueing.live.control.state_machine import State
from atlas_cueing.pipeline import Pipeline
from atlas_cueing.run import build_pipeline
from atlas_cueing.scenario import load_scenario

from .rig import ROUNDING, Rig

METHOD = """
from math import cos, sin

class Spinning:
    "Turns about the vertical until it breaks."

    def __init__(self, dt):
        self.dt, self.angle = dt, 0.0

    def step(self, vehicle):
        self.angle += 0.5 * self.dt
        if self.angle > 4.0:
            raise OSError("its camera is gone")
        return (cos(self.angle / 2.0), 0.0, 0.0, sin(self.angle / 2.0)), (0.0, 0.0, 0.5)
"""
SCENARIO = """
name = "spinning"
[vehicle]
script = "c1722"
[platform]
preset = "atlas-2.9m"
[cueing]
method = "spinning.py:Spinning"
"""


def test_it_is_a_fault_with_its_name_inside_every_limit(tmp_path: Path) -> None:
    (tmp_path / "spinning.py").write_text(METHOD)
    (tmp_path / "s.toml").write_text(SCENARIO)
    scenario = load_scenario(tmp_path / "s.toml", trust_models=True)

    class OwnRig(Rig):
        def pipeline(self) -> Pipeline:
            return build_pipeline(scenario, self.dt)

    rig = OwnRig(attended=False)
    rig.controller.engage()
    rig.until(State.RUNNING, 12.0)
    rig.until(State.STOPPED, 20.0)
    assert rig.controller.outcome.result == "fault"
    reason = rig.controller.outcome.reason
    assert "method 'spinning.py:Spinning' at " in reason
    assert "OSError: its camera is gone (spinning.py, line 13)" in reason
    assert max(abs(rate) for tick in rig.tape.ticks for rate in tick.motion.w_WS_W) > 0.49
    assert rig.excess() < ROUNDING
