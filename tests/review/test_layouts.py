"""The layouts for Foxglove and PlotJuggler name fields that logs have."""

import json
import re
from pathlib import Path
from xml.etree import ElementTree

import pytest
from mcap.reader import make_reader
from mcap_protobuf.decoder import DecoderFactory

TOOLS = Path(__file__).parents[2] / "tools"


@pytest.fixture(scope="module")
def fields(flight: Path) -> set[tuple[str, str]]:
    """Topics and fields of a log, by mcap's reader and mcap-protobuf-support's decoder."""
    with flight.open("rb") as file:
        first = {
            channel.topic: message
            for _, channel, _, message in make_reader(
                file, decoder_factories=[DecoderFactory()]
            ).iter_decoded_messages()
        }
    ticks = {"/vehicle", "/cue", "/motion", "/wheels", "/felt", "/loads"}
    assert {*ticks, "/status", "/tf"} == first.keys()
    return {
        (topic, field.name)
        for topic, message in first.items()
        for field in message.DESCRIPTOR.fields
    }


def test_foxglove(fields: set[tuple[str, str]]) -> None:
    layout = json.loads((TOOLS / "foxglove_layout.json").read_text())
    panels = layout["configById"]
    paths = [path["value"] for panel in panels.values() for path in panel.get("paths", ())]
    assert len(paths) > 15
    assert {(topic, field) for topic, field in (path.split(".") for path in paths)} <= fields
    assert panels["RawMessages!status"]["topicPath"] == "/status"
    placed = re.findall(r'"(\w+!\w+)"', json.dumps(layout["layout"]))
    assert sorted(placed) == sorted(panels)


def test_plotjuggler(fields: set[tuple[str, str]]) -> None:
    # Our own file
    root = ElementTree.parse(TOOLS / "plotjuggler_layout.xml").getroot()  # noqa: S314
    curves = [curve.attrib["name"] for curve in root.iter("curve")]
    assert len(curves) > 15
    assert {
        (topic, field) for topic, _, field in (curve.rpartition("/") for curve in curves)
    } <= fields
    for splitter in root.iter("DockSplitter"):
        assert int(splitter.attrib["count"]) == len(splitter.findall("DockArea"))
