"""The table of the log: names are a contract with everyone who opens one."""

import pytest

from atlas_cueing.signals import (
    TOPICS,
    Cue,
    Motion,
    Tick,
    Topic,
    VehicleState,
    WheelSpeeds,
    tick_row,
)

CUE = [
    *(
        "time_s",
        "q_ws_w",
        "q_ws_x",
        "q_ws_y",
        "q_ws_z",
        "wx_rad_s",
        "wy_rad_s",
        "wz_rad_s",
        "px_m",
        "py_m",
        "pz_m",
    ),
    *("vx_m_s", "vy_m_s", "vz_m_s", "ax_m_s2", "ay_m_s2", "az_m_s2"),
]
EXPECTED = {
    "/vehicle": [
        *("time_s", "q_nb_w", "q_nb_x", "q_nb_y", "q_nb_z", "wx_rad_s", "wy_rad_s", "wz_rad_s"),
        *("fx_m_s2", "fy_m_s2", "fz_m_s2"),
    ],
    "/cue": CUE,
    "/motion": [
        *CUE[:8],
        *("alphax_rad_s2", "alphay_rad_s2", "alphaz_rad_s2"),
        *CUE[8:],
        *("wheels_limited", "stage_limited"),
    ],
    "/wheels": [
        "time_s",
        "w1_rad_s",
        "w2_rad_s",
        "w3_rad_s",
        "a1_rad_s2",
        "a2_rad_s2",
        "a3_rad_s2",
    ],
    "/felt": [
        *(
            "time_s",
            "fx_m_s2",
            "fy_m_s2",
            "fz_m_s2",
            "wx_rad_s",
            "wy_rad_s",
            "wz_rad_s",
            "direction_error_rad",
        ),
    ],
}


@pytest.mark.parametrize("topic", TOPICS, ids=lambda topic: topic.name)
def test_fields(topic: Topic) -> None:
    assert list(topic.fields) == EXPECTED[topic.name]


def test_topics_and_schemas() -> None:
    assert [(topic.name, topic.schema) for topic in TOPICS] == [
        ("/vehicle", "atlas.Vehicle"),
        ("/cue", "atlas.Cue"),
        ("/motion", "atlas.Motion"),
        ("/wheels", "atlas.Wheels"),
        ("/felt", "atlas.Felt"),
    ]


def test_a_row_has_its_numbers_in_the_order_of_the_table() -> None:
    """Every number of a tick is put in as the name of its field, so that any mix-up shows."""
    names = [(topic.name, field) for topic in TOPICS[:4] for field in topic.fields]
    numbers = iter([float(k) for k in range(len(names))])

    def take(count: int) -> tuple[float, ...]:
        return tuple(next(numbers) for _ in range(count))

    (t0,), q0, w0, f0 = take(1), take(4), take(3), take(3)
    vehicle = VehicleState(time=t0, q_NB=q0, w_NB_B=w0, f_B=f0)
    (t1,), q1, w1, p1, v1, a1 = take(1), take(4), take(3), take(3), take(3), take(3)
    cue = Cue(time=t1, q_WS=q1, w_WS_W=w1, p_WS_W=p1, v_WS_W=v1, a_WS_W=a1)
    (t2,), q2, w2, alpha, p2, v2, a2, limited = (
        take(1),
        take(4),
        take(3),
        take(3),
        take(3),
        take(3),
        take(3),
        take(2),
    )
    motion = Motion(
        time=t2,
        q_WS=q2,
        w_WS_W=w2,
        alpha_WS_W=alpha,
        p_WS_W=p2,
        v_WS_W=v2,
        a_WS_W=a2,
        limited=limited,
    )
    (t3,), speed, acceleration = take(1), take(3), take(3)
    wheels = WheelSpeeds(time=t3, speed=speed, acceleration=acceleration)
    assert list(tick_row(Tick(vehicle, cue, motion, wheels))) == [
        float(k) for k in range(len(names))
    ]
    assert next(numbers, None) is None
