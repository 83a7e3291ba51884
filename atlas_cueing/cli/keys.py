"""`atlas-cueing keys`: what a scenario can hold."""

from typing import Annotated

import typer

from ..errors import InputError
from .options import AsJson

EPILOG = """
Examples:

  atlas-cueing keys

  atlas-cueing keys cueing.align

  atlas-cueing keys --method hedge

  atlas-cueing keys platform.wheel --json
"""


def keys_command(
    prefix: Annotated[
        str, typer.Argument(help="Beginning of the keys to list.", metavar="[PREFIX]")
    ] = "",
    method: Annotated[
        str, typer.Option(metavar="NAME", help="Only the keys of this cueing method.")
    ] = "",
    as_json: AsJson = False,
) -> None:
    """List the keys of scenario, methods, platform and sweep.

    Each with default, unit, what is allowed and what it is. A key is set by --set, or in its table.

    Exit status 0: listed. 2: no key begins so, or no such method.
    """
    from dataclasses import asdict

    from ..scenario.keys import keys
    from .text import one_json

    found = keys(prefix, method)
    if not found:
        raise InputError(_none_begins(prefix, method))
    if as_json:
        typer.echo(one_json({"keys": [asdict(entry) for entry in found]}))
        return
    typer.echo("\n".join(entry.line() for entry in found))


def _none_begins(prefix: str, method: str) -> str:
    from ..scenario.cueing_table import TABLES

    word = prefix.removeprefix("cueing.")
    if not method and word in TABLES:
        return (
            f"no key begins with {prefix!r}; those of a method: atlas-cueing keys --method {word}"
        )
    of = f" of method {method}" if method else ""
    return f"no key{of} begins with {prefix!r}; all of them: atlas-cueing keys"
