"""Which numbers of a layout a design may change, and how far."""

from collections.abc import Mapping, Sequence
from math import isfinite

from ..errors import InputError
from ..scenario import Platform
from .layout import Layout

SEARCHED = ("elevation", "skew", "azimuth", "radius", "gear")
PRELOAD = "preload"  # not searched: the least that is needed follows from the layout
_BOUNDS = {  # what a range may be, exclusive at the poles
    "elevation": (1.0, 89.0),
    "skew": (-89.0, 89.0),
    "azimuth": (-360.0, 360.0),
    "radius": (0.001, 100.0),
    "gear": (0.001, 10_000.0),
}
_ELEVATION = (20.0, 60.0)  # deg; lower ones need a base wider than the sphere
_SKEW = (-70.0, 70.0)  # deg
_FACTOR = 2.0  # wheel radius and gear: from half of what they are to twice


def ranges_of(
    vary: Sequence[str], texts: Sequence[str], start: Layout, platform: Platform
) -> tuple[dict[str, tuple[float, float]], bool]:
    """Ranges (low, high) of what is searched, and whether the preload is given to the layout.

    vary: words, or lists of them with commas. texts: ranges as KEY=LOW:HIGH, in deg, m, or turns.
    Raises InputError for unknown words, for ranges of what is not varied, for nothing to vary, and
    for the gear of a platform that names none.
    """
    words = [word.strip() for text in vary for word in text.split(",")]
    for word in words:
        if word not in (*SEARCHED, PRELOAD):
            raise InputError(f"--vary {word}: allowed: {', '.join((*SEARCHED, PRELOAD))}")
    if "gear" in words and not (platform.drive and platform.drive.gear):
        raise InputError(
            f"--vary gear: platform {platform.name!r} has no drive.gear, so nothing is known of a"
            " motor; give it [drive] with gear, or search without"
        )
    usual: Mapping[str, tuple[float, float]] = {
        "elevation": _ELEVATION,
        "skew": _SKEW,
        "azimuth": (0.0, 360.0 / len(platform.wheel)),
        "radius": (start.radius / _FACTOR, start.radius * _FACTOR),
        "gear": (start.gear / _FACTOR, start.gear * _FACTOR),
    }
    asked = dict(_range(text, words) for text in texts)
    ranges = {word: asked.get(word, usual[word]) for word in SEARCHED if word in words}
    if not ranges:
        raise InputError(
            f"--vary: nothing to search, allowed: one of {', '.join(SEARCHED)} or more"
        )
    return ranges, PRELOAD in words


def layout_asked(text: str, start: Layout) -> Layout:
    """The layout of ELEVATION/SKEW or ELEVATION/SKEW/AZIMUTH, in deg; else as `start`.

    Raises InputError for anything else.
    """
    values = [_number(part) for part in text.split("/")]
    words = ("elevation", "skew", "azimuth")[: len(values)]
    if not 2 <= len(values) <= 3 or not all(
        value is not None and _BOUNDS[word][0] <= value <= _BOUNDS[word][1]
        for word, value in zip(words, values, strict=False)
    ):
        raise InputError(
            f"--also {text}: allowed: ELEVATION/SKEW or ELEVATION/SKEW/AZIMUTH in deg, within"
            " 1..89, -89..89, -360..360, as 30/48.2"
        )
    return start.with_values({w: v for w, v in zip(words, values, strict=True) if v is not None})


def _range(text: str, words: Sequence[str]) -> tuple[str, tuple[float, float]]:
    word, _, bounds = text.partition("=")
    low, high = (_number(part) for part in (*bounds.split(":"), "", "")[:2])
    if word not in SEARCHED or word not in words:
        varied = ", ".join(each for each in words if each in SEARCHED)
        raise InputError(f"--range {text}: allowed: KEY=LOW:HIGH, KEY one of --vary: {varied}")
    least, most = _BOUNDS[word]
    if bounds.count(":") != 1 or low is None or high is None or not least <= low < high <= most:
        raise InputError(
            f"--range {text}: allowed: {word}=LOW:HIGH with {least:g} <= LOW < HIGH <= {most:g}"
        )
    return word, (low, high)


def _number(text: str) -> float | None:
    try:
        value = float(text)
    except ValueError:
        return None
    return value if isfinite(value) else None
