import os

import pytest
from hypothesis import given
from hypothesis import strategies as st

from atlas_cueing.printable import html_text, is_name, printable, printable_lines, utf8

ANY = st.text(
    st.one_of(
        st.characters(exclude_categories=()),
        st.sampled_from("\x1b\r\n\t\x9b\u202e\u2066\u200b\u2028\udce9"),
    )
)


@given(ANY)
def test_nothing_is_left_that_is_not_visible(text: str) -> None:
    assert printable(text).isprintable()
    assert html_text(text).isprintable()
    assert printable_lines(text).replace("\n", "").replace("\t", "").isprintable()
    assert printable_lines(text).count("\n") == text.count("\n")
    utf8(text).encode()


@given(st.text().filter(str.isprintable))
def test_what_is_visible_stays(text: str) -> None:
    assert printable(text) == printable_lines(text) == utf8(text) == text


@pytest.mark.parametrize(
    ("text", "shown"),
    [
        ("\x1b]0;title\x07", "\\x1b]0;title\\x07"),
        ("a\r\nb\tc", "a\\r\\nb\\tc"),
        ("\x9b31m\x7f\x00", "\\x9b31m\\x7f\\x00"),
        ("\u202egpj.exe\u2066\u200f\u200b\u2028", "\\u202egpj.exe\\u2066\\u200f\\u200b\\u2028"),
        (os.fsdecode(b"caf\xe9"), "caf\\xe9"),
        ("\ud800\U000e0041\ufeff", "\\ud800\\U000e0041\\ufeff"),
        ("Größe 日本 [red] <b>", "Größe 日本 [red] <b>"),
    ],
)
def test_how_it_is_written_out(text: str, shown: str) -> None:
    assert printable(text) == shown


def test_a_page_takes_it_as_text() -> None:
    assert html_text("</script>\u202e'\"") == "&lt;/script&gt;\\u202e&#x27;&quot;"


@pytest.mark.parametrize(
    ("text", "fits"), [("", False), ("a\n", False), ("a b", True), (os.fsdecode(b"\xe9"), True)]
)
def test_names_of_files(text: str, fits: bool) -> None:
    assert is_name(text) == fits
