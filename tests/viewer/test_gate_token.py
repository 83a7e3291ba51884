"""A page that is served below its token only."""

from collections.abc import Iterator
from typing import Any

import pytest
from waiting import until
from websockets.exceptions import InvalidStatus

from atlas_cueing.viewer.server import close_server, open_server

from .gate_clients import OUTSIDE, answer_to, joined, moved, page

TOKEN = "t0ken-of_this_run"  # noqa: S105 - of a server of the test


WRONG = ("/", "", "/t0ken", f"/{TOKEN}x", f"//{TOKEN}", "/index.html", f"/?{TOKEN}", "/\xff")


@pytest.fixture
def guarded() -> Iterator[Any]:
    served = open_server(0, token=TOKEN)
    yield served
    close_server(served)


def test_a_page_with_a_token_is_served_below_it_only(guarded: Any) -> None:
    for path in (f"/{TOKEN}", f"/{TOKEN}/", f"/{TOKEN}?x=1", f"/{TOKEN}/index.html"):
        answer = answer_to(guarded, f"GET {path} HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n".encode())
        assert answer.startswith(b"HTTP/1.1 200"), path
    for path in WRONG:
        request = f"GET {path or '/'} HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n".encode("latin-1")
        assert not answer_to(guarded, request).startswith((b"HTTP/1.1 200", b"HTTP/1.1 404")), path
    assert page(guarded) == 403
    outside = f"GET /{TOKEN}{OUTSIDE} HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n".encode()
    assert answer_to(guarded, outside).startswith(b"HTTP/1.1 404")


def test_a_program_without_the_token_presses_nothing(guarded: Any) -> None:
    slider = guarded.gui.add_slider("slider", 0.0, 1.0, 0.1, 0.5)
    with pytest.raises(InvalidStatus, match="HTTP 403"):
        joined(guarded)
    with joined(guarded, f"/{TOKEN}") as ours:
        ours.send(moved(slider, 0.9))
        until(lambda: slider.value == 0.9)
