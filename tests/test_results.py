"""The comparison of rides: its arithmetic by hand, and the tool on two short flights."""

import json
import subprocess
import sys
from math import exp, log, nextafter, radians, sqrt
from pathlib import Path

import pytest
from flight_sets import CONSTANTS, SETS, UNSEEN, by_set
from rides import figures as ride_figures
from rides import page, trade_off
from rides.figures import Figures, figures, geometric_mean, means, mismatch_3, paired, worse
from rides.flying import Kept, Order, faults, flown
from rides.results import FlightSet, by_the_rule, flight_set

ROOT = Path(__file__).parents[1]
SCENARIOS = ROOT / "scenarios"


def metrics(m: tuple[float, float, float], **more: float) -> dict[str, float]:
    """Those of a ride whose mismatch has these legs: magnitude, direction, rate."""
    legs = dict(zip(("magnitude", "direction", "rate"), m, strict=True))
    return {
        "direction_rms_rad": radians(3.0),
        "force_rms_m_s2": 2.0,
        "perceived_rate_rms_rad_s": radians(4.0),
        "mismatch": sqrt(sum(x * x for x in m)),
        **{f"mismatch_{leg}": value for leg, value in legs.items()},
        "mismatch_worst_10s": 9.0,
        "perceived_tilt_rms_rad": radians(5.0),
        "perceived_turn_rms_rad_s": radians(6.0),
        **more,
    }


def ride(r: float, r3: float) -> Figures:
    return Figures(*[1.0] * 4, R=r, R3=r3, worst=1.0, tilt=1.0, turn=1.0)


def test_a_rate_error_counts_three_times() -> None:
    assert mismatch_3(metrics((2.0, 3.0, 2.0))) == pytest.approx(7.0)
    found = figures(metrics((2.0, 3.0, 2.0)), metrics((0.0, 14.0, 0.0)))
    ratios = [found.R, found.R3]
    assert ratios == pytest.approx([sqrt(17.0) / 14.0, 0.5])
    assert (found.direction, found.rate, found.tilt, found.turn) == pytest.approx((3, 4, 5, 6))
    assert (found.force, found.worst) == (2.0, 9.0)


def test_what_is_not_felt_is_no_difference() -> None:
    found = figures(metrics((0.1, 0.1, 0.1)), metrics((0.5, 0.0, 0.0)))
    assert (found.R, found.R3) == (1.0, 1.0)


def test_means_of_ratios_are_geometric() -> None:
    assert geometric_mean([0.25, 1.0]) == pytest.approx(0.5)
    found = means([ride(0.25, 4.0), ride(1.0, 1.0)])
    assert (found["R"], found["R3"], found["together"]) == pytest.approx((0.5, 2.0, 1.0))
    assert worse([ride(1.0, 9.0), ride(1.01, 0.1), ride(0.9, 1.0)]) == (1, 1.01)


def test_paired_ratios() -> None:
    same = paired([1.0, 2.0, 3.0], [1.0, 2.0, 3.0])
    assert (same.ratio, same.low, same.high, same.wins, same.losses) == (1.0, 1.0, 1.0, 0, 0)
    half = paired([1.0, 2.0], [2.0, 4.0])
    assert (half.ratio, half.low, half.high, half.wins) == pytest.approx((0.5, 0.5, 0.5, 2))
    mixed = paired([1.0, 2.0, 0.9, 1.0], [2.0, 2.0, 0.6, 1.005])
    assert mixed.low < mixed.ratio < mixed.high
    assert (mixed.wins, mixed.losses) == (1, 1)
    assert mixed == paired([1.0, 2.0, 0.9, 1.0], [2.0, 2.0, 0.6, 1.005])  # seeded


def test_the_interval_is_that_of_the_mean() -> None:
    """Against the normal approximation, of forty flights."""
    logs = [0.1 + 0.3 * ((17 * k) % 40 / 20.0 - 0.975) for k in range(40)]
    found = paired([exp(x) for x in logs], [1.0] * 40)
    mean = sum(logs) / 40
    error = sqrt(sum((x - mean) ** 2 for x in logs)) / 40
    assert log(found.ratio) == pytest.approx(mean)
    assert log(found.low) == pytest.approx(mean - 1.645 * error, abs=0.1 * error)
    assert log(found.high) == pytest.approx(mean + 1.645 * error, abs=0.1 * error)


def test_the_rule() -> None:
    """The lowest of R and R3 together, of those that do no harm beyond 5 % on any flight."""
    flights = {
        "a": {"still": ride(1, 1), "x": ride(0.5, 0.5), "y": ride(0.4, 0.9), "z": ride(0.1, 0.1)},
        "b": {
            "still": ride(1, 1),
            "x": ride(1.05, 1.5),
            "y": ride(0.9, 0.9),
            "z": ride(nextafter(1.05, 2), 0.1),
        },
    }
    found = FlightSet("own", "nothing", flights)
    assert by_the_rule(found, ["still", "x", "y", "z"]) == ["y", "x"]


