"""Outputs that must not be replaced, and disks that take none."""

from .trying import DISK, FILES, LOGS, BadInput, Content, Folder, Good, Link, Pipe, Same

_GOOD: dict[str, Content] = {"good.mcap": Good()}
_OUTPUTS = {
    "run": ("run", "good.toml", "-o"),
    "live": ("live", "good.toml", "--duration", "0.1", "-o"),
    "recue": ("recue", "good.mcap", "-o"),
    "recover": ("recover", "good.mcap", "-o"),
    "review --html": ("review", "good.mcap", "--html"),
    "review --replay": ("review", "good.mcap", "--replay"),
    "compare --html": ("compare", "good.mcap", "good.mcap", "--html"),
}
_PLACES: dict[str, tuple[str, dict[str, Content], str]] = {
    "exists": ("old", {"old": "precious"}, "exists already"),
    "in no folder": ("no/new", {}, "there is no folder"),
    "a folder": ("old", {"old": Folder()}, "no regular file"),
    "a FIFO": ("old", {"old": Pipe()}, "no regular file"),
    "a name of 5 kB": ("x" * 5000, {}, "File name too long"),
}
_FORCED: dict[str, tuple[str, dict[str, Content], str]] = {
    "a file of another kind": ("old", {"old": "precious"}, "nothing else is replaced"),
    "a link to one": ("new", {"new": Link("old"), "old": "precious"}, "nothing else is replaced"),
    "links in a circle": (
        "a",
        {"a": Link("b"), "b": Link("a")},
        "Too many levels of symbolic links",
    ),
    "a link to a device": ("new", {"new": Link("/dev/null")}, "no regular file"),
    "a link to an open file": (
        "new",
        {"new": Link("/proc/self/fd/2")},
        "an open file of a process",
    ),
    "a FIFO": ("old", {"old": Pipe()}, "no regular file"),
    "a link into no folder": ("new", {"new": Link("no/new")}, "there is no folder"),
}


def _onto(file: str) -> dict[str, tuple[str, dict[str, Content]]]:
    return {
        "itself": (file, {}),
        "by a link": ("link", {"link": Link(f"./{file}")}),
        "by a hard link": ("hard", {"hard": Same(file)}),
    }


_RUN = ("run", "good.toml")
OUTPUTS = (
    [
        BadInput(
            f"{command} to what {name}" if name == "exists" else f"{command} to {name}",
            (*words, path),
            {**_GOOD, **files},
            says=says,
            limits=LOGS,
        )
        for command, words in _OUTPUTS.items()
        for name, (path, files, says) in _PLACES.items()
    ]
    + [
        BadInput(
            f"{command} --force to {name}",
            (*words, path, "--force"),
            {**_GOOD, **files},
            says=says,
            limits=LOGS,
        )
        for command, words in _OUTPUTS.items()
        for name, (path, files, says) in _FORCED.items()
    ]
    + [
        BadInput(
            f"{command} --force onto its input {name}",
            (*words, path, "--force"),
            {**_GOOD, **files},
            says="is read",
            limits=LOGS,
        )
        for command, words in _OUTPUTS.items()
        for name, (path, files) in _onto(words[1]).items()
    ]
    + [
        BadInput(
            "review: two pages in one file",
            ("review", "good.mcap", "--html", "new", "--replay", "link"),
            {**_GOOD, "link": Link("new")},
            says="is written twice",
        ),
        BadInput(
            "run --force over a .part that is a link",
            (*_RUN, "--force"),
            {"s.mcap.part": Link("old"), "old": "precious"},
            says="no regular",
        ),
        BadInput(
            "run --force over a .part that is a FIFO",
            (*_RUN, "--force"),
            {"s.mcap.part": Pipe()},
            says="no regular",
        ),
        BadInput(
            "run --force over a .part of another kind",
            (*_RUN, "--force"),
            {"s.mcap.part": "precious"},
            says="no log",
        ),
        BadInput(
            "batch over a page of another",
            ("batch", "good.toml", "-o", "."),
            {"index.html": "<html>"},
            says="index.html",
        ),
        BadInput(
            "batch over a table of another",
            ("batch", "good.toml", "-o", "."),
            {"summary.csv": "a,b"},
            says="summary.csv",
        ),
        BadInput(
            "batch over a FIFO",
            ("batch", "good.toml", "-o", "."),
            {"summary.csv": Pipe()},
            says="summary.csv",
        ),
        BadInput(
            "run to /dev/null",
            ("run", "good.toml", "-o", "/dev/null", "--force"),
            says="no regular file",
        ),
        BadInput(
            "run beside what a killed run left",
            ("run", "good.toml"),
            {"s.mcap.part": "precious"},
            says="recover",
        ),
        BadInput("batch into a file", ("batch", "good.toml", "-o", "good.toml"), says="no folder"),
    ]
)
DISKS = [
    BadInput(
        "run to a full disk",
        ("run", "good.toml", "-o", f"{DISK}/new"),
        {},
        1,
        "No space left",
        FILES,
        "size=16k",
    ),
    *[
        BadInput(
            f"{command} to a full disk",
            (*words, f"{DISK}/new"),
            _GOOD,
            2,
            "No space left",
            LOGS,
            "size=16k",
        )
        for command, words in _OUTPUTS.items()
        if command not in ("run", "live")
    ],
    *[
        BadInput(
            f"{command} to a read-only disk",
            (*words, f"{DISK}/new"),
            _GOOD,
            2,
            "cannot be written to",
            LOGS,
            "ro",
        )
        for command, words in _OUTPUTS.items()
    ],
]
