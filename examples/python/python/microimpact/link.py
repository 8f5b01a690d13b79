"""The serial protocol of instruments: frames, requests and replies.

>>> from microimpact.link import FRICTION, PLANAR, Decoder, Schema, event
>>> schema = Schema(number=1, reading=PLANAR, classes=FRICTION)
>>> decoder = Decoder(schema)
>>> event(schema, number=1, values=[2.8, 0.0, 0.739]).hex(" ")
'00 01 06 01 33 33 33 40 01 01 01 09 1b 2f 3d 3f 57 e7 c3 eb 00'
>>> [reply] = decoder.feed(bytes.fromhex("00 0d 01 01 01 01 db f9 3e 3f d1 6e 20 45 00"))
>>> reply.kind, reply.number, reply.fields["class"], round(reply.fields["restitution"], 6)
('classified', 1, 'rebound rolling', 0.746)

It needs nothing but Python, and copies into any program. The documentation of `microimpact::instrument::link` describes the protocol,
byte by byte.
"""

from __future__ import annotations

import math
import struct
import zlib
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field

PROTOCOL = 3
"""Version of the protocol."""

LARGEST_MESSAGE = 192
"""Most bytes of a message with its checksum."""

NORMAL, OBLIQUE, PLANAR, UNCERTAIN = 1, 2, 3, 4
"""Readings; UNCERTAIN has the radius too, and each value is followed by its standard error."""
SIZED, STAMPED = 16, 32
"""Added to the others: radius and material; ticks of a clock."""
OUTCOMES, FRICTION, BOUNDARY_TABLE, RESTITUTION_TABLE = 1, 2, 3, 4
"""Sets of classes."""

CLASSES = {
    OUTCOMES: ("rebound", "capture", "undecided"),
    FRICTION: (
        "rebound sliding",
        "rebound rolling",
        "captured sliding",
        "captured rolling",
        "captured resting",
        "undecided",
    ),
    BOUNDARY_TABLE: ("rebound", "capture", "too close to call", "outside the table"),
    RESTITUTION_TABLE: ("rebound sliding", "rebound rolling", "capture", "too close to call", "outside the table"),
}
"""Names of the classes of each set."""

REPORT = (
    "events",
    "reports",
    "commands",
    "duplicates",
    "missing",
    "oversized",
    "stuffing",
    "checksum",
    "content",
    "lost",
    "classified",
    "refused",
    "unsolved",
    "answered_reports",
    "answered_commands",
    "signal_failures",
    "ticks",
)
"""Names of the numbers of a report."""

RESTITUTIONS = ("constant", "speed", "power", "elastic-plastic", "viscoelastic")
REBOUND_ADHESIONS = ("none", "coefficient", "work", "speed")
DAMPINGS = ("none", "hysteretic", "viscoelastic", "constant")
ADHESIONS = ("none", "without tension", "ring", "dmt", "jkr snap-off", "jkr pull-off")
"""Terms of a scene, in the order of the protocol."""

_REQUESTS = {"report": 1, "describe": 2, "counts": 3, "reset": 4}
_REPLIES = (
    "started",
    "classified",
    "rejected",
    "report",
    "description",
    "counts",
    "reset",
    "configured",
    "refused",
)
_NUMBERS = {1: "<f", 2: "<d"}
# The largest finite number of each type.
_LARGEST = {1: 3.4028234663852886e38, 2: math.inf}
_MOST_CLASSES = 16
_OWN = 128


Term = tuple[str | float, ...]
"""The name of a term and its numbers: ("work", 2.22e-12)."""


class LinkError(Exception):
    """A frame that is not what it should be: damaged, or of no known message."""


class SchemaError(LinkError):
    """The instrument has another version, number type, reading or set of classes: do not read what it sends."""


@dataclass(frozen=True)
class Schema:
    """What the numbers in the messages mean: the number type (1: f32, 2: f64), the reading and the set of classes."""

    number: int
    reading: int
    classes: int

    def __str__(self) -> str:
        return f"number type {self.number}, reading {self.reading}, set of classes {self.classes}"


@dataclass(frozen=True)
class Reply:
    """A reply: its kind as in the documentation, the number of the request (zero of "started"), and its fields by name."""

    kind: str
    number: int
    fields: dict[str, object] = field(default_factory=dict)


def _integer(value: int) -> bytes:
    encoded = bytearray()
    while value >= 0x80:
        encoded.append(value & 0x7F | 0x80)
        value >>= 7
    return bytes(encoded + bytes([value]))


def _checked(number: int) -> int:
    if not 0 <= number < 1 << 32:
        raise ValueError(f"number of a request is {number}, but must be 0 to 4294967295")
    return number


def frame(message: bytes) -> bytes:
    """A message with its checksum, between two zero bytes."""
    if len(message) + 4 > LARGEST_MESSAGE:
        raise ValueError(f"message has {len(message)} bytes, but must have at most {LARGEST_MESSAGE - 4}")
    content = message + struct.pack("<I", zlib.crc32(message))
    # Blocks are shorter than 254 bytes, since the content is.
    return b"\0" + b"".join(bytes([len(block) + 1]) + block for block in content.split(b"\0")) + b"\0"


