from math import inf, nan

import jsbsim
import pytest

from atlas_cueing.errors import InputError
from atlas_cueing.vehicles import TimedInput
from atlas_cueing.vehicles.jsbsim.inputs import InputPlayer
from atlas_cueing.vehicles.jsbsim.loading import load

from ..flying import cessna

ELEVATOR = "fcs/elevator-cmd-norm"


@pytest.fixture
def fdm() -> jsbsim.FGFDMExec:
    return load(cessna())


def played(fdm: jsbsim.FGFDMExec, *inputs: TimedInput, times: list[float]) -> list[float]:
    player = InputPlayer(inputs, fdm)
    values = []
    for time in times:
        player.play(time)
        values.append(fdm[ELEVATOR])
    return values


def test_a_step_is_set_at_its_time_and_stays(fdm: jsbsim.FGFDMExec) -> None:
    assert played(fdm, TimedInput(0.1, ELEVATOR, 0.5), times=[0.0, 0.09, 0.1, 5.0]) == [
        0.0,
        0.0,
        0.5,
        0.5,
    ]


def test_a_step_is_set_once_and_then_left_alone(fdm: jsbsim.FGFDMExec) -> None:
    player = InputPlayer([TimedInput(0.0, ELEVATOR, 0.5)], fdm)
    assert player.play(0.0)
    fdm[ELEVATOR] = 0.2  # the model itself, an autopilot say
    assert not player.play(0.1)
    assert fdm[ELEVATOR] == 0.2


def test_an_input_on_a_rounded_step_time_belongs_to_that_step(fdm: jsbsim.FGFDMExec) -> None:
    assert 0.1 + 0.2 > 0.3
    assert played(fdm, TimedInput(0.1 + 0.2, ELEVATOR, 0.5), times=[0.3]) == [0.5]


def test_a_ramp_is_linear_from_the_present_value_and_ends_exactly(fdm: jsbsim.FGFDMExec) -> None:
    fdm[ELEVATOR] = -0.2
    values = played(fdm, TimedInput(1.0, ELEVATOR, 0.6, 2.0), times=[0.9, 1.0, 1.5, 2.0, 3.0, 4.0])
    assert values == pytest.approx([-0.2, -0.2, 0.0, 0.2, 0.6, 0.6], abs=1e-15)
    assert values[-1] == 0.6


def test_the_later_of_two_overlapping_ramps_takes_over_from_where_the_first_is(
    fdm: jsbsim.FGFDMExec,
) -> None:
    ramps = TimedInput(0.0, ELEVATOR, 1.0, 10.0), TimedInput(5.0, ELEVATOR, 0.0, 1.0)
    # the first has come to 0.5 at 5 s, although it is only looked at again at 5.5 s
    assert played(fdm, *ramps, times=[0.0, 4.0, 5.5, 6.0, 10.0]) == pytest.approx(
        [0.0, 0.4, 0.25, 0.0, 0.0], abs=1e-15
    )


def test_a_step_ends_a_ramp(fdm: jsbsim.FGFDMExec) -> None:
    inputs = TimedInput(0.0, ELEVATOR, 1.0, 10.0), TimedInput(2.0, ELEVATOR, -1.0)
    assert played(fdm, *inputs, times=[0.0, 1.0, 2.0, 5.0]) == pytest.approx([0.0, 0.1, -1.0, -1.0])


def test_inputs_are_played_in_order_of_time_and_ties_in_order_of_the_list(
    fdm: jsbsim.FGFDMExec,
) -> None:
    inputs = (
        TimedInput(2.0, ELEVATOR, 0.2),
        TimedInput(1.0, ELEVATOR, 0.1),
        TimedInput(2.0, ELEVATOR, 0.3),
    )
    assert played(fdm, *inputs, times=[1.0, 2.0]) == [0.1, 0.3]


def test_properties_move_independently(fdm: jsbsim.FGFDMExec) -> None:
    player = InputPlayer(
        [TimedInput(0.0, ELEVATOR, 1.0, 1.0), TimedInput(0.5, "fcs/rudder-cmd-norm", -1.0, 1.0)],
        fdm,
    )
    player.play(0.75)
    assert (fdm[ELEVATOR], fdm["fcs/rudder-cmd-norm"]) == pytest.approx((0.75, -0.25))


def test_a_misspelt_property_is_refused_with_the_nearest_name(fdm: jsbsim.FGFDMExec) -> None:
    with pytest.raises(
        InputError,
        match=(
            "unknown JSBSim property 'fcs/elevtor-cmd-norm'; did you mean 'fcs/elevator-cmd-norm'"
        ),
    ):
        InputPlayer([TimedInput(0.0, "fcs/elevtor-cmd-norm", 0.1)], fdm)
    assert not fdm.get_property_manager().hasNode("fcs/elevtor-cmd-norm"), (
        "asking must not create it"
    )


def test_an_index_of_zero_may_be_left_out_or_written(fdm: jsbsim.FGFDMExec) -> None:
    InputPlayer([TimedInput(0.0, "fcs/throttle-cmd-norm[0]", 0.7)], fdm).play(0.0)
    assert fdm["fcs/throttle-cmd-norm"] == 0.7


def test_a_property_that_can_only_be_read_is_refused(fdm: jsbsim.FGFDMExec) -> None:
    with pytest.raises(InputError, match="'velocities/p-rad_sec' can be read but not set"):
        InputPlayer([TimedInput(0.0, "velocities/p-rad_sec", 0.1)], fdm)


@pytest.mark.parametrize(
    "bad",
    [
        TimedInput(0.0, ELEVATOR, nan),
        TimedInput(0.0, ELEVATOR, inf),
        TimedInput(nan, ELEVATOR, 0.1),
        TimedInput(-1.0, ELEVATOR, 0.1),
        TimedInput(inf, ELEVATOR, 0.1),
        TimedInput(0.0, ELEVATOR, 0.1, nan),
        TimedInput(0.0, ELEVATOR, 0.1, -1.0),
        TimedInput(0.0, ELEVATOR, 0.1, inf),
    ],
)
def test_bad_numbers_are_refused(bad: TimedInput, fdm: jsbsim.FGFDMExec) -> None:
    with pytest.raises(InputError, match="must be finite"):
        InputPlayer([bad], fdm)


def test_an_empty_name_is_refused(fdm: jsbsim.FGFDMExec) -> None:
    with pytest.raises(InputError, match="unknown JSBSim property ''"):
        InputPlayer([TimedInput(0.0, "", 0.1)], fdm)


@pytest.mark.parametrize("name", ["[[[", "%s%n", "a[", "..", "../.."])
def test_what_can_be_no_name_does_not_end_the_process(name: str, fdm: jsbsim.FGFDMExec) -> None:
    with pytest.raises(InputError, match="unknown JSBSim property"):
        InputPlayer([TimedInput(0.0, name, 1.0)], fdm)
