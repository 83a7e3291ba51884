"""`tools/setup`: what it builds and installs, when it does so again, and what it says first.

With programs that only note their call.
"""

import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
# by the script, of the machine's own
NEEDED = ("dirname", "sed", "cksum", "tr", "grep", "touch", "cat", "env", "find", "sort", "rm")
NEEDED += ("mkdir",)
NOTING = '#!/bin/sh\necho "$0 $*" >> {calls}\n'
# what `pip wheel` leaves
WHEEL = 'case "$*" in *" wheel "*) mkdir -p "$8" && touch "$8/built.whl" ;; esac\n'
BUILT = ["wheel", "built.whl", "built.whl"]  # a wheel, put in, and with its dependencies


class Project:
    """A folder with the script, a pyproject.toml and an environment whose pip notes its calls."""

    def __init__(self, folder: Path) -> None:
        self.folder, self.calls, self.programs = (
            folder / "project",
            folder / "calls",
            folder / "programs",
        )
        (self.folder / "tools").mkdir(parents=True)
        (self.folder / ".venv" / "bin").mkdir(parents=True)
        self.programs.mkdir()
        shutil.copy(ROOT / "tools" / "setup", self.folder / "tools")
        shutil.copy(ROOT / "pyproject.toml", self.folder)
        (self.folder / "atlas_cueing").mkdir()
        for source in ("atlas_cueing/tick.py", "tools/build_backend.py", "tools/documented.py"):
            (self.folder / source).touch()
        for name in NEEDED:
            (self.programs / name).symlink_to(shutil.which(name) or name)
        self.noting(self.folder / ".venv" / "bin" / "python", WHEEL)
        self.program("id", "echo 1000")

    def noting(self, program: Path, more: str = "") -> None:
        program.write_text(NOTING.format(calls=self.calls) + more)
        program.chmod(0o755)

    def program(self, name: str, more: str = "") -> None:
        self.noting(self.programs / name, more)

    def setup(self, *extra: str) -> tuple[int, str, list[str]]:
        """Exit status, what was said, and what was installed."""
        self.calls.write_text("")
        command = ["/bin/sh", str(self.folder / "tools" / "setup"), *extra]
        environment = {"PATH": str(self.programs), "PYTHON": sys.executable}
        told = subprocess.run(
            command,
            env=environment,
            cwd="/",
            capture_output=True,
            text=True,
            timeout=60,
            check=False,
        )
        calls = self.calls.read_text().splitlines()
        installed = [_installed(line) for line in calls if " install " in line or " wheel " in line]
        return told.returncode, told.stderr, installed

    def replace(self, old: str, new: str) -> None:
        file = self.folder / "pyproject.toml"
        text = file.read_text()
        assert old in text
        file.write_text(text.replace(old, new))


def _installed(call: str) -> str:
    """What pip or apt-get was to install; "wheel" for a build."""
    return "wheel" if " wheel " in call else call.split()[-1].split("/")[-1]


@pytest.fixture
def project(tmp_path: Path) -> Project:
    return Project(tmp_path)


def test_the_second_time_nothing_is_done(project: Project) -> None:
    status, said, installed = project.setup()
    assert (status, installed) == (0, BUILT)
    assert "installing atlas_cueing into .venv" in said
    assert project.setup() == (0, "", [])


def test_tool_settings_change_nothing_and_dependencies_do(project: Project) -> None:
    project.setup()
    project.replace("line-length = 100", "line-length = 99")
    assert project.setup() == (0, "", [])
    project.replace('"numpy>=2.0"', '"numpy>=2.1"')
    assert project.setup()[2] == BUILT


def test_what_dev_or_an_extra_brings_is_not_asked_for_again(project: Project) -> None:
    assert project.setup("report")[2] == ["wheel", "built.whl", "built.whl[report]"]
    assert project.setup()[2] == []
    assert project.setup("live")[2] == ["built.whl[live]"]  # no building
    assert project.setup("tools")[2] == ["built.whl[tools]"]
    assert project.setup("dev")[2] == [".[dev]"]
    assert project.setup("preview")[2] == []


@pytest.mark.parametrize("changed", ["atlas_cueing/tick.py", "tools/build_backend.py"])
def test_a_changed_source_is_built_again_but_for_developers(project: Project, changed: str) -> None:
    project.setup()
    (project.folder / changed).write_text("changed = True\n")
    assert project.setup()[2] == BUILT
    assert [path.name[:6] for path in project.folder.glob(".venv/built-*")] == ["built-"]
    project.setup("dev")
    (project.folder / changed).write_text("changed = 2\n")
    assert [project.setup(*extra)[2] for extra in ([], ["report"], ["dev"])] == [[], [], []]


def test_a_developers_environment_stays_one(project: Project) -> None:
    project.setup("dev")
    project.replace('"numpy>=2.0"', '"numpy>=2.1"')
    assert project.setup("report")[2] == [".[dev]"]


def test_a_project_that_was_moved_is_set_up_where_it_is(project: Project) -> None:
    project.setup()
    project.folder = project.folder.rename(project.folder.with_name("elsewhere"))
    assert project.setup()[2] == BUILT


def test_a_failed_installation_is_tried_again(project: Project) -> None:
    python = project.folder / ".venv" / "bin" / "python"
    project.noting(python, 'case "$*" in *install*) exit 1 ;; esac\n')
    assert project.setup()[0] == 1
    project.noting(python, WHEEL)
    assert project.setup()[2] == BUILT


def test_an_unknown_extra_is_refused(project: Project) -> None:
    assert project.setup("nonsense") == (
        2,
        "tools/setup: no extra 'nonsense' in pyproject.toml\n",
        [],
    )
    project.setup("dev")
    assert project.setup("nonsense")[0] == 2


def test_root_is_told_of_chromium_before_anything_is_installed(project: Project) -> None:
    project.program("id", "echo 0")
    project.program("apt-get")
    status, said, installed = project.setup("dev")
    assert (status, installed) == (0, [".[dev]", "chromium"])
    assert (
        said.splitlines()[0]
        == "tools/setup: will install chromium with apt-get, for the browser tests; all else goes"
        " into .venv"
    )


def test_others_are_told_that_browser_tests_will_be_skipped(project: Project) -> None:
    _, said, installed = project.setup("dev")
    assert installed == [".[dev]"]
    assert "no chromium, so the browser tests will be skipped" in said.splitlines()[0]


def test_with_chromium_nothing_is_said_of_it(project: Project) -> None:
    project.program("chromium")
    assert "chromium" not in project.setup("dev")[1]
