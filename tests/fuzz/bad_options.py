"""Commands, options and arguments that are none."""

from .bad_files import NO_FILES, SCENARIO
from .trying import BadInput, Folder

OPTIONS = [
    BadInput("no such command", ("fly",)),
    BadInput("no such option", ("run", "--nope")),
    BadInput("no argument", ("run",)),
    BadInput("batch --jobs 0", ("batch", "good.toml", "-o", "new", "--jobs", "0")),
    BadInput("batch --time-limit nan", ("batch", "good.toml", "-o", "new", "--time-limit", "nan")),
    BadInput(
        "batch --memory-limit -1", ("batch", "good.toml", "-o", "new", "--memory-limit", "-1")
    ),
    BadInput("batch --sort nothing", ("batch", "good.toml", "-o", "new", "--sort", "beauty")),
    BadInput(
        "batch --cluster nowhere", ("batch", "good.toml", "-o", "new", "--cluster", "nowhere")
    ),
    BadInput(
        "batch of an empty folder",
        ("batch", "empty", "-o", "new"),
        {"empty": Folder()},
        says="no scenario files",
    ),
    BadInput("live --rate 1e9", ("live", "good.toml", "--rate", "1e9"), says="--rate"),
    BadInput("live --rate nan", ("live", "good.toml", "--rate", "nan"), says="--rate"),
    BadInput("live --duration nan", ("live", "good.toml", "--duration", "nan"), says="duration"),
    BadInput("live --wait without --view", ("live", "good.toml", "--wait"), says="--view"),
    BadInput("live --port 65536", ("live", "good.toml", "--view", "--port", "65536")),
    BadInput("live --foxglove -1", ("live", "good.toml", "--foxglove", "-1")),
    BadInput("live --setpoints x:y", ("live", "good.toml", "--setpoints", "x:y"), says="HOST:PORT"),
    BadInput(
        "live --setpoints to all",
        ("live", "good.toml", "--setpoints", "0.0.0.0:5600"),
        says="one machine",
    ),
    BadInput(
        "live --setpoints beyond the loopback",
        ("live", "good.toml", "--setpoints", "192.0.2.1:5600"),
        says="key",
    ),
    BadInput(
        "live --setpoints by name", ("live", "good.toml", "--setpoints", "example.invalid:5600")
    ),
    BadInput("live --key alone", ("live", "good.toml", "--key", "good.toml"), says="--setpoints"),
    *[
        BadInput(
            f"live --key: {name}",
            ("live", "good.toml", "--setpoints", "127.0.0.1:5600", "--key", path),
            files,
            says="--key",
        )
        for name, (path, files) in {**NO_FILES, "empty": ("it", {"it": ""})}.items()
        if name != "FIFO"  # perhaps a password manager writes to it
    ],
    BadInput(
        "a source that flies only live",
        ("run", "bad.toml"),
        {"bad.toml": SCENARIO.replace('script = "c1722"', 'source = "flightgear"')},
    ),
]
