"""`atlas-cueing operate`: the operator's commands to a live run, without a browser."""

from typing import Annotated

import typer

from ..errors import InputError

EPILOG = """
Examples:

  atlas-cueing operate --latest hold

  atlas-cueing operate 4711 stop

Without this program: echo hold | socat - UNIX-CONNECT:$XDG_RUNTIME_DIR/atlas_cueing/4711.sock
"""


def operate_command(
    words: Annotated[
        list[str],
        typer.Argument(
            metavar="[PID] COMMAND",
            help="The run's process, and engage, hold, park, reset, stop or state.",
        ),
    ],
    latest: Annotated[
        bool, typer.Option("--latest", help="The run that began last, in the place of PID.")
    ] = False,
) -> None:
    """Press a button of a live run of this user, or ask for its state.

    Exit status 0: done. 1: it has no effect in the present state. 2: no such run or command.
    """
    from ..telemetry.command_socket import ask, folder, newest

    if len(words) != (1 if latest else 2):
        raise InputError("operate PID COMMAND, or operate --latest COMMAND")
    *process, command = words
    if process and not (process[0].isascii() and process[0].isdigit()):
        raise InputError(f"PID {process[0]!r}, allowed: a number, or --latest")
    place = newest() if latest else folder() / f"{process[0]}.sock"
    answer = ask(place, command)
    if answer.startswith("no: ") and ", allowed: " in answer:
        raise InputError(answer.removeprefix("no: "))
    typer.echo(answer)
    if not answer.startswith("ok"):
        raise typer.Exit(1)
