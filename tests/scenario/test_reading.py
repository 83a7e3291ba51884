"""The caps before the parser: what they refuse, and what only looks like it."""

import os
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from atlas_cueing.errors import ScenarioError
from atlas_cueing.scenario.reading import (
    DEEPEST_NESTING,
    LARGEST_FILE,
    LONGEST_DOTTED_KEY,
    parse_toml,
    read_toml,
)

from .texts import SCRIPT

BRACKETS = "[" * 50
DOTS = "." * 50


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        (".".join(["a"] * 20_000) + " = 1", "a key has too many dots"),
        ("a" + " . a" * (LONGEST_DOTTED_KEY + 1) + " = 1", "a key has too many dots"),
        ("[" + ".".join(["a"] * 100) + "]", "a key has too many dots"),
        ("x = {" + ".".join(["a"] * 100) + " = 1}", "a key has too many dots"),
        ("a = " + "[" * 5000, "nested too deeply"),
        ("a = " + "{b = " * 5000, "nested too deeply"),
        # four quotes: the last is not the start of another string
        ('a = ["""x"""", ' + "[" * 5000, "nested too deeply"),
        ("a = ['''x''''', " + "[" * 5000, "nested too deeply"),
        ('a = ["\\"", ' + "[" * 5000, "nested too deeply"),
        ("a = " + "1" * 5000, "not valid"),  # a ValueError that is no TOMLDecodeError
        ("\na = ?", "not valid: .*line 2"),
        ("#" * (LARGEST_FILE + 1), "too large"),
    ],
    ids=lambda text: text[:20],
)
def test_refused(text: str, reason: str) -> None:
    with pytest.raises(ScenarioError, match=rf"^f.toml: \w+: {reason}"):
        parse_toml(text, "f.toml")


@pytest.mark.parametrize(
    "value",
    [
        f'"{BRACKETS}{DOTS}"',
        f"'{BRACKETS}{DOTS}'",
        f'"""\n"{BRACKETS}\n{DOTS}"""',
        f"'''\n'{BRACKETS}\n{DOTS}'''",
        '""',
        "''",
    ],
)
def test_strings_and_comments_may_hold_anything(value: str) -> None:
    text = f'# {BRACKETS} {DOTS} "\na = {value}  # {BRACKETS}\nb = "\\"{BRACKETS}"\nc = 1'
    assert parse_toml(text, "f.toml")["c"] == 1


def test_the_caps_leave_room() -> None:
    deep = "a = " + "[" * DEEPEST_NESTING + "]" * DEEPEST_NESTING
    dotted = ".".join(["b"] * (LONGEST_DOTTED_KEY + 1)) + " = 1"
    assert set(parse_toml(f"{deep}\n{dotted}", "f.toml")) == {"a", "b"}


@given(st.text(alphabet="\"'\\[]{}=.,#\na1 ", max_size=80))
def test_any_text_is_parsed_or_refused(text: str) -> None:
    try:
        assert isinstance(parse_toml(text, "f.toml"), dict)
    except ScenarioError as refusal:
        lines = str(refusal).splitlines()
        assert lines[0].startswith("f.toml: TOML: ")


def refusal(path: Path) -> str:
    with pytest.raises(ScenarioError) as error:
        read_toml(path)
    return str(error.value)


def test_files_that_cannot_be_read(tmp_path: Path) -> None:
    assert "missing.toml: file: cannot be read: No such file" in refusal(tmp_path / "missing.toml")
    assert "not a regular file" in refusal(tmp_path)
    os.mkfifo(tmp_path / "pipe")
    assert "not a regular file" in refusal(tmp_path / "pipe")
    assert "cannot be read: embedded null" in refusal(tmp_path / "a\0b")
    (tmp_path / "latin").write_bytes(b"name = 'caf\xe9'")
    assert "not UTF-8 text: byte 11" in refusal(tmp_path / "latin")
    (tmp_path / "large").write_bytes(b"#" * (LARGEST_FILE + 1))
    assert "too large" in refusal(tmp_path / "large")
    (tmp_path / "full").write_bytes(b"#" * LARGEST_FILE)
    assert read_toml(tmp_path / "full") == {}


def test_a_byte_order_mark_is_taken_as_if_it_were_not_there(tmp_path: Path) -> None:
    file = tmp_path / "f.toml"
    file.write_bytes('\ufeffname = "é"\r\n'.encode())
    assert read_toml(file) == {"name": "é"}
    file.write_bytes("\ufeff".encode())
    assert read_toml(file) == {}


@pytest.mark.parametrize("encoding", ["utf-16", "utf-16-be", "utf-16-le"])
def test_utf_16_is_named(tmp_path: Path, encoding: str) -> None:
    (tmp_path / "f.toml").write_bytes(
        ('name = "a"' if encoding == "utf-16" else '\ufeffname = "a"').encode(encoding)
    )
    with pytest.raises(ScenarioError, match="is UTF-16 text, allowed: UTF-8; save it anew"):
        read_toml(tmp_path / "f.toml")


def test_a_name_without_its_ending_or_folder_is_asked_about(tmp_path: Path) -> None:
    (tmp_path / "scenarios").mkdir()
    (tmp_path / "scenarios" / "rolls.toml").write_text(SCRIPT)
    meant = f"; did you mean {tmp_path / 'scenarios' / 'rolls.toml'}?"
    for name in ("rolls", "rolls.toml"):
        assert meant in refusal(tmp_path / name)
    (tmp_path / "loop.toml").write_text(SCRIPT)
    assert f"did you mean {tmp_path / 'loop.toml'}?" in refusal(tmp_path / "loop")
    for name in ("loops", "x" * 253):
        assert "did you mean" not in refusal(tmp_path / name)
