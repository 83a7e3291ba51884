"""A method of somebody else: what it declares, answers and raises."""

import sys
from dataclasses import dataclass
from math import inf, nan
from typing import Annotated, Any, Literal

import numpy as np
import pytest
from pydantic import BaseModel, Field

from atlas_cueing.cueing.own.own_method import LARGEST_RATE, CheckedRotation, OwnMethod
from atlas_cueing.cueing.parameter import Choice, Range, Switch
from atlas_cueing.errors import InputError, MethodError
from atlas_cueing.signals import VehicleState

UPRIGHT, ZERO = (1.0, 0.0, 0.0, 0.0), (0.0, 0.0, 0.0)


def state(time: float = 0.25) -> VehicleState:
    return VehicleState(time, UPRIGHT, ZERO, (0.0, 0.0, -9.80665))


class Answering:
    """Answers what it was given."""

    def __init__(self, answer: Any) -> None:
        self.answer = answer

    def step(self, vehicle: VehicleState) -> Any:  # noqa: ARG002 - as every method
        if isinstance(self.answer, BaseException):
            raise self.answer
        return self.answer


def checked(answer: Any) -> CheckedRotation:
    return CheckedRotation("mine", Answering(answer))


@pytest.mark.parametrize(
    "answer",
    [
        (UPRIGHT, ZERO),
        ([1, 0, 0, 0], [0, 0, 0]),
        (np.array(UPRIGHT), np.zeros(3)),
        [(1.0005, 0.0, 0.0, 0.0), np.float32([0, 0, 0])],
    ],
)
def test_vectors_of_any_kind_become_tuples_of_floats(answer: Any) -> None:
    assert checked(answer).step(state()) == (UPRIGHT, ZERO)
    q, w = checked(answer).step(state())
    assert {type(number) for number in (*q, *w)} == {float}


@pytest.mark.parametrize(
    ("answer", "reason"),
    [
        (None, "step gave None, allowed: q_WS of four numbers and w_WS_W of three"),
        ((UPRIGHT, (0.0, 0.0)), "allowed: q_WS of four numbers"),
        ((UPRIGHT, "abc"), "allowed: q_WS of four numbers"),
        ((UPRIGHT, (nan, 0.0, 0.0)), "which is not finite"),
        (((nan, 0.0, 0.0, 0.0), ZERO), "which is not finite"),
        ((UPRIGHT, (0.0, -inf, 0.0)), "which is not finite"),
        (((1.1, 0.0, 0.0, 0.0), ZERO), "q_WS of norm 1.1, allowed: 1 within 0.001"),
        (((0.0, 0.0, 0.0, 0.0), ZERO), "q_WS of norm 0"),
        ((UPRIGHT, (0.0, 0.0, 1e200)), f"allowed: at most {LARGEST_RATE:g} rad/s"),
        (ZeroDivisionError("by me"), "ZeroDivisionError: by me (test_own_method.py, line"),
        (SystemExit(3), "SystemExit: 3"),
        (RecursionError("a\nb"), "RecursionError: a b"),
    ],
)
def test_what_is_no_cue_is_an_error_with_name_and_time_for_good(answer: Any, reason: str) -> None:
    rotation = checked(answer)
    with pytest.raises(MethodError) as first:
        rotation.step(state(0.25))
    assert str(first.value).startswith("method 'mine' at 0.250000 s: ")
    assert reason in str(first.value)
    rotation._own.answer = UPRIGHT, ZERO  # type: ignore[attr-defined]
    with pytest.raises(MethodError) as second:
        rotation.step(state(0.5))
    assert str(second.value) == str(first.value)


def test_a_ctrl_c_in_it_is_no_failure_of_the_method() -> None:
    with pytest.raises(KeyboardInterrupt):
        checked(KeyboardInterrupt()).step(state())


def test_the_sign_of_the_quaternion_does_not_jump() -> None:
    rotation = checked((UPRIGHT, ZERO))
    rotation.step(state())
    rotation._own.answer = (-1.0, 0.0, 0.0, 0.0), ZERO  # type: ignore[attr-defined]
    assert rotation.step(state())[0] == UPRIGHT


