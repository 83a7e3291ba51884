"""README's words from Python run as they stand."""

import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).parents[1]


def test_from_python(tmp_path: Path) -> None:
    (code,) = re.findall(
        r"^```python\n(.*?)^```", (ROOT / "README.md").read_text(), re.MULTILINE | re.DOTALL
    )
    (tmp_path / "scenarios").symlink_to(ROOT / "scenarios")
    printed = subprocess.run(
        [sys.executable, "-c", code], cwd=tmp_path, capture_output=True, text=True, check=True
    ).stdout.split()
    assert printed[:2] == ["ok", "3121"]
    assert 0.0 < float(printed[2]) < 3.2
    assert (tmp_path / "rolls.mcap").exists()


def test_links_lead_somewhere() -> None:
    for file in ROOT.glob("**/README.md"):
        if ".venv" not in file.parts:
            for target in re.findall(r"\]\(([^)#:]+)\)", file.read_text()):
                assert (file.parent / target).exists(), f"{file}: {target}"
