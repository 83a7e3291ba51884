"""What a user imports from the package itself."""

import doctest
import inspect
import pkgutil
import pydoc
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import atlas_cueing
from atlas_cueing.errors import LogError, MissingExtraError
from atlas_cueing.recording import Log


def test_loads_of_a_preset() -> None:
    from atlas_cueing import load_platform, platform_loads

    loads = platform_loads(
        load_platform("atlas-2.9m"),
        q_WS=(1.0, 0.0, 0.0, 0.0),
        w_WS_W=(0.0, 0.0, 0.0),
        alpha_WS_W=(0.0, 0.0, 1.0),
        a_WS_W=(1.0, 0.0, 0.0),
    )
    assert loads.moment[2] == pytest.approx(328.3)
    assert loads.force[0] == pytest.approx(490.0)
    assert loads.normal.sum() * np.sin(np.radians(40.0)) == pytest.approx(490.0 * 9.80665)


def test_what_is_not_there() -> None:
    with pytest.raises(AttributeError, match="has no attribute 'nothing'"):
        atlas_cueing.nothing  # noqa: B018


def test_every_name_is_documented_with_an_example_that_runs(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "scenarios").symlink_to(Path(__file__).parents[1] / "scenarios")
    finder, runner = doctest.DocTestFinder(recurse=False), doctest.DocTestRunner()
    for name in atlas_cueing.__all__:
        public = getattr(atlas_cueing, name)
        assert inspect.getdoc(public), name
        (test,) = finder.find(public, name, globs={})
        assert test.examples or name in ("Cue", "Motion", "Pipeline"), name
        runner.run(test)
    assert runner.summarize().failed == 0
    assert runner.tries > 30


def test_help_tells_what_there_is() -> None:
    shown = pydoc.plain(pydoc.render_doc(atlas_cueing))
    for name in atlas_cueing.__all__:
        assert re.search(rf"\b{name}\(", shown), name
        assert name in dir(atlas_cueing)
        assert f"{name}(" in (atlas_cueing.__doc__ or "") or name[0].isupper()


def test_names_are_typed() -> None:
    """Every lazy name is imported for type checkers, from where it is looked up."""
    text = Path(atlas_cueing.__file__).read_text()
    imported = re.findall(r"from \.(\w+) import (\w+) as (\w+)\n", text)
    assert {name: place for place, name, same in imported if name == same} == atlas_cueing._PUBLIC


def test_no_public_name_hides_a_module() -> None:
    modules = {module.name for module in pkgutil.iter_modules(atlas_cueing.__path__)}
    assert not modules & {*atlas_cueing.__all__}


def test_importing_the_package_loads_nothing() -> None:
    code = "import sys, atlas_cueing; print([m for m in sys.modules if m.startswith('atlas_cue')])"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "['atlas_cueing']"


def test_a_log_as_columns_and_as_a_frame(tmp_path: Path) -> None:
    pandas = pytest.importorskip("pandas", reason="pandas is not installed")
    from atlas_cueing import load_scenario, read_log, run_scenario

    scenario = Path(__file__).parents[1] / "scenarios/signal_sway.toml"
    run_scenario(load_scenario(scenario, ["duration_s=0.5"]), tmp_path / "s.mcap")
    log = read_log(str(tmp_path / "s.mcap"))
    columns, frame = log.columns("/motion"), log.frame("/motion")
    assert isinstance(frame, pandas.DataFrame)
    assert frame.index.name == "time_s"
    assert [*columns] == ["time_s", *frame.columns] == [*log.tables["/motion"].fields]
    assert np.array_equal(frame.to_numpy(), log.tables["/motion"].values[:, 1:])
    with pytest.raises(LogError, match="has no topic '/nothing'"):
        log.columns("/nothing")


def test_a_frame_without_pandas(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "pandas", None)
    with pytest.raises(MissingExtraError, match=r"Log\.frame needs pandas.*atlas_cueing\[pandas\]"):
        Log.of_ticks(np.zeros((2, 100))).frame("/motion")
