"""Scenarios whose vehicle is none of JSBSim's."""

FLIGHTGEAR = """
name = "elsewhere"
[vehicle]
source = "flightgear"
[platform]
preset = "atlas-2.9m"
"""

RIGID_BODY = """
name = "tumble"
duration_s = 2.0
[vehicle]
source = "rigid_body"
inertia_kg_m2 = [3.0, 2.0, 1.2]
initial_rate_deg_s = [0.3, 40.0, 0.5]
[platform]
preset = "atlas-2.9m"
"""


TRACK = """
name = "ride"
[vehicle]
source = "track"
points_m = [[0, 0, 0], [5, 0, 0], [10, 0, 1], [15, 0, 2], [20, 0, 1], [25, 0, 0], [30, 0, 0]]
speed_m_s = 12.0
[platform]
preset = "atlas-2.9m"
"""


RECORDING = FLIGHTGEAR.replace('"flightgear"', '"recording"\nlog = "logs/flown.mcap"')
