"""A process that flies a script of JSBSim and sends each step to a port.

It makes a step for each line of stdin: `python jsbsim_sender.py`.

The packets are JSBSim's own. What JSBSim says of the same step goes to stdout, as a line of JSON.
"""

import json
import sys
import warnings
from pathlib import Path
from tempfile import TemporaryDirectory

from atlas_cueing.vehicles import ScriptFlight, own_scripts
from atlas_cueing.vehicles.jsbsim.loading import load
from atlas_cueing.vehicles.jsbsim.start import initialise

NAMES = {
    "rates": ("velocities/p-rad_sec", "velocities/q-rad_sec", "velocities/r-rad_sec"),
    "force": tuple(f"accelerations/a-pilot-{axis}-ft_sec2" for axis in "xyz"),
    "place": (
        "position/radius-to-vehicle-ft",
        "position/lat-gc-rad",
        "accelerations/gravity-ft_sec2",
    ),
    "theta": ("attitude/theta-rad",),
}


def main() -> None:
    """Serve."""
    script, port = sys.argv[1:]
    warnings.simplefilter("ignore", PendingDeprecationWarning)  # of numpy.matrix
    fdm = load(ScriptFlight(own_scripts()[script]))
    with TemporaryDirectory() as folder:
        output = Path(folder) / "output.xml"
        output.write_text(
            f'<output name="127.0.0.1" type="FLIGHTGEAR" port="{port}" protocol="UDP"'
            ' rate="1000"></output>'
        )
        rate = 1.0 / fdm.get_delta_t()
        output.write_text(output.read_text().replace("1000", f"{rate:.6f}"))
        fdm.set_output_directive(str(output))
    initialise(fdm)
    for line in sys.stdin:
        for _ in range(int(line)):
            fdm.run()
        told = {name: [fdm[entry] for entry in entries] for name, entries in NAMES.items()}
        told["body_from_north"] = fdm.get_propagate().get_Tl2b().tolist()
        sys.stdout.write(json.dumps(told) + "\n")
        sys.stdout.flush()


if __name__ == "__main__":
    main()
