"""Arguments and options that several commands share: one word means one thing in all of them."""

from pathlib import Path
from typing import Annotated, TypeAlias

import typer

from .text import TRUST_MODELS

ScenarioFile: TypeAlias = Annotated[
    Path, typer.Argument(help="Scenario file (TOML).", metavar="SCENARIO")
]
NewLog: TypeAlias = Annotated[
    Path | None,
    typer.Option(
        "-o",
        "--output",
        metavar="LOG",
        help="Log to write; by default ./NAME.mcap with the scenario's name.",
    ),
]
Settings: TypeAlias = Annotated[
    list[str] | None,
    typer.Option(
        "--set",
        metavar="KEY=VALUE",
        help="Set any key of the scenario or its platform; repeatable.",
    ),
]
TrustModels: TypeAlias = Annotated[bool, typer.Option("--trust-models", help=TRUST_MODELS)]
Force: TypeAlias = Annotated[
    bool, typer.Option("--force", help="Replace an existing log, and nothing else.")
]
AsJson: TypeAlias = Annotated[
    bool, typer.Option("--json", help="Print one JSON object and nothing else.")
]
Figure: TypeAlias = Annotated[
    Path | None,
    typer.Option("--figure", metavar="FILE", help="Draw a figure for a paper: .svg or .pdf."),
]
Port: TypeAlias = Annotated[
    int,
    typer.Option(
        "--port",
        help="Port of --view on this machine; 0 for any free one.",
        metavar="PORT",
        min=0,
        max=65535,
    ),
]
