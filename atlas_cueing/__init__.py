"""Washout-free motion cueing for platforms of unbounded rotation: JSBSim in, wheel velocity profiles out."""

from importlib.metadata import version

__version__ = version("atlas_cueing")
