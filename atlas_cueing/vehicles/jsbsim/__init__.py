"""Vehicles that JSBSim flies: scripts and aircraft, their start, inputs, and readings in SI."""
