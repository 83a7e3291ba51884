"""Scenario and platform files: what to fly, on which platform, cued how.

The only place that knows TOML.
"""

from .load import load_platform, load_scenario
from .platform_file import Platform, presets
from .recorded import RecordedFlight, checked_vehicle, recorded_vehicle, regular_vehicle
from .scenario import Scenario, ScenarioFile
from .sweep import Variant, load_variants, scenario_files

__all__ = [
    "Platform",
    "RecordedFlight",
    "Scenario",
    "ScenarioFile",
    "Variant",
    "checked_vehicle",
    "load_platform",
    "load_scenario",
    "load_variants",
    "presets",
    "recorded_vehicle",
    "regular_vehicle",
    "scenario_files",
]
