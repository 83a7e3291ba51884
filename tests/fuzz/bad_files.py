"""Bad scenario and platform files, and overrides."""

from .trying import BadInput, Content, Folder, Hole, Link, Pipe

SCENARIO = """
name = "s"
duration_s = 0.5
[vehicle]
script = "c1722"
[platform]
preset = "atlas-2.9m"
"""
AIRCRAFT = """
name = "s"
duration_s = 0.5
[vehicle]
aircraft = "c172x"
[vehicle.initial]
altitude_m = 1000
airspeed_m_s = 60.0
[platform]
preset = "atlas-2.9m"
"""
INPUT = '[[vehicle.input]]\ntime_s = 0.1\nproperty = "{}"\nvalue = {}\n'
_TRIM = "simulation/do_simple_trim"
_HUGE = 10 * 2**30  # bytes
_LOG = b"\x89MCAP0\r\n" + bytes(300_000)
# Whatever a path may lead to instead of a file of ours; none of it is to be waited for or read to
# its end.
NO_FILES: dict[str, tuple[str, dict[str, Content]]] = {
    "FIFO": ("it", {"it": Pipe()}),
    "/dev/zero": ("/dev/zero", {}),
    "link to /dev/zero": ("it", {"it": Link("/dev/zero")}),
    "folder": ("it", {"it": Folder()}),
    "links in a circle": ("it", {"it": Link("that"), "that": Link("it")}),
    "10 GB of nothing": ("it", {"it": Hole(_HUGE)}),
    "a name of 5 kB": ("x" * 5000, {}),
}


def scenario(name: str, text: str | bytes, *more: str, status: int = 2, says: str = "") -> BadInput:
    """A run of a scenario file with this text."""
    return BadInput(
        name, ("run", "bad.toml", "-o", "new.mcap", *more), {"bad.toml": text}, status, says
    )


def _with(line: str, at: str = "[vehicle]") -> str:
    return SCENARIO.replace(at, f"{line}\n{at}")


