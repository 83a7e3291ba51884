"""Options of `atlas-cueing live`; those of other commands as well are in `options`."""

from pathlib import Path
from typing import Annotated, TypeAlias

import typer

Rate: TypeAlias = Annotated[
    float, typer.Option("--rate", help="Ticks a second, 100 to 1000.", metavar="HZ")
]
Duration: TypeAlias = Annotated[
    float | None,
    typer.Option(
        "--duration",
        help="Park after so many seconds; by default when the flight is over.",
        metavar="S",
        min=0.0,
    ),
]
Lead: TypeAlias = Annotated[
    float,
    typer.Option(
        "--lead",
        help="Send set points so much ahead of a tick's end; it bears such lateness. 2 to 80.",
        metavar="MS",
    ),
]
View: TypeAlias = Annotated[
    bool, typer.Option("--view", help="Serve a 3D view with buttons on the loopback (extra: live).")
]
Wait: TypeAlias = Annotated[
    bool, typer.Option("--wait", help="Stay parked until 'engage' is pressed in the view.")
]
SetPoints: TypeAlias = Annotated[
    str | None,
    typer.Option(
        "--setpoints", help="Send set points to a drive controller by UDP.", metavar="HOST:PORT"
    ),
]
KeyFile: TypeAlias = Annotated[
    Path | None,
    typer.Option(
        "--key",
        help="File with a shared key for set points; needed beyond the loopback.",
        metavar="FILE",
    ),
]
DriveStatus: TypeAlias = Annotated[
    bool,
    typer.Option(
        "--no-drive-status",
        help="The receiver of set points tells nothing: it is not asked, and not watched.",
    ),
]
DriveTimeout: TypeAlias = Annotated[
    float | None,
    typer.Option(
        "--drive-timeout",
        help="Stop when the drives are silent for so long while they move, 30 to 1000; 50 by"
        " default, 300 with --plant.",
        metavar="MS",
    ),
]
PoseFile: TypeAlias = Annotated[
    Path | None,
    typer.Option(
        "--pose",
        help="File with the platform's last pose, with --setpoints; by default"
        " $XDG_STATE_HOME/atlas_cueing/pose.json.",
        metavar="FILE",
    ),
]
From: TypeAlias = Annotated[
    str | None,
    typer.Option(
        "--from",
        help="Where the platform stands: home, a file with a pose, or the log of the last run.",
        metavar="home|POSE|LOG",
    ),
]
Foxglove: TypeAlias = Annotated[
    int | None,
    typer.Option(
        "--foxglove",
        help="Serve Foxglove at this port of the loopback (extra: foxglove).",
        metavar="PORT",
        min=0,
        max=65535,
    ),
]
Listen: TypeAlias = Annotated[
    str | None,
    typer.Option(
        "--listen",
        help="Take packets of other machines, too, that come to this address; 0.0.0.0 for all.",
        metavar="ADDRESS",
    ),
]
Priority: TypeAlias = Annotated[
    bool,
    typer.Option(
        "--priority",
        help="Ask for real-time priority, locked memory and a core; report what is refused.",
    ),
]
DriveTolerance: TypeAlias = Annotated[
    float | None,
    typer.Option(
        "--drive-tolerance",
        help="Stop when a wheel is so far off its command; 0.1 by default, 10 with --plant.",
        metavar="DEG",
        min=0.01,
        max=90.0,
    ),
]
Feedback: TypeAlias = Annotated[
    str,
    typer.Option(
        "--feedback",
        help="Correct the attitude by what the drives tell of the cabin's sensors: none, gyro, fix"
        " (gyro and fixes from outside).",
        metavar="KIND",
    ),
]
Plant: TypeAlias = Annotated[
    bool,
    typer.Option(
        "--plant",
        help="Drive a simulated platform whose wheels slip, in place of --setpoints; its log gets"
        " /plant, where the cabin really was.",
    ),
]