def request(kind: str, number: int) -> bytes:
    """The frame of a request without fields: "report", "describe", "counts" or "reset"."""
    if kind not in _REQUESTS:
        raise ValueError(f"request is {kind!r}, but must be one of {', '.join(_REQUESTS)}")
    return frame(bytes([_REQUESTS[kind]]) + _integer(_checked(number)))


def event(
    schema: Schema,
    number: int,
    values: Sequence[float],
    *,
    ticks: int = 0,
    radius: float = 0.0,
    material: int = 0,
) -> bytes:
    """The frame of an event. The values are those of the reading in its order, UNCERTAIN with the standard error after each."""
    kind = schema.reading & 15
    if schema.number not in _NUMBERS or not NORMAL <= kind <= UNCERTAIN or schema.reading >= 64:
        raise ValueError(f"{schema} is no schema of which events can be written")
    length = 8 if kind == UNCERTAIN else kind
    if len(values) != length:
        raise ValueError(f"reading {kind} has {length} values, but there are {len(values)}")
    if not 0 <= ticks < 1 << 32:
        raise ValueError(f"ticks are {ticks}, but must be 0 to 4294967295")
    if not 0 <= material < 256:
        raise ValueError(f"index of the material is {material}, but must be 0 to 255")
    form = _NUMBERS[schema.number]
    for value in (radius, *values):
        if not math.isfinite(value) or abs(value) > _LARGEST[schema.number]:
            raise ValueError(f"a value is {value}, but must be a finite number of the schema's type")
    stamp = _integer(ticks) if schema.reading & STAMPED else b""
    size = struct.pack(form, radius) + bytes([material]) if schema.reading & SIZED else b""
    reading = b"".join(struct.pack(form, value) for value in values)
    return frame(b"\0" + _integer(_checked(number)) + stamp + size + reading)


def rigid_body(restitution: Term, adhesion: Term = ("none",)) -> tuple[int | float, ...]:
    """A rigid body for `configure`: of RESTITUTIONS and REBOUND_ADHESIONS, each with its numbers as in the documentation."""
    law = _term("restitution", RESTITUTIONS, (1, 1, 2, 1, 2), restitution)
    return (0, *law, *_term("adhesion", REBOUND_ADHESIONS, (0, 1, 1, 2), adhesion))


def contact(
    stiffness: float, damping: Term = ("none",), adhesion: Term = ("none",), force: float = 0.0
) -> tuple[int | float, ...]:
    """A contact for `configure`: of DAMPINGS and ADHESIONS, each with its numbers as in the documentation."""
    choice, *numbers = _term("adhesion", ADHESIONS, (0, 0, 2, 1, 1, 1), adhesion)
    # Where contact ends is a choice of its own.
    law = (choice, *numbers) if choice < 4 else (4, *numbers, choice - 4)
    return (1, float(stiffness), *_term("damping", DAMPINGS, (0, 1, 1, 1), damping), *law, float(force))


def _term(what: str, names: Sequence[str], lengths: Sequence[int], term: Term) -> tuple[int | float, ...]:
    name, *numbers = term
    if name not in names:
        raise ValueError(f"{what} is {name!r}, but must be one of {', '.join(names)}")
    choice = names.index(name)
    if len(numbers) != lengths[choice]:
        raise ValueError(f"{what} {name!r} has {lengths[choice]} numbers, but there are {len(numbers)}")
    return (choice, *(float(value) for value in numbers))


def configure(
    schema: Schema,
    number: int,
    model: Sequence[int | float],
    *,
    radius: float,
    density: float,
    friction: float = 0.0,
    gyration_ratio: float = 0.4,
) -> bytes:
    """The frame of the request to classify by a scene: `rigid_body` or `contact`. The instrument checks its numbers."""
    if schema.number not in _NUMBERS:
        raise ValueError(f"number type is {schema.number}, but must be 1 (f32) or 2 (f64)")
    form = _NUMBERS[schema.number]
    values: tuple[int | float, ...] = (float(radius), float(density), float(gyration_ratio), float(friction), *model)
    scene = (struct.pack(form, value) if isinstance(value, float) else _integer(value) for value in values)
    return frame(b"\5" + _integer(_checked(number)) + b"".join(scene))


def unframe(content: bytes) -> bytes:
    """The message in what is between two zero bytes; LinkError if it is damaged."""
    message = bytearray()
    while content:
        if not 0 < content[0] <= len(content):
            raise LinkError("a frame is cut off, or not encoded by COBS")
        block, content = content[1 : content[0]], content[content[0] :]
        message += block
        if content and len(block) < 254:
            message.append(0)
    if len(message) > LARGEST_MESSAGE:
        raise LinkError(f"a frame has {len(message)} bytes, but must have at most {LARGEST_MESSAGE}")
    if len(message) < 4 or zlib.crc32(message[:-4]) != struct.unpack("<I", message[-4:])[0]:
        raise LinkError("the checksum of a frame is wrong")
    return bytes(message[:-4])


