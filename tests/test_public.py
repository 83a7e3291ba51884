"""What a user imports from the package itself."""

import numpy as np
import pytest

import atlas_cueing


def test_loads_of_a_preset() -> None:
    from atlas_cueing import load_platform, platform_loads

    loads = platform_loads(
        load_platform("atlas-2.9m"),
        q_WS=(1.0, 0.0, 0.0, 0.0),
        w_WS_W=(0.0, 0.0, 0.0),
        alpha_WS_W=(0.0, 0.0, 1.0),
        a_WS_W=(1.0, 0.0, 0.0),
    )
    assert loads.moment[2] == pytest.approx(328.3)
    assert loads.force[0] == pytest.approx(490.0)
    assert loads.normal.sum() * np.sin(np.radians(40.0)) == pytest.approx(490.0 * 9.80665)


def test_what_is_not_there() -> None:
    with pytest.raises(AttributeError, match="has no attribute 'nothing'"):
        atlas_cueing.nothing  # noqa: B018
