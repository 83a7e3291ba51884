"""Flights for the tools that fill tables: by the command itself, as a user flies them."""

import json
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path
from typing import Any


def flown(scenario: Path, settings: Sequence[str]) -> dict[str, Any]:
    """The JSON of one run, its log thrown away.

    A run that is refused ends the tool with its message and exit status.
    """
    options = [word for setting in settings for word in ("--set", setting)]
    with tempfile.TemporaryDirectory() as folder:
        command = [
            sys.executable,
            "-m",
            "atlas_cueing",
            "run",
            scenario,
            *options,
            "--json",
            "-o",
            f"{folder}/run.mcap",
        ]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
    if not done.stdout:
        print(done.stderr, end="", file=sys.stderr)
        raise SystemExit(done.returncode or 1)
    run: dict[str, Any] = json.loads(done.stdout)
    return run
