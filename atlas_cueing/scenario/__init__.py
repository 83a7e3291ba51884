"""Scenario and platform files: what to fly, on which platform, cued how. The only place that knows TOML."""

from .build import build, prepare
from .evaluate import Evaluation, Evaluator, evaluate, evaluate_flight
from .load import load_platform, load_scenario
from .platform import Platform, presets
from .recorded import RecordedFlight, recorded_vehicle
from .scenario import Scenario, ScenarioFile
from .sweep import Variant, load_variants, scenario_files

__all__ = [
    "Evaluation",
    "Evaluator",
    "Platform",
    "RecordedFlight",
    "Scenario",
    "ScenarioFile",
    "Variant",
    "build",
    "evaluate",
    "evaluate_flight",
    "load_platform",
    "load_scenario",
    "load_variants",
    "prepare",
    "presets",
    "recorded_vehicle",
    "scenario_files",
]