class _Message:
    """What is left to read of a message."""

    def __init__(self, message: bytes) -> None:
        self.rest = message

    def take(self, length: int) -> bytes:
        if length > len(self.rest):
            raise LinkError("a message ends too early")
        taken, self.rest = self.rest[:length], self.rest[length:]
        return taken

    def byte(self) -> int:
        return self.take(1)[0]

    def integer(self, bits: int = 32) -> int:
        value = shift = 0
        while True:
            byte = self.byte()
            value |= (byte & 0x7F) << shift
            shift += 7
            if value >> bits or (shift >= bits and byte & 0x80):
                raise LinkError(f"an integer of a message has more than {bits} bits")
            if not byte & 0x80:
                return value

    def number(self, form: str) -> float:
        value: float = struct.unpack(form, self.take(struct.calcsize(form)))[0]
        return value

    def choice(self, otherwise: str) -> dict[str, object]:
        choice = self.integer()
        if choice > 1:
            raise LinkError(f"a message has the choice {choice}, but must have 0 or 1")
        if choice == 1:
            return {"reason": otherwise}
        return {"parameter": self.integer(), "fault": self.integer(), "value": self.number("<f")}


def read(message: bytes, schema: Schema) -> Reply:
    """The reply in a message from an instrument of a schema. SchemaError if it is of another one, LinkError if it is none."""
    rest = _Message(message)
    kind_number = rest.integer()
    if kind_number >= len(_REPLIES):
        raise LinkError(f"a reply has the number {kind_number}, but must have 0 to {len(_REPLIES) - 1}")
    kind = _REPLIES[kind_number]
    number = 0 if kind == "started" else rest.integer()
    fields = _fields(kind, rest, schema)
    if rest.rest:
        raise LinkError(f"a reply {kind!r} has {len(rest.rest)} bytes too many")
    return Reply(kind, number, fields)


def _fields(kind: str, rest: _Message, schema: Schema) -> dict[str, object]:
    if kind in ("started", "description"):
        return {"protocol": PROTOCOL, "schema": _same_schema(rest, schema)}
    if kind == "classified":
        return _classified(rest, schema)
    if kind in ("rejected", "refused"):
        return rest.choice("the method did not converge" if kind == "rejected" else "the scene does not change")
    if kind == "report":
        return {name: rest.integer(64) for name in REPORT}
    if kind in ("counts", "reset"):
        length = rest.integer()
        if length > _MOST_CLASSES:
            raise LinkError(f"there are counts of {length} classes, but at most {_MOST_CLASSES} classes")
        return {"counts": [rest.integer(64) for _ in range(length)]}
    return {}


def _same_schema(rest: _Message, expected: Schema) -> Schema:
    protocol = rest.integer()
    if protocol != PROTOCOL:
        raise SchemaError(
            f"the instrument speaks version {protocol} of the protocol, but must speak version {PROTOCOL}"
        )
    found = Schema(rest.byte(), rest.byte(), rest.byte())
    if found != expected:
        raise SchemaError(f"the instrument has {found}, but must have {expected}")
    return found


def _classified(rest: _Message, schema: Schema) -> dict[str, object]:
    index, option = rest.integer(), rest.byte()
    names = CLASSES.get(schema.classes, range(_MOST_CLASSES) if schema.classes >= _OWN else ())
    if index >= len(names) or option > 1:
        raise LinkError(f"a class has the number {index}, but must have one below {len(names)}")
    return {"class": names[index], "restitution": rest.number(_NUMBERS[schema.number]) if option else None}


class Decoder:
    """Takes bytes as they come in, in pieces of any length, from an instrument of a schema."""

    def __init__(self, schema: Schema) -> None:
        if schema.number not in _NUMBERS:
            raise ValueError(f"number type is {schema.number}, but must be 1 (f32) or 2 (f64)")
        self._schema = schema
        self._content = bytearray()
        self._oversized = False
        self.faults: list[LinkError] = []
        """What was wrong with frames that were dropped; a line starts with noise."""

    def feed(self, data: Iterable[int]) -> list[Reply]:
        """The replies that end in these bytes. SchemaError if the instrument is another one; after it, use another decoder."""
        replies = []
        for byte in data:
            if byte:
                # Nothing longer is kept, so that a line without an end takes no memory.
                self._oversized |= len(self._content) > LARGEST_MESSAGE + 1
                if not self._oversized:
                    self._content.append(byte)
                continue
            content, oversized = bytes(self._content), self._oversized
            self._content.clear()
            self._oversized = False
            if not content:
                continue
            try:
                if oversized:
                    raise LinkError("a frame is longer than any message")
                replies.append(read(unframe(content), self._schema))
            except SchemaError:
                raise
            except LinkError as fault:
                self.faults.append(fault)
        return replies
