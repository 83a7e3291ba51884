"""Geometries for the tests: the pinned oracle, the paper's layout, any three wheels."""

import json
from math import cos, sin, sqrt
from pathlib import Path

from hypothesis import assume
from hypothesis import strategies as st

from atlas_cueing.rotation import cross, norm
from atlas_cueing.wheels import Geometry, OmniWheel

ORACLES = json.loads((Path(__file__).parents[1] / "oracles" / "kinematics.json").read_text())
REGULAR = [case for case in ORACLES if case["slip_free"]]
SINGULAR = [case for case in ORACLES if not case["slip_free"]]

number = st.floats(-1.0, 1.0)
vector = st.tuples(number, number, number).filter(lambda v: norm(v) > 0.1)


def geometry_of(case: dict) -> Geometry:
    rows = zip(case["contact"], case["drive"], case["wheel_radius_m"], strict=True)
    first, second, third = (
        OmniWheel.along(tuple(contact), tuple(drive), radius) for contact, drive, radius in rows
    )
    return Geometry(case["name"], case["sphere_radius_m"], (first, second, third))


def equilateral(elevation: float) -> Geometry:
    c, s, h = cos(elevation), sin(elevation), 0.5 * sqrt(3.0)
    contacts = [(c, 0.0, -s), (-0.5 * c, -h * c, -s), (-0.5 * c, h * c, -s)]
    drives = [(0.0, -1.0, 0.0), (-h, 0.5, 0.0), (h, 0.5, 0.0)]
    first, second, third = (
        OmniWheel.along(r, v, 0.08) for r, v in zip(contacts, drives, strict=True)
    )
    return Geometry("equilateral", 0.75, (first, second, third))


@st.composite
def geometries(draw: st.DrawFn) -> Geometry:
    """Any three wheels that can turn the sphere."""
    wheels = []
    for _ in range(3):
        contact, other = draw(vector), draw(vector)
        tangent = cross(contact, other)
        assume(norm(tangent) > 0.05)
        wheels.append(OmniWheel.along(contact, tangent, draw(st.floats(0.01, 0.5))))
    geometry = Geometry("drawn", draw(st.floats(0.1, 5.0)), (wheels[0], wheels[1], wheels[2]))
    assume(geometry.condition_number < 1e3)
    return geometry
