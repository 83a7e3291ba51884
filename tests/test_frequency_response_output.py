"""The tables, pictures and messages of the tool that measures gain and phase."""

import json
import subprocess
import sys
from dataclasses import replace
from math import nan
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from frequency_tool import TOOL, tool

from atlas_cueing.signals import STANDARD_GRAVITY as G


def test_attitude_is_one_to_one_over_the_whole_band(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    """As a user does it: twelve frequencies as JSON, and a picture."""
    picture = tmp_path / "response.png"
    options = [
        "--method",
        "attitude",
        "--axis",
        "pitch_rate",
        "--rate-hz",
        "40",
        "--jobs",
        "1",
        "--json",
        "--plot",
        str(picture),
    ]
    assert tool.main(options) == 0
    told = json.loads(capsys.readouterr().out)
    assert (told["platform"], told["rate_hz"], told["force"]) == (
        "atlas-2.9m",
        40.0,
        "follows the attitude",
    )
    points = [tool.Response(**point) for point in told["responses"]]
    turns = [p for p in points if p.answer == "pitch_rate"]
    assert [p.frequency_rad_s for p in turns] == list(tool.FREQUENCIES)
    assert all(abs(p.gain - 1.0) < 0.01 and p.limited_share == 0.0 for p in turns)
    assert abs(tool.delay_ticks(turns, 40.0)) < 0.02
    for p in (p for p in points if p.answer == "force_x"):
        assert p.gain == pytest.approx(G / p.frequency_rad_s, rel=0.02)
        assert (p.pilot_phase_deg, p.phase_deg) == (
            pytest.approx(-90.0, abs=0.1),
            pytest.approx(-90.0, abs=0.5),
        )
    assert shown_colours(picture) > 2


def shown_colours(picture: Path) -> int:
    """Number of colours, greys left out, that fill more than a few pixels."""
    from matplotlib.image import imread

    pixels = np.round(10.0 * imread(picture)[..., :3]).astype(int).reshape(-1, 3)
    coloured = pixels[np.ptp(pixels, axis=1) > 1] @ [1, 11, 121]
    return int(np.sum(np.bincount(coloured, minlength=1) > 50))


def response(**changes: Any) -> Any:
    plain = tool.Response(
        "attitude",
        "rotation to rotation",
        "yaw_rate",
        "yaw_rate",
        1.0,
        1.0,
        0.0,
        0.0,
        1.0,
        0.0,
        0.0,
    )
    return replace(plain, **changes)


def test_table() -> None:
    lines = tool.table(
        [response(phase_deg=-0.5), response(frequency_rad_s=10.0, gain=0.98, limited_share=0.1)],
        120.0,
    )
    assert lines.splitlines() == [
        "attitude: rotation to rotation, gain [-] and phase [deg]; pilot: 1",
        " rad/s      yaw_rate > yaw_rate",
        "     1         1.0000    -0.50 ",
        "    10         0.9800     0.00*",
        "  largest residual 0.0e+00",
        f"  yaw_rate: gain within 2.0e-02 of 1, delay {np.radians(0.5) / 101.0 * 120.0:+.4f} ticks",
    ]


def test_table_of_force_shows_the_pilots_beside() -> None:
    sway = {
        "relation": "rotation to force",
        "driven": "roll_rate",
        "answer": "force_y",
        "pilot_gain": 9.8,
        "pilot_phase_deg": 90.0,
    }
    lines = tool.table(
        [response(**sway, gain=0.0, phase_deg=nan), response(gain=0.5)], 120.0
    ).splitlines()
    assert lines[-1] == "  largest residual 0.0e+00"
    assert "  yaw_rate: gain within 5.0e-01 of 1" in lines
    assert [line for line in lines if "roll_rate" in line] == [
        " rad/s      roll_rate > force_y               pilot"
    ]
    assert [line for line in lines if "9.8" in line] == [
        "     1         0.0000        -      9.8000    90.00"
    ]


def test_pictures_of_nothing_but_yaw(tmp_path: Path) -> None:
    """Three of the four relations are empty, and a phase passes half a turn."""
    points = [
        response(frequency_rad_s=w, phase_deg=p)
        for w, p in ((1.0, -170.0), (2.0, 170.0), (3.0, nan))
    ]
    tool.draw(points, "yaw", tmp_path / "yaw.png")
    assert shown_colours(tmp_path / "yaw.png") > 0


def test_a_platform_at_its_limits_is_told(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(tool, "FREQUENCIES", (10.0,))
    monkeypatch.setattr(tool, "_SETTLED_S", 21.0)
    slow = [
        "--set",
        "platform.wheel_limits.acceleration_rad_s2=0.3",
        "--method",
        "attitude",
        "--axis",
        "yaw_rate",
        "--jobs",
        "1",
    ]
    assert tool.main(slow) == 1
    out, err = capsys.readouterr()
    assert "*" in out
    assert err.startswith(
        "limited: attitude, yaw_rate > yaw_rate at 10 rad/s: the platform fell behind on "
    )


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (["--rate-hz", "5", "--jobs", "1"], "error: rate 5 Hz, allowed: 10 <= rate_hz <= 10000"),
        (["--rotation-deg", "nan"], "error: --rotation-deg nan, allowed: 0 < value <= 45"),
        (["--force-m-s2", "-1"], "error: --force-m-s2 -1, allowed: 0 < value <= 50"),
        (["--jobs", "0"], "error: --jobs 0, allowed: 0 < value <= 1000"),
        (
            ["--plot", "nowhere/x.png"],
            "error: --plot nowhere/x.png, allowed: a file .png, .svg, .pdf in an existing folder",
        ),
        (
            ["--plot", "x.bmp"],
            "error: --plot x.bmp, allowed: a file .png, .svg, .pdf in an existing folder",
        ),
        (["missing.toml"], "error: missing.toml: file: cannot be read: No such file or directory"),
        (
            ["--method", "attitude", "--set", "cueing.methd=1"],
            "error: --set: cueing.methd = 1: unknown key; did you mean 'method'?",
        ),
    ],
)
def test_bad_input(capsys: pytest.CaptureFixture[str], options: list[str], message: str) -> None:
    assert tool.main(options) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert err.startswith(message)


def test_a_plot_needs_its_extra(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(tool, "find_spec", lambda _: None)
    assert tool.main(["--plot", "x.png"]) == 2
    assert "--plot needs matplotlib" in capsys.readouterr().err


def test_the_command_gives_the_same_with_two_processes(capsys: pytest.CaptureFixture[str]) -> None:
    options = [
        "--method",
        "attitude",
        "--axis",
        "roll_rate",
        "--rate-hz",
        "21",
        "--hold-force",
        "--json",
        "--jobs",
    ]
    done = subprocess.run(
        [sys.executable, TOOL, *options, "2"],
        capture_output=True,
        text=True,
        timeout=300,
        check=True,
    )
    assert done.stderr == ""
    assert tool.main([*options, "1"]) == 0
    assert capsys.readouterr().out == done.stdout
    told = json.loads(done.stdout)
    assert told["force"] == "held"
    assert [p["pilot_gain"] for p in told["responses"] if p["answer"] == "force_y"] == [0.0] * len(
        tool.FREQUENCIES
    )
