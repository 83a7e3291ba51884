"""The command `atlas-cueing`, also as `python -m atlas_cueing`."""

import sys

_INTERRUPTED = 130  # 128 + SIGINT, as shells have it


def main() -> int:
    """Run the command; Ctrl-C while it is still being loaded ends it without a traceback."""
    try:
        from .cli import main as command

        return command()
    except KeyboardInterrupt:
        return _INTERRUPTED


if __name__ == "__main__":
    sys.exit(main())
