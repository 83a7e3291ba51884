"""What all figures for papers share: size, fonts, lines, and how they are written.

Text stays text (fonttype 42 of PDF, none of SVG), the same log gives the same bytes, and the
colours are those of Okabe & Ito (https://jfly.uni-koeln.de/color/), which everybody can tell apart.
"""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from io import BytesIO
from pathlib import Path
from typing import Any, Final

from ...atomic_file import write_whole
from ...errors import InputError, MissingExtraError, OutputError
from ...run import Kind

WIDTH: Final = 7.16  # in; both columns of an IEEE page
VEHICLE: Final = "#9a9a9a"
COLOURS: Final = ("#d55e00", "#0072b2", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000")
DASHES: Final = ("-", (0, (5, 1.5)), (0, (1.5, 1)))  # for more rides than colours
THICK, THIN = 2.2, 0.9  # points: the vehicle behind, rides before it
_SVG = b'<?xml version="1.0" encoding="utf-8" standalone="no"?>\n'
_OURS = b"<!-- atlas_cueing -->\n"
_PDF = b"%PDF-1.4\n%"
_PDF_MARK = b"\xac\xdc \xab\xba"  # of matplotlib: any bytes that say that what follows is binary
_PDF_OURS = bytes(byte | 0x80 for byte in b"ATLAS")
FIGURE_KINDS: Final = {  # by ending: what --force may replace
    ".svg": Kind("figure", _SVG + _OURS),
    ".pdf": Kind("figure", _PDF + _PDF_OURS),
}
_STYLE = {
    "font.family": "sans-serif",
    "font.sans-serif": ["DejaVu Sans", "Helvetica", "Arial", "sans-serif"],
    "font.size": 8.0,
    "axes.titlesize": 8.0,
    "axes.labelsize": 8.0,
    "xtick.labelsize": 7.0,
    "ytick.labelsize": 7.0,
    "legend.fontsize": 8.0,
    "legend.frameon": False,
    "axes.linewidth": 0.6,
    "axes.grid": True,
    "grid.color": "#e3e3e3",
    "grid.linewidth": 0.5,
    "axes.axisbelow": True,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "xtick.major.width": 0.6,
    "ytick.major.width": 0.6,
    "lines.solid_joinstyle": "round",
    "pdf.fonttype": 42,
    "svg.fonttype": "none",
    "svg.hashsalt": "atlas_cueing",
    "path.simplify": True,
}


def figure_kind(file: Path) -> Kind:
    """Return the kind of figure that a name asks for. Raises InputError for an unknown ending."""
    kind = FIGURE_KINDS.get(file.suffix.lower())
    if kind is None:
        raise InputError(f"--figure {file}: allowed: a name that ends in {', '.join(FIGURE_KINDS)}")
    return kind


def check_plot() -> None:
    """Raise MissingExtraError without matplotlib."""
    try:
        import matplotlib as mpl  # noqa: F401
    except ModuleNotFoundError as error:
        if (error.name or "").partition(".")[0] != "matplotlib":
            raise
        raise MissingExtraError("a figure", "matplotlib", "plot") from error


@contextmanager
def paper_style() -> Iterator[None]:
    """Draw in the style of all figures. Raises as `check_plot`."""
    check_plot()
    import matplotlib as mpl

    with mpl.rc_context(_STYLE):  # type: ignore[arg-type]  # its types know only some of the keys
        yield


def save(figure: Any, file: Path) -> None:
    """Write a figure whole or not at all. Raises OutputError, and InputError as `figure_kind`."""
    figure_kind(file)
    ending = file.suffix.lower().removeprefix(".")
    date = "Date" if ending == "svg" else "CreationDate"
    drawn = BytesIO()
    figure.savefig(drawn, format=ending, metadata={date: None, "Creator": "atlas_cueing"})
    mark: Callable[[bytes], bytes] = _marked_svg if ending == "svg" else _marked_pdf
    try:
        write_whole(file, mark(drawn.getvalue()))
    except OSError as error:
        raise OutputError(f"figure {file}: {error.strerror}") from error


def _marked_svg(content: bytes) -> bytes:
    return content.replace(_SVG, _SVG + _OURS, 1)


def _marked_pdf(content: bytes) -> bytes:
    # as long as what it replaces: a PDF file knows the places of its parts
    return content.replace(_PDF + _PDF_MARK, _PDF + _PDF_OURS, 1)
