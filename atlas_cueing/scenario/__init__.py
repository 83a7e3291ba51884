"""Scenario and platform files: what to fly, on which platform, cued how. The only place that knows TOML."""

from .build import build
from .load import load_platform, load_scenario
from .platform import Platform, presets
from .scenario import Scenario, ScenarioFile
from .sweep import Variant, load_variants, scenario_files

__all__ = [
    "Platform",
    "Scenario",
    "ScenarioFile",
    "Variant",
    "build",
    "load_platform",
    "load_scenario",
    "load_variants",
    "presets",
    "scenario_files",
]
