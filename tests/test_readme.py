"""README's words from Python run as they stand."""

import os
import re
import subprocess
import sys
from pathlib import Path

from installed import ROOT, needs_source_tree

from atlas_cueing.cueing import DEFAULT_METHOD, METHODS


def test_from_python(tmp_path: Path) -> None:
    (code,) = re.findall(
        r"^```python\n(.*?)^```", (ROOT / "README.md").read_text(), re.MULTILINE | re.DOTALL
    )
    (tmp_path / "scenarios").symlink_to(ROOT / "scenarios")
    printed = subprocess.run(
        [sys.executable, "-c", code], cwd=tmp_path, capture_output=True, text=True, check=True
    ).stdout.splitlines()
    ran, (verdict, *shape), (*_, speed) = printed[:2], printed[2].split(), printed[3].split()
    assert [line.split()[:3] for line in ran] == [["blend", "ok", "3121"], ["force", "ok", "3121"]]
    assert all(0.0 < float(line.split()[3]) < 3.2 for line in ran)
    assert (verdict, " ".join(shape)) == ("clean", "(3121, 3)")
    assert 0.0 < float(speed.rstrip(")")) < 31.0
    assert len(code.splitlines()) <= 20


@needs_source_tree
def test_links_lead_somewhere() -> None:
    for file in ROOT.glob("**/README.md"):
        if ".venv" not in file.parts:
            for target in re.findall(r"\]\(([^)#:]+)\)", file.read_text()):
                assert (file.parent / target).exists(), f"{file}: {target}"


def rows(readme: str, heading: str) -> list[str]:
    """First cells of the table of a README that has this heading."""
    text = (ROOT / readme).read_text()
    table = text[text.index(f"| {heading} |") :].split("\n\n")[0]
    return [line.split("|")[1].strip() for line in table.splitlines()[2:]]


def test_table_of_methods() -> None:
    listed = [cell.removesuffix(" (default)").strip("`") for cell in rows("README.md", "method")]
    assert set(listed) == set(METHODS)
    (default,) = (cell for cell in rows("README.md", "method") if cell.endswith("(default)"))
    assert default.removesuffix(" (default)").strip("`") == DEFAULT_METHOD


def test_table_of_tools() -> None:
    text = (ROOT / "tools/README.md").read_text()
    tools = {path.name for path in (ROOT / "tools").iterdir() if os.access(path, os.X_OK)}
    for tool in (path for path in tools if (ROOT / "tools" / path).is_file()):
        assert re.search(rf"`(tools/)?{tool}`", text), tool
    for cell in rows("tools/README.md", "tool"):
        assert (ROOT / cell.strip("`")).is_file()


def test_table_of_scenarios() -> None:
    text = (ROOT / "scenarios/README.md").read_text()
    listed = re.findall(r"^\| \[(.*)\]\(\1\.toml\)", text, re.MULTILINE)
    folder = ROOT / "scenarios"
    assert sorted(listed) == sorted(
        str(path.relative_to(folder).with_suffix("")) for path in folder.glob("**/*.toml")
    )
