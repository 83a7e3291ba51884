"""Scenario texts that the tests start from."""

SCRIPT = """
name = "short"
duration_s = 0.5
[vehicle]
script = "c1722"
[platform]
preset = "atlas-2.9m"
"""

AIRCRAFT = """
name = "inputs"
description = "a Cessna with two inputs"
duration_s = 0.5
[vehicle]
aircraft = "c172x"
rate_hz = 60
[vehicle.initial]
altitude_m = 1200
airspeed_m_s = 50.0
heading_deg = 90
pitch_deg = 2.5
roll_deg = -10
latitude_deg = 45.0
longitude_deg = -75.0
engines_running = false
trim = false
[[vehicle.input]]
time_s = 0.1
property = "fcs/elevator-cmd-norm"
value = -0.2
[[vehicle.input]]
time_s = 0.2
property = "fcs/aileron-cmd-norm"
value = 1
ramp_s = 0.25
[platform]
preset = "atlas-1.5m"
[cueing]
method = "attitude"
rotation_gain = [1, 0.5, 1]
"""

# A user's own script, for one of JSBSim's aircraft with that aircraft's own initial conditions.
USER_SCRIPT = """<?xml version="1.0"?>
<runscript name="glide">
  <use aircraft="c172x" initialize="{initial}"/>
  <run start="0.0" end="0.5" dt="0.01"/>
</runscript>
"""

INITIAL = """<?xml version="1.0"?>
<initialize name="start">
  <ubody unit="FT/SEC"> 150.0 </ubody>
  <altitude unit="FT"> 4000.0 </altitude>
</initialize>
"""

# Two test signals: a sweep of the roll rate and a step of the side force.
SIGNALS = """
name = "signals"
[vehicle]
source = "signal"
rate_hz = 50
force_follows_attitude = false
[[vehicle.signal]]
axis = "roll_rate"
shape = "sweep"
amplitude_deg_s = 90
frequency_rad_s = 0.5
end_frequency_rad_s = 5
time_s = 0.5
duration_s = 2.0
ramp_s = 0.5
[[vehicle.signal]]
axis = "force_y"
shape = "step"
amplitude_m_s2 = -2.0
duration_s = 1.0
[platform]
preset = "atlas-2.9m"
"""
