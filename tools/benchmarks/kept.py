"""Ratios kept with the commit that they are of, and what has become worse since."""

import json
import subprocess
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from atlas_cueing.atomic_file import write_whole

from .rows import Row

FILE = Path(__file__).with_name("figures.json")
# a ratio that is worse by less may be chance (assumed); a spread of the rounds beyond it counts
TOLERANCE = 0.1


def spread(samples: Sequence[float]) -> float:
    """Half of what the middle half of the samples spans, over their median; 0 for a few."""
    if len(samples) < 4:
        return 0.0
    ordered, count = sorted(samples), len(samples)
    return abs((ordered[(3 * count) // 4] - ordered[count // 4]) / 2.0 / ordered[count // 2])


def commit(project: Path) -> str:
    """The commit of the project's source, with a `+` where it has been changed; "" outside git."""

    def git(*command: str) -> str:
        said = subprocess.run(
            ["git", "-C", project, *command], capture_output=True, text=True, check=False
        )
        return said.stdout.strip()

    changed = git("status", "--porcelain", "--", "atlas_cueing")
    return git("rev-parse", "--short=12", "HEAD") + ("+" if changed else "")


def read(file: Path, kind: str) -> dict[str, Any]:
    """What is kept of a kind (the build, and how much was flown); empty for nothing."""
    return json.loads(file.read_text("utf-8")).get(kind, {}) if file.exists() else {}


def keep(file: Path, kind: str, of: str, rows: Sequence[Row]) -> None:
    """Put the ratios into the file, in place of what it has under the same names."""
    every = json.loads(file.read_text("utf-8")) if file.exists() else {}
    found = {
        f"{row.section}: {row.what}": {
            "ratio": round(row.ratio, 3),
            "spread": round(spread(row.samples), 3),
            "commit": of,
        }
        for row in rows
        if row.ratio is not None
    }
    every[kind] = {**every.get(kind, {}), **found}
    write_whole(file, json.dumps(every, indent=1, sort_keys=True) + "\n")


def changes(kept: dict[str, Any], rows: Sequence[Row]) -> list[str]:
    """Say what has become worse or better than the kept ratios, a line each."""
    lines = []
    for row in rows:
        name = f"{row.section}: {row.what}"
        if row.ratio is None or name not in kept:
            continue
        before = kept[name]
        grown = row.ratio / before["ratio"]
        chance = 1.0 + max(TOLERANCE, before["spread"], spread(row.samples))
        if 1.0 / chance <= grown <= chance:
            continue
        bad = (grown > 1.0) != bool(row.asked and row.asked.at_least)
        lines.append(
            f"{'WORSE' if bad else 'better'}: {name}: {row.ratio:.2f} times {row.reference},"
            f" {before['ratio']:.2f} at {before['commit']}"
        )
    return lines
