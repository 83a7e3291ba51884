"""What a worker makes before its first run."""

import subprocess
import sys

from atlas_cueing.batch.warm_up import warm_up
from atlas_cueing.cueing import METHODS


def test_it_flies() -> None:
    assert warm_up() == "ok"


def test_no_child_has_to_make_the_table_of_a_method() -> None:
    code = (
        "from atlas_cueing.batch.warm_up import warm_up\n"
        "from atlas_cueing.scenario.cueing_table import PackageMethodTable\n"
        "print(warm_up(), len(PackageMethodTable.__subclasses__()))"
    )
    ran = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert ran.stdout.split() == ["ok", str(len(METHODS))]
