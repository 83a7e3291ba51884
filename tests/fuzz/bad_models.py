"""Bad scripts of JSBSim beside a scenario."""

from .bad_files import AIRCRAFT, SCENARIO
from .trying import BadInput, Content, Link

_SCRIPT = (
    '<runscript><use aircraft="c172x" initialize="reset00"/><run start="0" end="0.5"'
    ' dt="0.01">{}</run></runscript>'
)
_EVENT = "<event><condition>simulation/sim-time-sec ge 0.1</condition>{}</event>"
_SET = _EVENT.format('<set name="fcs/elevator-cmd-norm"{}</set>')
_MODEL = '<fdm_config name="x" version="2.0">{}</fdm_config>'
_BOMB = "".join(f'<!ENTITY {b} "{f"&{a};" * 30}">' for a, b in zip("abcdef", "bcdefg", strict=True))


def _script(
    name: str, text: str, says: str = "", *, status: int = 2, trusted: bool = True
) -> BadInput:
    files = {"bad.toml": SCENARIO.replace("c1722", "bad.xml"), "bad.xml": text}
    return BadInput(
        name, ("run", "bad.toml", *(["--trust-models"] if trusted else [])), files, status, says
    )


def _run(name: str, inside: str, says: str = "", *, status: int = 2) -> BadInput:
    return _script(name, _SCRIPT.format(inside), says, status=status)


def _changed(name: str, old: str, new: str, says: str) -> BadInput:
    return _script(name, _SCRIPT.format("").replace(old, new), says)


def _set(name: str, rest: str, says: str = "", *, status: int = 2) -> BadInput:
    return _run(name, _SET.format(rest), says, status=status)


SCRIPTS = [
    _script("without --trust-models", _SCRIPT.format(""), "--trust-models", trusted=False),
    _script("no XML", "hello", "not a readable XML file"),
    _script("empty", "", "not a readable XML file"),
    _script("a script's name for something else", "<fdm_config/>", "root element"),
    _script("2 MB", _SCRIPT.format(f"<!--{'x' * 2_000_000}-->"), "at most 1048576"),
    _script("200,000 elements deep", "<runscript>" + "<a>" * 200_000, "nested deeper"),
    _script(
        "entity bomb",
        f'<!DOCTYPE r [<!ENTITY a "aaaaaaaaaa">{_BOMB}]><runscript>&g;</runscript>',
        "amplification",
    ),
    _script(
        "entity of another file",
        '<!DOCTYPE r [<!ENTITY a SYSTEM "file:///etc/passwd">]><runscript>&a;</runscript>',
        "entity",
    ),
    _script("no run", '<runscript><use aircraft="c172x" initialize="reset00"/></runscript>', "run"),
    _changed("two aircraft", "<run ", '<use aircraft="f16"/><run ', "<use>"),
    _changed("aircraft ../f16", '"c172x"', '"../f16"', "no aircraft"),
    _changed("initialize ../x", "reset00", "../x", "initialize"),
    _changed("initialize /etc/fstab", "reset00", "/etc/fstab", "initialize"),
    _changed("end 1e12", 'end="0.5"', 'end="1e12"', "end = 1e12"),
    _changed("end nan", 'end="0.5"', 'end="nan"', "end = nan"),
    _changed("dt -1", 'dt="0.01"', 'dt="-1"', "dt = -1"),
    _changed("dt 0", 'dt="0.01"', 'dt="0"', "dt = 0"),
    _changed("dt nan", 'dt="0.01"', 'dt="nan"', "dt = nan"),
    _run(
        "reference to a file",
        '<event><set name="a" file="/etc/passwd"/></event>',
        "file='/etc/passwd'",
    ),
    _run("100,000 events", "<event/>" * 100_000, "JSBSim cannot load it"),
    _run(
        "misspelt property",
        _SET.format(' value="1">').replace("elevator", "elevtor"),
        "did you mean 'fcs/elevator",
    ),
    _run(
        "unknown comparison",
        _SET.format(' value="1">').replace(" ge ", " gee "),
        "JSBSim cannot load it",
    ),
    _run(
        "condition on nothing",
        _SET.format(' value="1">').replace("simulation/sim-time-sec", "no/body"),
        "no/body",
        status=1,
    ),
    _run(
        "a name that ends the process",
        _SET.format(' value="1">').replace("fcs/elevator-cmd-norm", "a b[["),
        "JSBSim cannot load it",
    ),
    _run(
        "clock held",
        _SET.format(' value="1">').replace("fcs/elevator-cmd-norm", "simulation/pause"),
        "stands still",
        status=1,
    ),
    _set(
        "elevator of NaN",
        "><function><acos><value>2</value></acos></function>",
        "specific force nan",
        status=1,
    ),
    _set("value of text", ' value="abc">', "numeric"),
    _set("empty table", "><function><table/></function>", "JSBSim cannot load it"),
    _set("unknown function", "><function><foo/></function>", "JSBSim cannot load it"),
    _set("empty function", "><function/>", "JSBSim cannot load it"),
    _set("random text", '><function><urandom lower="a"/></function>', "numeric"),
    _run(
        "a clock set back for ever",
        '<event persistent="true"><condition>simulation/sim-time-sec ge 0.02</condition>'
        '<set name="simulation/reset" value="1"/></event>',
        "its end never comes",
        status=1,
    ),
]


