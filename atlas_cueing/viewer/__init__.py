"""The platform in motion in a browser: a live run, a log, or a file to pass on.

viser is imported when something is shown.
"""

from .play import play
from .replay import write_replay
from .viewer_process import ViewerProcess

__all__ = [
    "ViewerProcess",
    "play",
    "write_replay",
]
