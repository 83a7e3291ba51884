import json
from pathlib import Path

import pytest
from scenario.texts import SCRIPT

from atlas_cueing.cueing import CAUSAL_METHODS
from atlas_cueing.errors import InputError, ScenarioError, SlipConditionError
from atlas_cueing.rotation import IDENTITY, ZERO
from atlas_cueing.run import build_pipeline, prepare
from atlas_cueing.scenario import Scenario, load_scenario, presets
from atlas_cueing.signals import STANDARD_GRAVITY, VehicleState
from atlas_cueing.vehicles import FlownAhead, RecordedVehicle

RESTING = VehicleState(0.0, IDENTITY, ZERO, (0.0, 0.0, -STANDARD_GRAVITY))
FLAT = ["[1, 0, 0]", "[-0.5, -0.8660254037844386, 0]", "[-0.5, 0.8660254037844386, 0]"]


def loaded(folder: Path, *overrides: str) -> Scenario:
    (folder / "s.toml").write_text(SCRIPT)
    return load_scenario(folder / "s.toml", overrides)


def test_at_rest_nothing_moves(tmp_path: Path) -> None:
    pipeline = build_pipeline(loaded(tmp_path), 0.01)
    for tick in range(50):
        state = VehicleState(tick * 0.01, IDENTITY, ZERO, RESTING.f_B)
        result = pipeline.step(state)
    assert result.vehicle == state
    assert result.wheels.speed == pytest.approx((0.0, 0.0, 0.0), abs=1e-9)
    assert result.motion.p_WS_W == pytest.approx((0.0, 0.0, 0.0), abs=1e-6)
    assert result.motion.time == pytest.approx(state.time)


def test_the_platforms_numbers_arrive(tmp_path: Path) -> None:
    """A vehicle that starts to roll.

    Wheels turn as the platform's own J^-1 says, slower than the limit that was set.
    """
    scenario = loaded(
        tmp_path,
        "platform.wheel_limits.speed_rad_s=0.5",
        "platform.wheel.0.radius_m=0.3",
        "cueing.method=attitude",
    )
    pipeline = build_pipeline(scenario, 0.01)
    fastest = 0.0
    for tick in range(200):
        result = pipeline.step(VehicleState(tick * 0.01, IDENTITY, (1.0, 0.0, 0.0), RESTING.f_B))
        fastest = max(fastest, *map(abs, result.wheels.speed))
    rows = scenario.platform.geometry().wheels_from_sphere
    expected = [sum(a * b for a, b in zip(row, result.motion.w_WS_W, strict=True)) for row in rows]
    assert result.wheels.speed == pytest.approx(expected, abs=1e-12)
    assert 0.45 < fastest <= 0.5 * (1.0 + 1e-9)


def test_two_pipelines_share_nothing(tmp_path: Path) -> None:
    scenario = loaded(tmp_path)
    first, second = build_pipeline(scenario, 0.01), build_pipeline(scenario, 0.01)
    moved = VehicleState(0.0, (0.0, 1.0, 0.0, 0.0), (0.3, 0.1, 0.0), RESTING.f_B)
    expected = second.step(RESTING)
    assert first.step(moved) != expected
    assert build_pipeline(scenario, 0.01).step(RESTING) == expected


def test_a_singular_platform_is_refused_with_its_file(tmp_path: Path) -> None:
    scenario = loaded(
        tmp_path, *(f"platform.wheel.{i}.contact={contact}" for i, contact in enumerate(FLAT))
    )
    told = r"^--set: wheel: platform 'atlas-2.9m' .*determinant .*condition number (infinite|\d)"
    with pytest.raises(SlipConditionError, match=told):
        build_pipeline(scenario, 0.01)


def test_limits_that_leave_no_room_are_refused_with_file_and_key(tmp_path: Path) -> None:
    scenario = loaded(
        tmp_path,
        "platform.stage_limits.travel_m=1e-6",
        "platform.wheel_limits.speed_rad_s=[1,1e-6,1]",
    )
    with pytest.raises(ScenarioError) as caught:
        build_pipeline(scenario, 0.01)
    assert str(caught.value).splitlines() == [
        (
            "--set: platform.wheel_limits.speed_rad_s = 1e-06: "
            "allowed: value > 0.0075, which is jerk_rad_s3 (600) dt^2 / 8 at 100 Hz"
        ),
        (
            "--set: platform.stage_limits.travel_m = 1e-06: "
            "allowed: value > 7.5e-05, which is acceleration_m_s2 (6) dt^2 / 8 at 100 Hz"
        ),
        (
            "--set: platform.stage_limits.travel_m = 1e-06: "
            "allowed: value > 6.25e-05, which is acceleration_m_s2 (5) dt^2 / 8 at 100 Hz"
        ),
    ]


def test_limits_that_leave_no_room_name_the_platform_file(tmp_path: Path) -> None:
    text = presets()["atlas-2.9m"].read_text()
    (tmp_path / "mine.toml").write_text(
        text.replace("speed_m_s = [1.5, 1.5, 1.2]", "speed_m_s = 1e-6")
    )
    scenario = loaded(tmp_path, "platform.file=mine.toml")
    with pytest.raises(
        ScenarioError, match=r"mine\.toml: stage_limits\.speed_m_s = 1e-06: allowed: value > "
    ):
        build_pipeline(scenario, 0.01)