def test_a_dispute_is_told_where_both_have_an_opinion() -> None:
    def of(m: float, tilt: float, turn: float) -> Figures:
        return Figures(1.0, 1.0, 1.0, m, R=1.0, R3=1.0, worst=1.0, tilt=tilt, turn=turn)

    one = of(10.0, 4.0, 9.0)
    assert one.observed == pytest.approx(5.0)
    flights = {
        "agree": {"x": one, "y": of(11.0, 4.0, 12.0)},
        "disagree": {"x": one, "y": of(11.0, 4.0, 6.0)},
        "the other way": {"x": one, "y": of(9.0, 6.0, 9.0)},
        "hardly": {"x": one, "y": of(10.4, 4.0, 6.0)},
    }
    assert FlightSet("a", "b", flights).disputed("x", "y") == ["disagree", "the other way"]


def test_the_sets_are_bundled_flights_and_apart() -> None:
    names = {path.stem for path in SCENARIOS.glob("*.toml")}
    assert set(CONSTANTS) | set(UNSEEN) <= names
    assert not set(CONSTANTS) & set(UNSEEN)
    assert len(UNSEEN) >= 12
    sets = by_set([SCENARIOS / f"{name}.toml" for name in sorted(names)])
    assert list(sets) == list(SETS)
    assert [len(paths) for paths in sets.values()][1:] == [len(CONSTANTS), len(UNSEEN)]
    assert list(by_set([SCENARIOS / "f15_break.toml"])) == ["unseen"]


@pytest.fixture
def short(tmp_path: Path) -> Path:
    """A flight of half a second."""
    path = tmp_path / "short.toml"
    path.write_text('name = "short"\nduration_s = 0.5\n[vehicle]\nscript = "rudder_kick"\n'
                    '[platform]\npreset = "atlas-2.9m"\n')  # fmt: skip
    return path


def test_rides_are_flown_once(short: Path, tmp_path: Path) -> None:
    """What is cut off or belongs to another flight is flown."""
    orders = [Order(short, (f"cueing.method={name}",)) for name in ("still", "force")]
    bad = Order(short, ("cueing.method=none",))
    kept, said = Kept(tmp_path / "rides"), list[str]()
    rides = flown([*orders, bad, orders[0]], kept, 1, said.append)
    assert [ride["result"] for ride in rides.values()] == ["ok", "ok", "refused"]
    (fault,) = faults(rides)
    assert "none" in fault
    (set_of_one,) = [flight_set("a", "b", [short], ["still", "force"], rides)]
    assert set_of_one.flights["short"]["still"].R == 1.0
    assert said[0] == "3 rides, 0 of them flown before"
    said.clear()
    assert flown(orders, kept, 1, said.append) == {order: rides[order] for order in orders}
    assert said == ["2 rides, 2 of them flown before"]
    files = sorted((tmp_path / "rides").rglob("*.json"))
    assert len(files) == 3
    for file in files:
        file.write_text(file.read_text()[:40])
    assert kept.get(orders[0]) is None
    short.write_text(short.read_text().replace("0.5", "0.25"))
    assert flown(orders[:1], kept, 1, said.append)[orders[0]]["ticks"] < rides[orders[0]]["ticks"]


def test_the_picture(short: Path, tmp_path: Path) -> None:
    asked = trade_off.orders([short], ["still", "blend"])
    assert [len(values) for values in asked.values()] == [1, 1 + len(trade_off.SWEPT["blend"][1])]
    rides = {
        order: {"result": "ok", "metrics": metrics((1.0, 1.0, 1.0))}
        for values in asked.values()
        for orders in values.values()
        for order in orders
    }
    curves = trade_off.curves(asked, rides)
    assert curves["still"] == [trade_off.Point(None, pytest.approx(3.0), pytest.approx(4.0))]
    trade_off.draw(curves, "title", tmp_path / "a.svg")
    trade_off.draw(curves, "title", tmp_path / "b.svg")
    assert (tmp_path / "a.svg").read_bytes() == (tmp_path / "b.svg").read_bytes()
    assert "title" in (tmp_path / "a.svg").read_text()


def test_every_swept_key_is_one_of_its_method() -> None:
    from atlas_cueing.cueing import METHODS

    for name, (key, values) in trade_off.SWEPT.items():
        if name in METHODS and key:
            assert key in {parameter.key for parameter in METHODS[name].parameters}
            assert len(values) > 3


def test_the_tool_on_one_short_flight(short: Path, tmp_path: Path) -> None:
    """Page, figures and exit status; the figures are those of the page."""
    words = [short, "--methods", "force", "--jobs", "1", "--folder", tmp_path / "rides"]
    tool = [sys.executable, ROOT / "tools" / "results", *words]
    printed = subprocess.run(tool, capture_output=True, text=True, check=True)
    written = subprocess.run(
        [*tool, "--write", "--into", tmp_path], capture_output=True, check=True
    )
    assert not written.stdout
    text = (tmp_path / "RESULTS.md").read_text()
    assert text == printed.stdout.removesuffix("\n")
    found = json.loads((tmp_path / "results.json").read_text())
    (of_set,) = found["sets"].values()
    force = of_set["flights"]["short"]["force"]
    assert set(force) == set(ride_figures.NAMES)
    assert f"| short | force | {force['direction']:.1f} |" in text
    assert page.number("R", of_set["summary"]["force"]["R"]) in text
    assert "rides that failed or broke a limit: 0" in text


def test_the_tool_refuses_an_unknown_method(short: Path) -> None:
    tool = [sys.executable, ROOT / "tools" / "results", short, "--methods", "force,nonsense"]
    done = subprocess.run(tool, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout) == (2, "")
    assert "nonsense" in done.stderr
