"""A flight is read from anything with columns."""

from dataclasses import fields

import numpy as np

from atlas_cueing.evaluation import Flight
from atlas_cueing.signals import TOPICS


class Counted:
    """A log in which every field holds its own place in the table of topics."""

    def __init__(self) -> None:
        names = [(topic.name, field) for topic in TOPICS for field in topic.fields]
        self.place = {name: float(k) for k, name in enumerate(names)}

    def column(self, topic: str, field: str) -> np.ndarray:
        return np.full(2, self.place[topic, field])

    def vector(self, topic: str, name: str) -> np.ndarray:
        """As recording.Log does, in another way: by the full names."""
        units = {"w": "rad_s", "f": "m_s2", "alpha": "rad_s2", "p": "m", "v": "m_s", "a": "m_s2"}
        if topic == "/wheels":
            found = [f"{name}{k}_{'rad_s' if name == 'w' else 'rad_s2'}" for k in (1, 2, 3)]
        elif name.startswith("q"):
            found = [f"{name}_{c}" for c in "wxyz"]
        else:
            found = [f"{name}{c}_{units[name]}" for c in "xyz"]
        return np.column_stack([self.column(topic, field) for field in found])


def test_every_field_comes_from_its_own_column() -> None:
    log = Counted()
    flight = Flight.of(log)
    found = {}
    for field in fields(flight):
        values = getattr(flight, field.name)
        assert values.shape[0] == 2
        found[field.name] = values[0] if values.ndim > 1 else values[:1]
    assert found["time"].tolist() == [log.place["/motion", "time_s"]]
    topics = {"vehicle": "/vehicle", "cue": "/cue", "motion": "/motion", "wheel": "/wheels", "felt": "/felt"}
    symbols = {"q_NB": "q_nb_w", "q_WS": "q_ws_w", "speed": "w1_rad_s", "acceleration": "a1_rad_s2"}
    units = {"w": "wx_rad_s", "f": "fx_m_s2", "alpha": "alphax_rad_s2", "p": "px_m", "v": "vx_m_s", "a": "ax_m_s2"}
    for name, values in found.items():
        prefix, _, symbol = name.partition("_")
        if prefix in topics:
            first = symbols.get(symbol) or units[symbol.split("_")[0]]
            start = log.place[topics[prefix], first]
            assert values.tolist() == [start + k for k in range(len(values))], name
    assert found["limited"].tolist() == [log.place["/motion", f"{part}_limited"] for part in ("wheels", "stage")]
    assert len(found) == 20
