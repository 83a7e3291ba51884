"""Recorded data of others, and maps of them, with everything wrong that `import` may be handed."""

from .trying import BadInput, Content, Folder, Pipe

_HEAD = "time_s,fx,fy,fz,wx,wy,wz\n"
_ROWS = "".join(f"{k / 100},0,0,-9.8,0,0,0\n" for k in range(150))
_MAP = """
format = "csv"
[time]
column = "time_s"
[force]
columns = ["fx", "fy", "fz"]
unit = "m/s2"
[rate]
columns = ["wx", "wy", "wz"]
unit = "rad/s"
"""

_CSV: dict[str, tuple[Content, str]] = {
    "an empty file": ("", "line 1: missing"),
    "a header alone": (_HEAD, "no numbers below the header"),
    "a longer line": (_HEAD + "0,0,0,-9.8,0,0,0,1\n" + _ROWS, "line 2: 8 columns, allowed: the 7"),
    "a shorter line": (_HEAD + "0,0\n" + _ROWS, "line 2: 2 columns"),
    "decimal commas": (
        _HEAD.replace(",", ";") + "0,5;0;0;-9,8;0;0;0\n",
        "'0,5', allowed: a finite number or nothing; for decimal commas: csv.decimal",
    ),
    "CR alone, a word": ((_HEAD + _ROWS + "x,0,0,0,0,0,0\n").replace("\n", "\r"), "line 152"),
    "a quote that does not end": (_HEAD + f'0,"{"0" * 200_000}\n', "line 2"),
    "some of an attitude": ((_HEAD + _ROWS).replace("wz", "wz,qw", 1), "but not 'qx'"),
    "a line without an end": (b"time_s," + b"x" * (3 << 20), "longer than"),
    "zero bytes": (b"\0" * 1000, "a zero byte"),
    "no UTF-8": (b"\xff\xfe\n", "not UTF-8"),
    "times that go back": (_HEAD + _ROWS + "0,0,0,-9.8,0,0,0\n", "goes back"),
    "a pipe": (Pipe(), "not a regular file"),
    "a folder": (Folder(), "is a folder"),
}
_OTHERS = {
    "px4": ("a.ulg", b"ULog\x01\x12\x35" + b"\xff" * 300, "ULog"),
    "ardupilot": ("a.bin", b"\xa3\x95\x80" + b"\xff" * 300, "DataFlash"),
    "ros-imu": ("a.mcap", b"\x89MCAP0\r\n" + b"\xff" * 300, "ROS bag"),
}
_MAPS = {
    "no format": (_MAP.replace('format = "csv"', ""), "format: missing"),
    "a table of another kind": (_MAP.replace("[rate]", "[[rate]]"), "rate: allowed: a table"),
    "no decimal mark": (_MAP + "[csv]\ndecimal = ';'", "csv.decimal = ';'"),
    "a unit of something else": (_MAP.replace("rad/s", "kg"), "rate.unit = 'kg'"),
    "no TOML": ("format = ", "m.toml: "),
}


def _import(name: str, map_name: str) -> tuple[str, ...]:
    return ("import", name, "-o", "new.mcap", "--map", map_name)


RECORDINGS = [
    *(
        BadInput(f"csv: {name}", _import("a.csv", "csv"), {"a.csv": content}, says=says)
        for name, (content, says) in _CSV.items()
    ),
    *(
        BadInput(f"{name}: noise", _import(file, name), {file: content}, says=says)
        for name, (file, content, says) in _OTHERS.items()
    ),
    *(
        BadInput(
            f"map: {name}", _import("a.csv", "m.toml"), {"a.csv": _HEAD, "m.toml": text}, says=says
        )
        for name, (text, says) in _MAPS.items()
    ),
]
