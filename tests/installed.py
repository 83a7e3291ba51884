"""What is under test: the package as it is installed, and the source tree where it lies beside."""

from pathlib import Path

import pytest

import atlas_cueing
from atlas_cueing import rotation

ROOT = Path(__file__).resolve().parents[1]
PACKAGE = Path(atlas_cueing.__file__).parent
PRESETS = PACKAGE / "scenario" / "presets"
COMPILED = not str(rotation.__file__).endswith(".py")
needs_source_tree = pytest.mark.skipif(
    not (ROOT / "atlas_cueing").is_dir(), reason="needs the source tree beside the tests"
)
