"""A page of sections: one self-contained HTML file that opens from disk, without any network."""

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from ..atomic_file import write_page as write_file
from ..errors import MissingExtraError, OutputError
from ..printable import html_text

if TYPE_CHECKING:
    from plotly.graph_objects import Figure as Plot

_STYLE = """
body { font-family: system-ui, sans-serif; margin: 1.2em auto; max-width: 1500px; padding: 0 1em;
color: #1b2733; }
h1 { font-size: 1.5em; margin: 0.2em 0; } h2 { font-size: 1.15em; margin: 1.4em 0 0.3em; }
.verdict { display: inline-block; padding: 0.15em 0.7em; border-radius: 0.4em; color: white;
background: #c00000; }
.verdict.clean { background: #2e7d32; }
.columns { display: flex; flex-wrap: wrap; gap: 0 3em; align-items: flex-start; }
table { border-collapse: collapse; margin: 0.5em 0; }
td, th { padding: 0.1em 0.9em 0.1em 0; text-align: left; }
td.number, th { text-align: right; } td.number { font-variant-numeric: tabular-nums; }
td:first-child { color: #5a6a7a; }
dl.meanings { max-width: 34em; font-size: 0.9em; color: #5a6a7a; } dt { color: #1b2733; }
dd { margin: 0 0 0.4em 1em; }
li.finding { color: #c00000; } details { margin: 0.5em 0; }
"""


def check_plotly() -> None:
    """Import plotly, which takes half a second. Raises MissingExtraError without it."""
    try:
        import plotly.graph_objects  # noqa: F401
    except ModuleNotFoundError as error:
        if (error.name or "").partition(".")[0] != "plotly":
            raise
        raise MissingExtraError("an HTML page", "plotly", "report") from error


def two_columns(rows: Sequence[tuple[str, str]]) -> str:
    """HTML of a table of two columns of text."""
    return (
        "<table>"
        + "".join(f"<tr><td>{html_text(a)}</td><td>{html_text(b)}</td></tr>" for a, b in rows)
        + "</table>"
    )


def write_sections(
    file: str | Path, title: str, sections: "Sequence[tuple[str, str | Plot]]"
) -> None:
    """Write sections, each a heading and HTML or a plot, into `file`.

    Raises OutputError when it cannot be written; an old one is kept then.
    """
    from plotly.offline import get_plotlyjs

    pieces = [
        (
            "<!doctype html><html lang='en'><head><meta"
            f" charset='utf-8'><title>{html_text(title)}</title>"
        ),
        f"<style>{_STYLE}</style><script>{get_plotlyjs()}</script></head><body>",
    ]
    for heading, content in sections:
        pieces.append(f"<h2>{html_text(heading)}</h2>" if heading else "")
        pieces.append(content if isinstance(content, str) else _html(content))
    try:
        write_file(file, "".join([*pieces, "</body></html>\n"]))
    except OSError as error:
        raise OutputError(f"page {file}: {error.strerror}") from error


def _html(plot: "Plot") -> str:
    """One plot as a part of a page that has loaded the script of plotly already."""
    html: str = plot.to_html(
        full_html=False, include_plotlyjs=False, config={"displaylogo": False, "responsive": True}
    )
    return html