class Many:
    """Has a parameter of each kind.

    More words.
    """

    version = 3

    @dataclass(frozen=True, slots=True)
    class Parameters:
        turn_deg_s: Annotated[float, Field(ge=0, le=90, description="turn at most")] = 3.0
        order: Annotated[int, Field(gt=0, lt=9)] = 2
        fast: bool = False
        kind: Literal["one", "two"] = "one"
        gain: tuple[float, float, float] = (1.0, 1.0, 0.5)
        free: float = 0.0

    def __init__(self, dt: float, parameters: Any) -> None:
        self.dt, self.parameters = dt, parameters

    def step(self, vehicle: VehicleState) -> Any:  # noqa: ARG002 - as every method
        return UPRIGHT, ZERO


class Model(BaseModel):
    turn_deg_s: float = Field(3.0, ge=0, le=90, description="turn at most")
    order: int = Field(2, gt=0, lt=9)
    fast: bool = False
    kind: Literal["one", "two"] = "one"
    gain: tuple[float, float, float] = (1.0, 1.0, 0.5)
    free: float = 0.0


@pytest.mark.parametrize("model", [Many.Parameters, Model])
def test_parameters_are_declared_as_ours_are(model: Any) -> None:
    made_by = type("Many", (Many,), {"Parameters": model, "__doc__": Many.__doc__})
    method = OwnMethod.of_class(made_by, "many.py:Many", digest="d")
    assert method.summary == "Has a parameter of each kind"
    assert method.metadata() == {"method_version": "3", "method_sha256": "d"}
    allowed = {p.key: p.allowed for p in method.parameters}
    assert allowed == {
        "turn_deg_s": Range(0, 90),
        "order": Range(0, 9, above=True),
        "fast": Switch(),
        "kind": Choice(("one", "two")),
        "gain": Range(-1e9, 1e9),
        "free": Range(-1e9, 1e9),
    }
    turn = method.parameters[0]
    assert (turn.unit.symbol, turn.description) == ("deg/s", "turn at most")
    assert [p.default(method.defaults) for p in method.parameters] == [
        3.0,
        2,
        False,
        "one",
        (1.0, 1.0, 0.5),
        0.0,
    ]
    assert "turn_deg_s = 3.0 (0 <= value <= 90 deg/s): turn at most" in method.reference()
    values = {p.key: p.default(method.defaults) for p in method.parameters}
    rotation = method.with_values(values | {"turn_deg_s": 9.0, "order": 5.0}).rotation(0.01)
    own = rotation._own
    assert (own.dt, own.parameters.turn_deg_s, own.parameters.order) == (0.01, 9.0, 5)
    assert type(own.parameters.order) is int


def test_without_parameters_it_gets_the_step_alone() -> None:
    class Plain:
        def __init__(self, dt: float) -> None:
            self.dt = dt

        step = Many.step

    method = OwnMethod.of_class(Plain, "plain")
    assert (method.parameters, method.metadata()) == ((), {})
    assert method.with_values({"stage": None}).rotation(0.5)._own.dt == 0.5


def declaring(**fields: Any) -> Any:
    model = type("Parameters", (), {"__annotations__": {k: t for k, (t, _) in fields.items()}})
    for key, (_, default) in fields.items():
        if default is not None:
            setattr(model, key, default)
    return type("Mine", (Many,), {"Parameters": dataclass(model)})


@pytest.mark.parametrize(
    ("made_by", "refusal"),
    [
        (3, "allowed: a class with a method step"),
        (int, "allowed: a class with a method step"),
        (type("Mine", (Many,), {"Parameters": int}), "allowed: a dataclass or a pydantic model"),
        (declaring(stage=(float, 1.0)), "stage: is a key of every method"),
        (declaring(names=(list, ())), "names: is <class 'list'>, allowed: float, int, bool"),
        (declaring(gain=(float, None)), "gain: "),
    ],
)
def test_what_is_no_method_is_refused(made_by: Any, refusal: str) -> None:
    with pytest.raises(InputError, match=refusal):
        OwnMethod.of_class(made_by, "mine")


def test_what_its_beginning_raises_is_bad_input() -> None:
    class Broken(Many):
        def __init__(self, *_: Any) -> None:
            sys.exit("no licence")

    with pytest.raises(InputError, match="method 'mine': does not begin: SystemExit: no licence"):
        OwnMethod.of_class(Broken, "mine").defaults.rotation(0.01)
