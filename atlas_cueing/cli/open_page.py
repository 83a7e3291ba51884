"""Where pages for the browser may go."""

from collections.abc import Sequence
from pathlib import Path


def check_pages(
    files: Sequence[Path | None], *, inputs: Sequence[Path], force: bool
) -> list[Path | None]:
    """Find out where pages go, by `batch.check_output`; None stands for one that is not asked for.

    Raises OutputError when one cannot be written, or exists and may not be replaced.
    """
    from ..run import PAGE, check_output

    real: list[Path | None] = []
    for file in files:
        others = [page for page in real if page]
        checked = file and check_output(file, PAGE, inputs=inputs, outputs=others, force=force)
        real.append(checked)
    return real
