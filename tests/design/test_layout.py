"""Symmetric layouts: closed forms, round trips and the file of a designed platform."""

from math import acos, cos, degrees, radians, sin, sqrt
from pathlib import Path

import numpy as np
import pytest

from atlas_cueing.design import Layout, layout_of, with_layout
from atlas_cueing.design.layout import clearance, wheel_gap
from atlas_cueing.errors import InputError
from atlas_cueing.scenario import load_platform, presets
from atlas_cueing.scenario.designed_platform import designed_text
from atlas_cueing.scenario.load_tables import PreloadTable

ATLAS = load_platform("atlas-2.9m")


def test_presets_are_found_again() -> None:
    assert layout_of(ATLAS).elevation == pytest.approx(40.0, abs=1e-9)
    assert layout_of(ATLAS).skew == pytest.approx(0.0, abs=1e-9)
    skewed = layout_of(load_platform("atlas-skewed"))
    assert (skewed.elevation, skewed.skew) == pytest.approx((30.0, 48.1897), abs=1e-3)


@pytest.mark.parametrize("name", ["atlas-2.9m", "atlas-skewed", "atlas-2.9m-halo", "atlas-1.5m"])
def test_a_platform_laid_out_as_it_is_stays_as_it_is(name: str) -> None:
    platform = load_platform(name)
    again = with_layout(platform, layout_of(platform))
    for one, other in zip(platform.wheel, again.wheel, strict=True):
        np.testing.assert_allclose(other.wheel().contact, one.wheel().contact, atol=1e-12)
        np.testing.assert_allclose(other.wheel().drive, one.wheel().drive, atol=1e-12)
    assert again.drive == platform.drive


@pytest.mark.parametrize("elevation", [20.0, 30.0, 40.0, 50.0])
def test_isotropic_at_any_elevation(elevation: float) -> None:
    skew = degrees(acos(1.0 / sqrt(3.0) / cos(radians(elevation))))
    turned = with_layout(ATLAS, Layout(elevation, skew, 17.0, 0.15, 10.0))
    assert turned.geometry().condition_number == pytest.approx(1.0, abs=1e-12)


def test_wheels_that_are_not_alike_are_refused() -> None:
    with pytest.raises(InputError, match="not alike and evenly around z"):
        layout_of(load_platform("atlas-orthogonal"))


def test_the_motor_stays_when_the_gear_is_another() -> None:
    geared = with_layout(ATLAS, Layout(40.0, 0.0, 0.0, 0.15, 5.0))
    assert geared.drive
    assert geared.drive.torque_n_m == 300.0
    assert geared.drive.gear == 5.0
    assert geared.drive.motor_speed_rad_s == 320.0


def test_room() -> None:
    """Horizontal drives: the axle lies in the vertical plane through the contact."""
    theta = radians(40.0)
    lowest = -(1.45 + 0.15) * sin(theta) - 0.15 * sqrt(1.0 - cos(theta) ** 2)
    assert clearance(ATLAS) == pytest.approx(1.45 + lowest, abs=1e-9)
    assert wheel_gap(ATLAS) == pytest.approx(sqrt(3.0) * 1.6 * cos(theta) - 0.3, abs=1e-9)


def test_the_file_reads_as_the_platform_and_keeps_what_is_assumed(tmp_path: Path) -> None:
    more = PreloadTable(contact=(0.0, 0.0, 1.0), force_n=4000.0)
    designed = with_layout(ATLAS, Layout(31.5, 44.25, 12.0, 0.2, 8.0)).model_copy(
        update={"name": "atlas-2.9m-designed", "preload": (more,)}
    )
    text = designed_text(presets()["atlas-2.9m"], designed, "designed here", ("designed by me",))
    (tmp_path / "new.toml").write_text(text)
    assert load_platform(str(tmp_path / "new.toml")) == designed
    assert text.startswith("# designed by me\n")
    old = presets()["atlas-2.9m"].read_text()
    assert text.count("# assumed") == old.count("# assumed") - 3 - 2  # radii, gear and torque
    assert text.count("# designed here") == 3 * 3 + 2 + 1
    assert "Published: equilateral layout" not in text


def test_a_source_with_numbers_on_several_lines_is_written_anew(tmp_path: Path) -> None:
    old = presets()["atlas-2.9m"].read_text()
    source = tmp_path / "mine.toml"
    source.write_text(old.replace("drive = [0.0, -1.0, 0.0]", "drive = [\n0.0, -1.0,\n0.0]"))
    designed = with_layout(ATLAS, Layout(31.5, 44.25, 12.0, 0.15, 10.0))
    text = designed_text(source, designed, "designed here", ("designed by me",))
    (tmp_path / "new.toml").write_text(text)
    assert load_platform(str(tmp_path / "new.toml")) == designed
    assert "whose comments say" in text
