"""Bad sweeps, and so many runs that somebody might wait for them."""

from .bad_files import AIRCRAFT, INPUT, SCENARIO
from .trying import BadInput, Content

_ONE_PLACE = "".join(
    f"platform.wheel.{i}.contact = [[1, 0, 0]]\nplatform.wheel.{i}.drive = [[0, 1, 0]]\n"
    for i in (0, 1)
)


def _swept(sweep: str, text: str = SCENARIO) -> dict[str, Content]:
    return {"bad.toml": f"{text}\n[sweep]\n{sweep}"}


def _batch(name: str, sweep: str, says: str = "", text: str = SCENARIO) -> BadInput:
    return BadInput(name, ("batch", "bad.toml", "-o", "new"), _swept(sweep, text), says=says)


SWEEPS = [
    _batch(
        "1e9 runs of a grid",
        "".join(f"cueing.k{i}=[1,2,3,4,5,6,7,8]\n" for i in range(10)),
        "1073741824 runs",
    ),
    _batch("1e9 draws", "draws = 1000000000\nduration_s = { low = 1, high = 2 }", "sweep.draws"),
    _batch(
        "10,000 runs, the last one wrong",
        "duration_s = [" + "1, " * 9999 + "-1]",
        "duration_s = -1",
    ),
    _batch("10,000 wrong runs", "duration_s = [" + "-1, " * 10_000 + "]", "duration_s = -1"),
    _batch(
        "a range without end", "draws = 3\nduration_s = { low = 0, high = inf }", "sweep.duration_s"
    ),
    _batch(
        "a range upside down", "draws = 3\nduration_s = { low = 2, high = 1 }", "sweep.duration_s"
    ),
    _batch("a pattern of 100 kB", f'vehicle.script = "{"*a" * 50_000}"', "pattern is too long"),
    _batch("19,000 keys", "".join(f"k{i}=[1]\n" for i in range(19_000)), "keys"),
    _batch(
        "4,000 inputs in 2,000 runs",
        "duration_s = [" + "1, " * 2000 + "]",
        "keys",
        AIRCRAFT + INPUT.format("a", 1) * 4000,
    ),
    _batch(
        "500 spheres on wheels in one place",
        f"draws = 500\nplatform.sphere.radius_m = {{ low = 1, high = 2 }}\n{_ONE_PLACE}",
        "slip",
    ),
    BadInput(
        "a platform file of 250 kB wrong in its end, 9,000 runs",
        ("batch", "bad.toml", "-o", "new"),
        {
            **_swept(
                "duration_s = [" + "1, " * 9000 + "]",
                SCENARIO.replace('preset = "atlas-2.9m"', 'file = "p.toml"'),
            ),
            "p.toml": "#\n" * 120_000 + "[",
        },
        says="p.toml: TOML",
    ),
]
