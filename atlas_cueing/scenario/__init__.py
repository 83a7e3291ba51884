"""Scenario and platform files: what to fly, on which platform, cued how. The only place that knows TOML."""

from .build import build
from .load import load_platform, load_scenario
from .platform import Platform, presets
from .scenario import Scenario, ScenarioFile

__all__ = ["Platform", "Scenario", "ScenarioFile", "build", "load_platform", "load_scenario", "presets"]
