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
from pathlib import Path
from typing import Annotated

import typer

from ..errors import AtlasError, InputError
from ..printable import printable
from .batch import EPILOG as BATCH_EPILOG
from .batch import batch_command
from .catalogue import KEYS_EPILOG, LIST_EPILOG, NEW_EPILOG, keys_command, list_command, new_command
from .compare import EPILOG as COMPARE_EPILOG
from .compare import compare_command
from .design import EPILOG as DESIGN_EPILOG
from .design import design_command
from .export_log import EPILOG as EXPORT_EPILOG
from .export_log import export_command
from .import_file import EPILOG as IMPORT_EPILOG
from .import_file import import_command
from .live import EPILOG as LIVE_EPILOG
from .live import live_command
from .operate import EPILOG as OPERATE_EPILOG
from .operate import operate_command
from .plant import EPILOG as PLANT_EPILOG
from .plant import plant_command
from .platform import EPILOG as PLATFORM_EPILOG
from .platform import platform_command
from .recover import EPILOG as RECOVER_EPILOG
from .recover import recover_command
from .recue import EPILOG as RECUE_EPILOG
from .recue import recue_command
from .review import EPILOG as REVIEW_EPILOG
from .review import review_command
from .run import EPILOG as RUN_EPILOG
from .run import run_command
from .streams import safe_streams
from .text import copyable

# as in a full /tmp
_OF_THE_SYSTEM = (errno.ENOSPC, errno.EDQUOT, errno.EROFS, errno.EMFILE, errno.ENFILE)

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
# Without a handler Python would print JSBSim's warnings to stderr among ours.
logging.getLogger("atlas_cueing").addHandler(logging.NullHandler())

app.command("run", epilog=copyable(RUN_EPILOG))(run_command)
app.command("batch", epilog=copyable(BATCH_EPILOG))(batch_command)
app.command("live", epilog=copyable(LIVE_EPILOG))(live_command)
app.command("operate", epilog=copyable(OPERATE_EPILOG))(operate_command)
app.command("review", epilog=copyable(REVIEW_EPILOG))(review_command)
app.command("compare", epilog=copyable(COMPARE_EPILOG))(compare_command)
app.command("recue", epilog=copyable(RECUE_EPILOG))(recue_command)
app.command("recover", epilog=copyable(RECOVER_EPILOG))(recover_command)
app.command("import", epilog=copyable(IMPORT_EPILOG))(import_command)
app.command("export", epilog=copyable(EXPORT_EPILOG))(export_command)
app.command("plant", epilog=copyable(PLANT_EPILOG))(plant_command)
app.command("platform", epilog=copyable(PLATFORM_EPILOG))(platform_command)
app.command("design", epilog=copyable(DESIGN_EPILOG))(design_command)
app.command("new", epilog=copyable(NEW_EPILOG))(new_command)
app.command("keys", epilog=copyable(KEYS_EPILOG))(keys_command)
app.command("list", epilog=copyable(LIST_EPILOG))(list_command)


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


@app.callback()
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
        app(args=texts, prog_name="atlas-cueing")
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
