"""The protocol's frames: those of the documentation, and damage to them."""

import doctest
import re
import struct
from pathlib import Path

import pytest

from microimpact import link

PAGE = (Path(__file__).parents[3] / "src/instrument/link/protocol.md").read_text()
OWN = link.Schema(number=1, reading=link.PLANAR, classes=link.FRICTION)


def golden(beginning):
    """The frames of the documentation by their descriptions."""
    frames = PAGE.split(beginning)[1].split("```")[1]
    return {text: bytes.fromhex(frame) for text, frame in re.findall(r"^(\S.*)\n    ([0-9a-f ]+)$", frames, re.M)}


def test_requests():
    frames = golden("From the host")
    written = {
        "Event, number 1: 2.8, 0 and 0.739 m/s": link.event(OWN, 1, [2.8, 0.0, 0.739]),
        "Report, number 300": link.request("report", 300),
        "Describe, number 2": link.request("describe", 2),
        "Counts, number 3": link.request("counts", 3),
        "Reset, number 4": link.request("reset", 4),
        "Configure, number 5: Table 1 as a rigid body": link.configure(
            OWN,
            5,
            link.rigid_body(("speed", 130.0), ("work", 2.22e-12)),
            radius=5.06e-6,
            density=2600,
            friction=0.1,
        ),
        "Configure, number 6: the law of Johnson, Kendall and Roberts": link.configure(
            OWN,
            6,
            link.contact(7.5e10, ("hysteretic", 10.5), ("jkr snap-off", 0.2)),
            radius=5.06e-6,
            density=2600,
        ),
    }
    assert written.keys() == frames.keys()
    for text, frame in written.items():
        assert frames[text] == frame, text


def test_replies():
    frames = golden("From the instrument")
    decoder = link.Decoder(OWN)
    found = {text: decoder.feed(frame) for text, frame in frames.items()}
    assert len(found) == 10 and all(len(replies) == 1 for replies in found.values()) and not decoder.faults
    replies = {text: (reply.kind, reply.number, reply.fields) for text, [reply] in found.items()}
    schema = {"protocol": 3, "schema": OWN}
    assert replies["Started"] == ("started", 0, schema)
    assert replies["Description, number 2"] == ("description", 2, schema)
    classified = replies["Classified, number 1: rebound, rolling, e = 0.746"]
    assert classified[:2] == ("classified", 1) and classified[2]["class"] == "rebound rolling"
    assert classified[2]["restitution"] == pytest.approx(0.746, abs=1e-7)
    assert replies["Classified, number 2: captured, resting"][2]["class"] == "captured resting"
    kind, number, fields = replies["Rejected, number 3: approach speed of -2.8 m/s"]
    assert (kind, number, fields["parameter"], fields["fault"]) == ("rejected", 3, 8, 1)
    assert f"| {fields['parameter']} | approach speed |" in PAGE
    assert fields["value"] == pytest.approx(-2.8)
    assert replies["Rejected, number 4: unsolved"][2] == {"reason": "the method did not converge"}
    assert replies["Counts, number 3: 12, 800, 5, 80, 100 and 0"][2] == {"counts": [12, 800, 5, 80, 100, 0]}
    assert replies["Refused, number 6: the scene is fixed"][2] == {"reason": "the scene does not change"}
    assert replies["Configured, number 5"] == ("configured", 5, {})
    report = replies["Report, number 300"]
    expected = {
        "events": 1000,
        "reports": 1,
        "commands": 2,
        "missing": 2,
        "checksum": 2,
        "classified": 997,
        "refused": 3,
    }
    expected |= {"answered_reports": 1, "answered_commands": 2, "ticks": 123_456}
    assert report[:2] == ("report", 300) and report[2] == {name: expected.get(name, 0) for name in link.REPORT}


def test_damage_is_found_and_the_next_frame_read():
    after = link.frame(b"\x07\x4d")
    for frame in golden("From the instrument").values():
        for index in range(1, len(frame) - 1):
            for bit in range(8):
                decoder = link.Decoder(OWN)
                damaged = bytearray(frame)
                damaged[index] ^= 1 << bit
                assert decoder.feed(damaged + after) == [link.Reply("configured", 77)]
                assert decoder.faults


def test_messages_that_end_early_or_late():
    for frame in golden("From the instrument").values():
        message = link.unframe(frame[1:-1])
        for shorter in range(len(message)):
            with pytest.raises(link.LinkError):
                link.read(message[:shorter], OWN)
        with pytest.raises(link.LinkError, match="1 bytes too many"):
            link.read(message + b"\0", OWN)


@pytest.mark.parametrize(
    "other",
    [link.Schema(2, 3, 2), link.Schema(1, 19, 2), link.Schema(1, 3, 1)],
)
def test_other_instruments_are_refused_by_name(other):
    with pytest.raises(link.SchemaError, match=re.escape(f"has {OWN}, but must have {other}")):
        link.Decoder(other).feed(golden("From the instrument")["Started"])


def test_another_version_is_refused():
    with pytest.raises(link.SchemaError, match="version 2 of the protocol, but must speak version 3"):
        link.Decoder(OWN).feed(link.frame(b"\0\x02"))


def test_noise_and_pieces():
    frames = b"".join(golden("From the instrument").values())
    decoder = link.Decoder(OWN)
    replies = decoder.feed(b"noise" * 1000)
    for byte in frames:
        replies += decoder.feed([byte])
    assert len(replies) == 10 and [str(fault) for fault in decoder.faults] == ["a frame is longer than any message"]


def test_events_of_other_schemas():
    schema = link.Schema(2, link.NORMAL | link.SIZED | link.STAMPED, link.OUTCOMES)
    message = link.unframe(link.event(schema, 300, [2.8], ticks=129, radius=5e-6, material=7)[1:-1])
    assert message == b"\0\xac\x02\x81\x01" + struct.pack("<d", 5e-6) + b"\x07" + struct.pack("<d", 2.8)
    with pytest.raises(ValueError, match="has 3 values, but there are 1"):
        link.event(OWN, 1, [2.8])
    for value in (float("nan"), float("inf"), 1e39):
        with pytest.raises(ValueError, match="must be a finite number"):
            link.event(OWN, 1, [value, 0, 0])
    with pytest.raises(ValueError, match="must be 0 to 255"):
        link.event(OWN, 1, [1, 2, 3], material=256)
    with pytest.raises(ValueError, match="must be 0 to 4294967295"):
        link.request("report", -1)
    with pytest.raises(ValueError, match="one of report"):
        link.request("anything", 1)


def test_the_example_of_the_documentation():
    assert doctest.testmod(link).attempted > 4 and doctest.testmod(link).failed == 0


def test_scenes_that_there_are_not():
    with pytest.raises(
        ValueError, match="damping is 'strong', but must be one of none, hysteretic, viscoelastic, constant"
    ):
        link.contact(1e10, ("strong", 1.0))
    with pytest.raises(ValueError, match="restitution 'power' has 2 numbers, but there are 1"):
        link.rigid_body(("power", 1.0))


def test_a_zero_byte_is_in_no_frame():
    with pytest.raises(link.LinkError, match="not encoded by COBS"):
        link.unframe(b"\0abc")
