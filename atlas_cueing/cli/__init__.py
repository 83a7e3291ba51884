"""The command `atlas-cueing`.

Exit status: 0 done and clean; 1 the run or the platform has a finding, and what was recorded is
kept; 2 bad input or usage, and nothing was written. Results go to stdout, everything else to
stderr.
"""

import errno
import logging
import signal
import sys
import traceback
from collections.abc import Iterable, Sequence
from contextlib import suppress
from importlib import import_module
from pathlib import Path
from typing import Annotated, Final

import typer

from ..errors import AtlasError, InputError
from ..printable import printable
from .streams import safe_streams
from .text import copyable

# as in a full /tmp
_OF_THE_SYSTEM = (errno.ENOSPC, errno.EDQUOT, errno.EROFS, errno.EMFILE, errno.ENFILE)

_COMMANDS: Final = {  # to the module of each, in the order of --help
    "run": "run",
    "batch": "batch",
    "live": "live",
    "operate": "operate",
    "review": "review",
    "compare": "compare",
    "recue": "recue",
    "recover": "recover",
    "import": "import_file",
    "export": "export_log",
    "plant": "plant",
    "platform": "platform",
    "design": "design",
    "new": "new",
    "keys": "keys",
    "list": "list_own",
}
# Without a handler Python would print JSBSim's warnings to stderr among ours.
logging.getLogger("atlas_cueing").addHandler(logging.NullHandler())


def _app(words: Sequence[str]) -> typer.Typer:
    """Make the command line of these arguments: the one command that they name, or else all."""
    app = typer.Typer(
        help=(
            "Washout-free motion cueing: a flight becomes wheel velocity profiles of a sphere that"
            " turns without bound."
        ),
        epilog="Example: atlas-cueing run scenarios/c172_elevator_doublet.toml",
        no_args_is_help=True,
        pretty_exceptions_enable=False,
        add_completion=False,
        rich_markup_mode=None,
    )
    app.callback()(_options)
    for name in words[:1] if words and words[0] in _COMMANDS else _COMMANDS:
        module = import_module(f".{_COMMANDS[name]}", __name__)
        command = getattr(module, f"{name}_command")
        app.command(name, epilog=copyable(module.EPILOG))(command)
    return app


def _show_version(asked: bool) -> None:
    if asked:
        from .. import __version__

        typer.echo(f"atlas-cueing {__version__}, {_build()}")
        raise typer.Exit


def _build() -> str:
    """Describe whether this is compiled, and why it is not."""
    from .. import rotation

    if not rotation.__file__.endswith(".py"):
        return "compiled"
    note = Path(rotation.__file__).with_name("not_compiled.txt")  # by tools/build_backend.py
    reason = note.read_text("utf-8").strip() if note.exists() else "it runs from its source tree"
    return f"plain Python ({reason})"


def _options(
    _version: Annotated[
        bool,
        typer.Option(
            "--version",
            callback=_show_version,
            is_eager=True,
            help="Show the version, and whether it is compiled.",
        ),
    ] = False,
    debug: Annotated[
        bool,
        typer.Option(
            "--debug",
            help="Show JSBSim's own messages, and where in the program an unexpected error arose.",
        ),
    ] = False,
) -> None:
    """Take the options before the command."""
    if debug:
        logging.basicConfig(
            level=logging.DEBUG, stream=sys.stderr, format="%(levelname)s %(name)s: %(message)s"
        )


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command with `arguments` (by default the process's own); return the exit status.

    Signals that come after the process's own command has ended do not change its status.
    """
    with safe_streams():
        status = _status(list(sys.argv[1:] if arguments is None else arguments))
        if arguments is None:
            _ignore_signals()
        return status


def _ignore_signals() -> None:
    with suppress(ValueError):  # not the main thread: signals are not ours
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            signal.signal(number, signal.SIG_IGN)


def _status(texts: list[str]) -> int:
    try:
        _app(texts)(args=texts, prog_name="atlas-cueing")
    except SystemExit as end:
        return end.code if isinstance(end.code, int) else 1
    except InputError as error:
        return _fail(error.lines, 2)
    except AtlasError as error:
        return _fail(error.lines, 1)
    except OSError as error:
        if error.errno not in _OF_THE_SYSTEM:
            return _unexpected(error, "--debug" in texts)
        return _fail(
            [f"{error.filename}: {error.strerror}" if error.filename else str(error.strerror)], 1
        )
    except Exception as error:  # noqa: BLE001
        # A user must never see a traceback that was not asked for
        return _unexpected(error, "--debug" in texts)
    return 0


def _unexpected(error: Exception, debug: bool) -> int:
    if debug:
        traceback.print_exception(error)
    hint = "" if debug else "; with 'atlas-cueing --debug ...' it shows where"
    return _fail(
        [f"unexpected {type(error).__name__}: {error}. This is a bug, please report it{hint}"], 1
    )


def _fail(lines: Iterable[str], status: int) -> int:
    for line in lines:
        typer.echo(f"error: {printable(line)}", err=True)
    return status