def _model(name: str, text: str, says: str, *, trusted: bool = True, **more: Content) -> BadInput:
    """An aircraft beside a scenario, and more files by path."""
    files: dict[str, Content] = {
        "bad.toml": AIRCRAFT.replace("c172x", "mine"),
        "aircraft/mine/mine.xml": text,
    }
    return BadInput(
        name,
        ("run", "bad.toml", *(["--trust-models"] if trusted else [])),
        {**files, **more},
        says=says,
    )


def _naming(name: str, file: str, says: str, **more: Content) -> BadInput:
    """An aircraft that names a file."""
    return _model(name, _MODEL.format(f'<system file="{file}"/>'), says, **more)


_SYSTEMS = {f"systems/s{i}.xml": "<system/>" for i in range(200)}
MODELS = [
    _model("without --trust-models", _MODEL.format(""), "--trust-models", trusted=False),
    _model("no XML", "hello", "bad.toml: vehicle.aircraft"),
    _model("a script", _SCRIPT.format(""), "root element"),
    _model("nothing in it", _MODEL.format(""), "JSBSim cannot"),
    _model("2 MB", _MODEL.format(f"<!--{'x' * 2_000_000}-->"), "too large"),
    _model("200,000 elements deep", "<fdm_config>" + "<a>" * 200_000, "nested deeper"),
    _model(
        "entity bomb",
        f'<!DOCTYPE r [<!ENTITY a "aaaaaaaaaa">{_BOMB}]><fdm_config>&g;</fdm_config>',
        "amplification",
    ),
    _naming("reference to /etc/passwd", "/etc/passwd", "file='/etc/passwd'"),
    _naming("reference to ../../x", "../../x", "file='../../x'"),
    _naming(
        "a reference linked from outside",
        "x",
        "JSBSim cannot",
        **{"systems/x.xml": Link("/etc/passwd")},
    ),
    _naming(
        "a file that names itself", "x", "JSBSim cannot", **{"systems/x.xml": '<system file="x"/>'}
    ),
    _model(
        "200 files",
        _MODEL.format("".join(f'<system file="s{i}"/>' for i in range(200))),
        "too many files",
        **_SYSTEMS,
    ),
    _model(
        "one of JSBSim's names",
        "",
        "ships an aircraft",
        **{"bad.toml": AIRCRAFT, "aircraft/c172x/c172x.xml": _MODEL.format("")},
    ),
]
