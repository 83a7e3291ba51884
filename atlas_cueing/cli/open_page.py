"""Check of the files into which pages for the browser, and figures for papers, are written."""

from collections.abc import Sequence
from pathlib import Path


def check_pages(
    files: Sequence[Path | None], *, inputs: Sequence[Path], force: bool
) -> list[Path | None]:
    """Check where pages are written, by `run.check_output`.

    files: one for each page, None for a page that is not written; inputs: files that must not be
    replaced; force: whether pages may be replaced. Gives the checked paths in the same order.

    Raises OutputError when one cannot be written, or exists and may not be replaced.
    """
    from ..run import PAGE, check_output

    real: list[Path | None] = []
    for file in files:
        others = [page for page in real if page]
        checked = file and check_output(file, PAGE, inputs=inputs, outputs=others, force=force)
        real.append(checked)
    return real


def check_figure(
    file: Path | None,
    *,
    inputs: Sequence[Path],
    pages: Sequence[Path | None] = (),
    force: bool,
) -> Path | None:
    """Check where a figure is written, if one is, as `check_pages` does; give its real path.

    pages: that are written as well. Raises InputError for another ending than .svg and .pdf, and
    MissingExtraError without what draws it.
    """
    if file is None:
        return None
    from ..review.figures import check_plot, figure_kind
    from ..run import check_output

    check_plot()
    others = [page for page in pages if page]
    return check_output(file, figure_kind(file), inputs=inputs, outputs=others, force=force)
