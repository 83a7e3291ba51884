"""Each method is declared once, whole, and is in the table."""

from dataclasses import fields, is_dataclass
from importlib import import_module
from math import inf
from pkgutil import iter_modules
from typing import Any

import pytest

import atlas_cueing.cueing
from atlas_cueing.cueing import CAUSAL_METHODS, METHODS, Method
from atlas_cueing.cueing.parameter import Choice, Parameter
from atlas_cueing.cueing.stage.stage_parameters import FORCE_GAIN, STAGE, StageParameters

EACH = pytest.mark.parametrize("method", METHODS.values(), ids=lambda method: method.name)
PARAMETERS = [
    *(
        (parameter, method.defaults)
        for method in METHODS.values()
        for parameter in method.parameters
    ),
    *((parameter, method.stage) for method in METHODS.values() for parameter in STAGE),
]
FIXED_OF_STAGE = {"mpc.blocks", "mpc.fade", "mpc.excess", "mpc.doubt"}
"""Fields of the stage that a user is not to choose."""


def declared() -> set[str]:
    """Names of the modules in `cueing` that declare a method or define parameters of one."""
    found = set()
    for module in iter_modules(atlas_cueing.cueing.__path__):
        content = vars(import_module(f"atlas_cueing.cueing.{module.name}"))
        own = [x for x in content.values() if isinstance(x, type) and is_dataclass(x)]
        makers = [x for x in own if hasattr(x, "rotation") or hasattr(x, "plan")]
        if any(isinstance(x, Method) for x in content.values()) or makers:
            found.add(module.name)
    return found


def leaves(parameters: Any, before: str = "") -> set[str]:
    """Names of all fields, those of dataclasses within as `turn.rate`."""
    names: set[str] = set()
    for field in fields(parameters):
        value, name = getattr(parameters, field.name), before + field.name
        names |= leaves(value, f"{name}.") if is_dataclass(value) else {name}
    return names


def test_every_declared_method_is_in_the_table() -> None:
    assert declared() == set(METHODS)


@EACH
def test_a_method_has_the_name_of_its_module(method: Method) -> None:
    assert import_module(f"atlas_cueing.cueing.{method.name}").METHOD is method
    assert METHODS[method.name] is method


def test_preview_alone_needs_the_whole_flight() -> None:
    assert set(METHODS) - set(CAUSAL_METHODS) == {"preview"}


@EACH
def test_every_field_has_a_key_or_is_fixed(method: Method) -> None:
    """A parameter without a key could not be chosen, and nothing else would say so."""
    keys = {p.field for p in method.parameters}
    assert keys | set(method.fixed) == leaves(method.defaults)
    assert not keys & set(method.fixed)


def test_every_field_of_the_stage_has_a_key_or_is_fixed() -> None:
    keyed = {p.field for p in (FORCE_GAIN, *STAGE)}
    assert keyed == leaves(StageParameters()) - FIXED_OF_STAGE


@EACH
def test_no_key_stands_twice_but_the_gain_that_method_and_stage_share(method: Method) -> None:
    keys = [parameter.key for parameter in method.parameters]
    assert len(set(keys)) == len(keys)
    shared = [parameter for parameter in method.parameters if parameter.key == FORCE_GAIN.key]
    for parameter in shared:
        assert parameter.default(method.defaults) == FORCE_GAIN.default(method.stage)


@pytest.mark.parametrize(("parameter", "defaults"), PARAMETERS)
def test_defaults_are_allowed(parameter: Parameter, defaults: object) -> None:
    default, allowed = parameter.default(defaults), parameter.allowed
    if isinstance(allowed, Choice):
        assert default in allowed.words
        return
    for value in default if isinstance(default, tuple) else (default,):
        assert value is None or allowed.lower <= float(value) <= allowed.upper < inf
        assert value != allowed.lower or not allowed.above


@pytest.mark.parametrize("parameter", [parameter for parameter, _ in PARAMETERS])
def test_each_parameter_says_what_it_does_and_where_from(parameter: Parameter) -> None:
    assert parameter.description[:1].islower()
    assert parameter.source
    assert not (parameter.description + parameter.source).endswith(".")
    assert "\n" not in parameter.description + parameter.source


@EACH
def test_the_reference_has_each_key_with_unit_range_default_and_source(method: Method) -> None:
    lines = method.reference().splitlines()
    assert lines[0] == f"Method `{method.name}`: {method.summary}."
    for parameter in method.parameters:
        (line,) = (line for line in lines if line.startswith(f"{parameter.key} = "))
        for part in (parameter.unit.symbol, str(parameter.allowed), parameter.description):
            assert part in line
        default = parameter.default(method.defaults)
        assert ("(none)" if default is None else str(default)) in line
        assert line.endswith(parameter.source)


def test_an_entry_of_the_reference_reads_well() -> None:
    lines = METHODS["blend"].reference().splitlines()
    assert (
        "align_rate_deg_s = 3.0 (0 < value <= 90 deg/s): largest rate of the turn that the vehicle"
        " does not make; 3 deg/s is the customary limit (Groen & Bles, J. Vestibular Research 14,"
        " 2004)" in lines
    )
    assert any(line.startswith("stage.travel_m = (none) (") for line in lines)