_VALUES = {
    "duration": ("duration_s = 0.5", "duration_s = {}", "duration_s"),
    "rate": ('script = "c1722"', 'script = "c1722"\nrate_hz = {}', "vehicle.rate_hz"),
}
VALUES = [
    scenario(f"{key} {value[:20]}", SCENARIO.replace(old, new.format(value)), says=path)
    for key, (old, new, path) in _VALUES.items()
    for value in (
        "1e12",
        "0",
        "-1",
        "1e9",
        "nan",
        "-inf",
        '"long"',
        "true",
        "[1]",
        "1979-05-27",
        "0x" + "f" * 9000,
        "{}",
    )
]
TEXTS = [
    scenario("integer of 5000 digits", _with("description = " + "9" * 5000), says="TOML"),
    scenario("empty file", "", says="name: missing"),
    scenario("NUL bytes", bytes(1000)),
    scenario("not UTF-8", b'name = "\xff"', says="not UTF-8"),
    scenario("UTF-16", ("\ufeff" + SCENARIO).encode("utf-16-le"), says="is UTF-16 text"),
    scenario(
        "a name that turns a line around",
        SCENARIO.replace('"s"', '"a\u202eb"'),
        says="name = 'a\\u202eb'",
    ),
    scenario(
        "a name with an escape", SCENARIO.replace('"s"', '"a\\u001b[2J"'), says="name = 'a\\x1b[2J'"
    ),
    scenario("a name of a number", SCENARIO.replace('"s"', "42"), says='as a text: "42"'),
    scenario("a log", _LOG, says="is a log (MCAP)"),
    scenario("300 kB", SCENARIO + "#" * 300_000, says="too large"),
    scenario(
        "dotted key of 40 kB", ".".join("a" * 20_000) + "=1\n" + SCENARIO, says="too many dots"
    ),
    scenario("20,000 brackets deep", "a = " + "[" * 20_000, says="nested too deeply"),
    scenario("strings without end", 'a = """\\' * 1000),
    scenario("30,000 unknown keys", "".join(f"k{i}=1\n" for i in range(30_000)), says="30000 keys"),
    scenario(
        "5,000 unknown keys",
        "".join(f"k{i}=1\n" for i in range(5000)) + SCENARIO,
        says="unknown key",
    ),
    scenario("a key of 100 kB", "k" * 100_000 + " = 1", says="a key is too long"),
    scenario(
        "description of 200 kB",
        _with(f'description = "{"x" * 200_000}"'),
        says="at most 2000 characters",
    ),
    scenario(
        "60,000 empty inputs",
        AIRCRAFT.replace('"c172x"', '"c172x"\ninput = [' + "{}," * 60_000 + "]"),
        says="60000 tables",
    ),
    scenario(
        "everything mistyped",
        'name=1\nduration_s="a"\nvehicle=3\nplatform=[]\ncueing="x"\nrecording=1\n',
        says="name = 1",
    ),
    scenario("name leads elsewhere", SCENARIO.replace('"s"', '"../s"'), says="name"),
    scenario(
        "a sweep without batch",
        SCENARIO + "[sweep]\nduration_s = [1, 2]",
        says="atlas-cueing batch",
    ),
    scenario(
        "a source of FlightGear beyond the loopback",
        SCENARIO.replace('script = "c1722"', 'source = "flightgear"\nhost = "0.0.0.0"'),
    ),
]
NAMES = [
    scenario("unknown script", SCENARIO.replace("c1722", "c172"), says="did you mean"),
    scenario(
        "script ../..", SCENARIO.replace("c1722", "../../../etc/passwd"), says="vehicle.script"
    ),
    scenario("script /etc/passwd", SCENARIO.replace("c1722", "/etc/passwd"), says="vehicle.script"),
    scenario("script with a NUL", SCENARIO.replace("c1722", "a\\u0000b"), says="vehicle.script"),
    scenario("script of 5 kB", SCENARIO.replace("c1722", "x" * 5000), says="vehicle.script"),
    BadInput(
        "script linked from outside",
        ("run", "bad.toml", "--trust-models"),
        {"bad.toml": SCENARIO.replace("c1722", "x.xml"), "x.xml": Link("/etc/passwd")},
        says="vehicle.script",
    ),
    scenario(
        "script with an escape", SCENARIO.replace("c1722", "a\\u001b.xml"), says="vehicle.script"
    ),
    scenario(
        "a source that is none",
        SCENARIO.replace('script = "c1722"', 'source = "x"\nport = 1'),
        says="vehicle.source",
    ),
    scenario("aircraft ../f16", AIRCRAFT.replace("c172x", "../f16"), says="vehicle.aircraft"),
    scenario("unknown aircraft", AIRCRAFT.replace("c172x", "f61"), says="did you mean 'f16'"),
    scenario(
        "aircraft that does not load",
        AIRCRAFT.replace("c172x", "blank"),
        says="bad.toml: vehicle.aircraft",
    ),
    scenario(
        "aircraft that does not begin",
        AIRCRAFT.replace("c172x", "L17"),
        says="bad.toml: vehicle.aircraft",
    ),
]
_START = "[vehicle.initial]\naltitude_m = 1000\nairspeed_m_s = 60.0\n"
FLIGHTS = [
    scenario("no initial conditions", AIRCRAFT.replace(_START, ""), says="vehicle.initial"),
    scenario("altitude 1e300", AIRCRAFT.replace("1000", "1e300"), says="altitude_m"),
    scenario("airspeed nan", AIRCRAFT.replace("60.0", "nan"), says="airspeed_m_s"),
    scenario(
        "airspeed 20 km/s", AIRCRAFT.replace("60.0", "20000.0"), status=1, says="specific force"
    ),
    scenario("400 m below the sea", AIRCRAFT.replace("1000", "-400"), says="in the ground"),
    scenario(
        "a trim that is not",
        AIRCRAFT.replace("60.0", "5.0\ntrim = true"),
        says="bad.toml: vehicle.initial.trim",
    ),
    scenario(
        "in the ground",
        AIRCRAFT.replace("1000", "0").replace("60.0", "0.0"),
        says="bad.toml: vehicle.initial.altitude_m",
    ),
    scenario(
        "input that trims at once",
        AIRCRAFT + INPUT.format(_TRIM, 2).replace("0.1", "0.0"),
        says=f"{_TRIM!r} = 2",
    ),
    scenario(
        "input that trims where none is",
        AIRCRAFT + INPUT.format(_TRIM, 2),
        status=1,
        says="vehicle failed at 0.1",
    ),
    scenario(
        "input that starts an engine that is none",
        AIRCRAFT + INPUT.format("propulsion/set-running", 1e9),
        status=1,
        says="vehicle failed at 0.1",
    ),
    *[
        scenario(
            f"input {name[:30]} = {value}",
            AIRCRAFT + INPUT.format(name, value),
            says="property" if value != "nan" else "value",
        )
        for name, value in [
            ("fcs/elevatr-cmd-norm", "0"),
            ("fcs/elevator-cmd-norm", "nan"),
            ("", "0"),
            ("velocities/p-rad_sec", "1"),
            ("simulation/write-state-file", "1"),
            ("simulation/dt", "0"),
            ("atmosphere/updownburst/number-of-cells", "1e9"),
            ("a[999999999]", "1"),
            ("[[[", "1"),
            ("../..", "1"),
            ("x" * 5000, "1"),
            ("%s%n", "1"),
        ]
    ],
    scenario(
        "F-16 into the ground",
        AIRCRAFT.replace("c172x", "f16")
        .replace("1000", "300\npitch_deg = -60")
        .replace("60.0", "200.0")
        .replace("0.5", "30"),
        status=1,
        says="vehicle failed at",
    ),
    scenario(
        "Cessna into the ground",
        AIRCRAFT.replace("1000", "150\npitch_deg = -60").replace("0.5", "30"),
        status=1,
        says="vehicle failed at",
    ),
]
OVERRIDES = [
    BadInput(f"--set {text[:40]}", ("run", "good.toml", "--set", text))
    for text in (
        "platform.stage_limits.travel_m=0",
        "platform.stage_limits.jerk_m_s3=1e-248",
        "platform.wheel_limits.speed_rad_s=nan",
        "platform.sphere.radius_m=1e9",
        "platform.rider.head_m=[9,0,0]",
        "platform.wheel.1=1",
        "platform.wheel.7.radius_m=1",
        "platform.wheel.1.drive=[0,0,0]",
        "platform.wheel.1.contact=[1e308,1e308,1e308]",
        "platform.preset=atlas-3m",
        "platform.file=none.toml",
        "=1",
        "no equals sign",
        ".".join("a" * 200) + "=1",
        "cueing.method=[]",
        "cueing.align_rate_deg_s=-3",
        "recording.chunk_ticks=0",
        'recording.skip=["/wheels"]',
        'name="../x"',
        "duration_s=" + "9" * 400,
    )
]
PLATFORMS = [
    BadInput(f"platform {name}: {says}", ("platform", name), {"p.toml": text}, status, says)
    for name, text, status, says in [
        ("nope", "", 2, "no such file or platform"),
        ("good.toml", "", 2, "unknown key"),
        ("p.toml", "", 2, "name: missing"),
        ("p.toml", "[" * 100, 2, "nested"),
        ("p.toml", _LOG, 2, "is a log (MCAP)"),
    ]
]
