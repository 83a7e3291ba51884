"""All bad inputs that `tools/bad_inputs` hands to the command, by kind."""

from . import (
    bad_files,
    bad_logs,
    bad_models,
    bad_options,
    bad_outputs,
    bad_paths,
    bad_recordings,
    bad_sweeps,
)
from .trying import BadInput


def bad_inputs(log: bytes) -> dict[str, list[BadInput]]:
    """Kind to inputs; `log` is a good one, from which bad ones are made."""
    return {
        "values": bad_files.VALUES,
        "texts": bad_files.TEXTS,
        "names": bad_files.NAMES,
        "flights": bad_files.FLIGHTS,
        "overrides": bad_files.OVERRIDES,
        "sweeps": bad_sweeps.SWEEPS,
        "platforms": bad_files.PLATFORMS,
        "paths": bad_paths.PATHS,
        "scripts": bad_models.SCRIPTS,
        "models": bad_models.MODELS,
        "recordings": bad_recordings.RECORDINGS,
        "logs": bad_logs.bad_logs(log),
        "no logs": bad_logs.NOT_THERE,
        "outputs": bad_outputs.OUTPUTS,
        "disks": bad_outputs.DISKS,
        "options": bad_options.OPTIONS,
    }
