"""Workers of a design."""

import os
from multiprocessing import active_children
from operator import add
from signal import SIGINT

from atlas_cueing.design.spread import spread


def test_ctrl_c_is_for_the_driver_alone_also_while_workers_start() -> None:
    with spread(2, None) as crew:
        started = active_children()
        assert len(started) == 2
        for child in started:
            assert child.pid
            os.kill(child.pid, SIGINT)
        assert sorted(crew.each(add, 1, [1, 2, 3])) == [(0, 2), (1, 3), (2, 4)]
