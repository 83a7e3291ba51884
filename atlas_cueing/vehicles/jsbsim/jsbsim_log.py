"""JSBSim's console output, to Python's logging under the name `atlas_cueing.jsbsim`."""

import logging

import jsbsim

LOGGER = logging.getLogger("atlas_cueing.jsbsim")
# without it logging's last resort prints warnings to stderr
LOGGER.addHandler(logging.NullHandler())

_LEVELS = {
    jsbsim.LogLevel.BULK: logging.DEBUG,
    jsbsim.LogLevel.DEBUG: logging.DEBUG,
    jsbsim.LogLevel.INFO: logging.INFO,
    jsbsim.LogLevel.STDOUT: logging.INFO,  # notifications of scripts
    jsbsim.LogLevel.WARN: logging.WARNING,
    jsbsim.LogLevel.ERROR: logging.ERROR,
    jsbsim.LogLevel.FATAL: logging.ERROR,
}


class JsbsimLog(jsbsim.FGLogger):
    """Gathers the fragments of each record.

    `complaint` keeps the last error for messages of our own.
    """

    def __init__(self) -> None:
        super().__init__()
        self.complaint = ""
        self._level = logging.DEBUG
        self._parts: list[str] = []

    def set_level(self, level: jsbsim.LogLevel) -> None:
        """Start a record."""
        self._level = _LEVELS[level]
        self._parts.clear()

    def file_location(self, filename: str, line: int) -> None:
        """Say which line of a file the record is about."""
        self._parts.append(f"{filename}:{line}: ")

    def message(self, message: str) -> None:
        """Add a fragment."""
        self._parts.append(message)

    def format(self, format: jsbsim.LogFormat) -> None:  # noqa: A002  the name is JSBSim's
        """Colours are not kept."""

    def flush(self) -> None:
        """End the record and hand it on."""
        text = " ".join("".join(self._parts).split())
        if text and self._level >= logging.ERROR:
            self.complaint = text
        if text:
            LOGGER.log(self._level, text)


def capture() -> JsbsimLog:
    """Take over the output of every JSBSim instance of this thread.

    It stays silent but for what logging shows.
    """
    log = JsbsimLog()
    jsbsim.set_logger(log)
    return log
