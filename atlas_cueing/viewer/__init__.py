"""The platform in motion in a browser: a live run, a log, or a file to pass on. viser is imported when something is shown."""

from .play import play
from .process import ViewerProcess
from .replay import write_replay

__all__ = ["ViewerProcess", "play", "write_replay"]
