"""Whatever a path may lead to instead of a file of ours, in every command that takes one."""

from .bad_files import NO_FILES, SCENARIO
from .trying import BadInput

PATHS = [
    *[
        BadInput(f"scenario: {name}", ("run", path), files)
        for name, (path, files) in NO_FILES.items()
    ],
    *[
        BadInput(f"batch: {name}", ("batch", path, "-o", "new"), files)
        for name, (path, files) in NO_FILES.items()
    ],
    *[
        BadInput(f"platform: {name}", ("platform", path), files)
        for name, (path, files) in NO_FILES.items()
    ],
    *[
        BadInput(
            f"platform.file: {name}", ("run", "good.toml", "--set", f"platform.file={path}"), files
        )
        for name, (path, files) in NO_FILES.items()
    ],
    *[
        BadInput(
            f"vehicle.script: {name}",
            ("run", "good.toml", "--trust-models", "--set", f"vehicle.script={path}"),
            files,
        )
        for name, (path, files) in NO_FILES.items()
    ],
    *[
        BadInput(
            f"vehicle.log: {name}",
            ("live", "bad.toml"),
            {
                "bad.toml": SCENARIO.replace(
                    'script = "c1722"', f'source = "recording"\nlog = "{path}"'
                ),
                **files,
            },
        )
        for name, (path, files) in NO_FILES.items()
    ],
]
