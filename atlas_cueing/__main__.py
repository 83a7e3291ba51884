"""The command `atlas-cueing`, also as `python -m atlas_cueing`."""

import gc
import os
import sys

_INTERRUPTED = 130  # 128 + SIGINT, as shells have it


def main() -> int:
    """Run the command; Ctrl-C while it is still being loaded ends it without a traceback."""
    try:
        _speed_up_start()
        from .cli import main as command

        return command()
    except KeyboardInterrupt:
        return _INTERRUPTED
    finally:
        # the interpreter's search for cycles in all that is left takes 60 ms, and frees for nobody
        gc.freeze()


def _speed_up_start() -> None:
    """Save time at the start: no threads of OpenBLAS, no plugins, no collections amid imports."""
    # matrices of three columns gain nothing from a thread for each core
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    # pydantic would look through every installed package for plugins of its own
    os.environ.setdefault("PYDANTIC_DISABLE_PLUGINS", "__all__")
    # collections amid the imports take 14 ms and find nothing; they make some 100,000 objects
    gc.set_threshold(200_000, *gc.get_threshold()[1:])


if __name__ == "__main__":
    sys.exit(main())
