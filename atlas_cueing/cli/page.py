"""Where a page for the browser may go."""

from pathlib import Path

from ..errors import OutputError


def check_page(file: Path | None, *, force: bool) -> None:
    """As `batch.check_output`, for a page. Raises OutputError when it cannot be written, or exists and `force` is not given."""
    from ..batch import check_output

    if file is None:
        return
    try:
        check_output(file, force=force)
    except OutputError as error:
        raise OutputError(str(error).replace("log ", "page ", 1)) from error