def test_all_oracle_geometries_can_be_typed_into_a_platform(tmp_path: Path) -> None:
    for case in json.loads((Path(__file__).parents[1] / "oracles" / "kinematics.json").read_text()):
        settings = [f"platform.sphere.radius_m={case['sphere_radius_m']}"]
        for i in range(3):
            settings += [f"platform.wheel.{i}.{key}={case[key][i]}" for key in ("contact", "drive")]
            settings += [f"platform.wheel.{i}.radius_m={case['wheel_radius_m'][i]}"]
        geometry = loaded(tmp_path, *settings).platform.geometry()
        assert geometry.slip_free == case["slip_free"]
        assert geometry.wheels_from_sphere == tuple(
            pytest.approx(row, abs=1e-12) for row in case["wheels_from_sphere"]
        )


PUSHED = [
    VehicleState(i * 0.01, IDENTITY, ZERO, (0.5 if 100 < i < 150 else 0.0, 0.0, -STANDARD_GRAVITY))
    for i in range(300)
]


def test_only_preview_needs_the_whole_flight(tmp_path: Path) -> None:
    assert loaded(tmp_path, "cueing.method=preview").needs_whole_flight
    assert not any(
        loaded(tmp_path, f"cueing.method={method}").needs_whole_flight for method in CAUSAL_METHODS
    )


def test_without_the_whole_flight_preview_is_refused_in_one_line(tmp_path: Path) -> None:
    with pytest.raises(
        InputError,
        match=r"^scenario 'short': method 'preview' needs the whole flight .*does not fly live.*$",
    ):
        build_pipeline(loaded(tmp_path, "cueing.method=preview"), 0.01)


def test_a_vehicle_is_flown_ahead_only_for_who_needs_it(tmp_path: Path) -> None:
    vehicle, other = RecordedVehicle(PUSHED), RecordedVehicle(PUSHED)
    assert prepare(loaded(tmp_path), vehicle)[0] is vehicle
    ahead, _ = prepare(loaded(tmp_path, "cueing.method=preview"), other)
    assert isinstance(ahead, FlownAhead)
    assert ahead.states == PUSHED
    assert ahead.state == PUSHED[0]


def test_the_plan_passes_smoothing_unchanged_and_begins_before_the_push(tmp_path: Path) -> None:
    vehicle, pipeline = prepare(loaded(tmp_path, "cueing.method=preview"), RecordedVehicle(PUSHED))
    ticks = [pipeline.step(vehicle.state)]
    while vehicle.advance():
        ticks.append(pipeline.step(vehicle.state))
    assert len(ticks) == len(PUSHED)
    assert max(abs(tick.motion.v_WS_W[0]) for tick in ticks[:100]) > 0.01
    assert all(tick.motion.limited == (0.0, 0.0) for tick in ticks)
    for tick in ticks:
        assert tick.motion.p_WS_W == pytest.approx(tick.cue.p_WS_W, abs=1e-6)


def test_the_platform_s_limits_are_the_plan_s(tmp_path: Path) -> None:
    scenario = loaded(tmp_path, "cueing.method=preview", "platform.stage_limits.travel_m=0.01")
    vehicle, pipeline = prepare(scenario, RecordedVehicle(PUSHED))
    reached = [abs(pipeline.step(vehicle.state).cue.p_WS_W[0])]
    while vehicle.advance():
        reached.append(abs(pipeline.step(vehicle.state).cue.p_WS_W[0]))
    assert 0.009 < max(reached) <= 0.01


LOOKING = [
    (method, f"cueing.method={method}", "cueing.look_ahead_s=0.5")
    for method in ("perceptual", "hedge")
]


@pytest.mark.parametrize(("method", "chosen", "ahead"), LOOKING)
def test_look_ahead_needs_the_whole_flight_and_says_so_without(
    tmp_path: Path, method: str, chosen: str, ahead: str
) -> None:
    assert not loaded(tmp_path, chosen, "cueing.look_ahead_s=0").needs_whole_flight
    scenario = loaded(tmp_path, chosen, ahead)
    assert scenario.needs_whole_flight
    with pytest.raises(
        InputError,
        match=rf"^scenario 'short': cueing\.look_ahead_s of method '{method}' needs the whole"
        r" flight .*does not fly live; use run, batch or recue, or set it to 0$",
    ):
        build_pipeline(scenario, 0.01)


@pytest.mark.parametrize(("method", "chosen", "ahead"), LOOKING)
def test_with_look_ahead_the_cabin_tilts_before_the_push(
    tmp_path: Path, method: str, chosen: str, ahead: str
) -> None:
    """At 1.01 s, known from 0.51 s on."""

    def tilting(*settings: str) -> list[int]:
        vehicle, pipeline = prepare(loaded(tmp_path, *settings), RecordedVehicle(PUSHED))
        rates = [pipeline.step(vehicle.state).cue.w_WS_W]
        while vehicle.advance():
            rates.append(pipeline.step(vehicle.state).cue.w_WS_W)
        return [i for i, w in enumerate(rates) if abs(w[1]) > 1e-9]

    assert tilting(chosen)[0] == 101, method
    assert tilting(chosen, ahead)[0] == 51, method
