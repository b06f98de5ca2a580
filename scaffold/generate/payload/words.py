"""Values implied by the names of fields: quantities and their units, texts, flags."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping

from scaffold import lazy_re
from scaffold.generate.payload.code import COUNT, WAVE
from scaffold.record import NamedTuple


class Quantity(NamedTuple):
    """A physical quantity that oscillates around a value."""

    base: float
    swing: float
    unit: str
    """The unit, for a comment."""

    @property
    def expression(self) -> str:
        """Its value in code."""
        wave = WAVE if self.swing == 1.0 else f"{self.swing!r} * {WAVE}"
        return wave if not self.base else f"{self.base!r} + {wave}"

    def check(self, value: str) -> str:
        """Return an assertion about its range; wide enough for a 32-bit float."""
        low, high = (round(self.base + sign * self.swing, 6) for sign in (-1.1, 1.1))
        return f"{low} <= {value} <= {high}"


RATIO = Quantity(0.5, 0.5, "0.0 to 1.0")
NUMBER = Quantity(0.0, 1.0, "")
_METRES = Quantity(1.0, 0.5, "meters")
_RADIANS = Quantity(0.0, 1.0, "radians")
_SPEED = Quantity(0.5, 0.5, "meters per second")
_TURN = Quantity(0.0, 0.5, "radians per second")
_SECONDS = Quantity(1.0, 0.1, "seconds")
_HERTZ = Quantity(10.0, 0.5, "hertz")
_NEWTONS = Quantity(5.0, 1.0, "newtons")
_TORQUE = Quantity(0.5, 0.1, "newton meters")

_QUANTITIES: Mapping[str, Quantity] = {
    "angular velocity": _TURN,
    "angular speed": _TURN,
    "angular acceleration": Quantity(0.0, 0.5, "radians per second squared"),
    "turn rate": _TURN,
    "yaw rate": _TURN,
    **{f"{word} rate": _HERTZ for word in ("update", "frame", "publish", "sample", "refresh")},
    "speed limit": Quantity(1.0, 0.5, "meters per second"),
    "magnetic field": Quantity(2e-05, 1e-06, "tesla"),
    "battery level": RATIO,
    "wind speed": Quantity(5.0, 1.0, "meters per second"),
    "state of charge": RATIO,
    "soc": RATIO,
    **dict.fromkeys(
        ("acceleration", "deceleration", "accel", "acc"),
        Quantity(0.0, 0.5, "meters per second squared"),
    ),
    **dict.fromkeys(("velocity", "speed", "vel"), _SPEED),
    **dict.fromkeys(("angle", "yaw", "pitch", "roll", "heading", "theta", "bearing"), _RADIANS),
    **dict.fromkeys(("orientation", "azimuth", "elevation", "steering"), _RADIANS),
    **dict.fromkeys(
        ("distance", "dist", "diameter", "length", "width", "height", "depth", "radius"), _METRES
    ),
    **dict.fromkeys(("range", "tolerance", "clearance", "thickness", "wheelbase"), _METRES),
    **dict.fromkeys(("position", "offset", "displacement", "resolution", "x", "y", "z"), _METRES),
    "altitude": Quantity(500.0, 10.0, "meters"),
    "latitude": Quantity(48.1, 0.001, "degrees"),
    "longitude": Quantity(11.6, 0.001, "degrees"),
    "temperature": Quantity(20.0, 2.0, "degrees Celsius"),
    "humidity": RATIO,
    "pressure": Quantity(101325.0, 100.0, "pascals"),
    "illuminance": Quantity(300.0, 50.0, "lux"),
    "voltage": Quantity(12.0, 0.5, "volts"),
    "current": Quantity(1.5, 0.5, "amperes"),
    "charge": Quantity(2.0, 0.5, "ampere hours"),
    "capacity": Quantity(5.0, 0.5, "ampere hours"),
    "power": Quantity(20.0, 5.0, "watts"),
    "energy": Quantity(100.0, 10.0, "joules"),
    **dict.fromkeys(("force", "thrust"), _NEWTONS),
    **dict.fromkeys(("torque", "effort", "moment"), _TORQUE),
    **dict.fromkeys(("mass", "payload"), Quantity(2.0, 0.5, "kilograms")),
    **dict.fromkeys(("frequency", "hz"), _HERTZ),
    **dict.fromkeys(("duration", "time", "timeout", "period", "interval", "delay"), _SECONDS),
    **dict.fromkeys(("seconds", "latency", "age", "eta"), _SECONDS),
    **dict.fromkeys(("percentage", "ratio", "fraction", "progress", "confidence"), RATIO),
    **dict.fromkeys(("probability", "score", "intensity", "opacity", "alpha", "quality"), RATIO),
    **dict.fromkeys(("r", "g", "b", "a"), RATIO),
    "percent": Quantity(50.0, 50.0, "percent"),
    "rpm": Quantity(1000.0, 100.0, "revolutions per minute"),
    "degrees": Quantity(0.0, 45.0, "degrees"),
    "deg": Quantity(0.0, 45.0, "degrees"),
    "variance": Quantity(0.01, 0.001, ""),
}
_SUFFIXES = {
    "m": "meters", "mm": "millimeters", "cm": "centimeters", "km": "kilometers",
    "s": "seconds", "sec": "seconds", "ms": "milliseconds", "us": "microseconds",
    "rad": "radians", "v": "volts", "mv": "millivolts", "ma": "milliamperes",
    "w": "watts", "c": "degrees Celsius", "kg": "kilograms", "n": "newtons", "nm": "newton meters",
    "mps": "meters per second", "kmh": "kilometers per hour",
    "pa": "pascals", "hpa": "hectopascals",
}  # fmt: skip
"""Units at the end of a name, as in ``range_mm``."""


def split(name: str) -> list[str]:
    """Return the words of a field's name."""
    return [word for word in name.split("_") if word]


def phrase(name: str) -> str:
    """Return a field's name as words."""
    return " ".join(split(name))


def quantity(name: str) -> Quantity:
    """Return the quantity implied by the name of a number."""
    if name == "rate":
        return _HERTZ
    best = next((_QUANTITIES[key] for key in _keys(name) if key in _QUANTITIES), NUMBER)
    unit = _SUFFIXES.get(split(name)[-1]) if "_" in name else None
    return best._replace(unit=unit) if unit else best


def _keys(name: str) -> Iterator[str]:
    """Yield subsequences of the words of a name: longer ones first, then later ones."""
    words = split(name)
    for length in (3, 2, 1):
        for start in range(len(words) - length, -1, -1):
            yield " ".join(words[start : start + length])


# -- texts

_TEXTS: Mapping[str, str] = {
    "name": "example",
    "id": "example",
    "label": "example",
    "key": "example",
    "title": "Example",
    "author": "Ada Lovelace",
    "frame": "base_link",
    "joint": "joint_1",
    "link": "base_link",
    "topic": "/example",
    "namespace": "example",
    "ns": "example",
    "node": "/example",
    "map": "map",
    "location": "kitchen",
    "room": "kitchen",
    "place": "kitchen",
    "color": "red",
    "colour": "red",
    "unit": "meters",
    "units": "meters",
    "version": "1.0.0",
    "model": "example",
    "serial": "0001",
    "number": "0001",
    "encoding": "utf-8",
    "format": "text",
    "path": "example.txt",
    "file": "example.txt",
    "filename": "example.txt",
    "url": "https://example.com",
    "uri": "https://example.com",
    "resource": "package://example/example.dae",
    "status": "ok",
    "state": "running",
    "mode": "automatic",
    "type": "example",
    "kind": "example",
    "class": "example",
    "category": "example",
    "error": "",
    "warning": "",
    "command": "start",
    "action": "start",
    "source": "example",
    "language": "en",
    "json": "{}",
}
_COUNTING = frozenset({"data", "text", "message", "msg", "description", "content", "comment"})


def text(name: str) -> str | None:
    """Return the text implied by the name of a field; ``None``: use a counting text."""
    words = split(name)
    if words[-1] in _COUNTING:
        return None
    return next((_TEXTS[word] for word in reversed(words) if word in _TEXTS), None)


def counting_text(name: str, bound: int | None) -> str:
    """Return an expression for a changing text, within its bound."""
    words = f"{phrase(name)} "
    if bound is None:
        return f"f'{words}{{{COUNT}}}'"
    digits = min(3, bound)
    if len(words) + digits > bound:
        words = ""
    return f"f'{words}{{{COUNT} % {10**digits}}}'" if words else f"str({COUNT} % {10**digits})"


# -- whole numbers

_FEW: Mapping[str, int] = {
    "id": 1,
    "index": 0,
    "priority": 1,
    "level": 1,
    "version": 1,
    "width": 640,
    "height": 480,
    "size": 3,
    "port": 8080,
    "channel": 1,
}


def whole(name: str) -> int | None:
    """Return the constant implied by the name of an integer; ``None``: use a count."""
    return next((_FEW[word] for word in reversed(split(name)) if word in _FEW), None)


TIMESTAMP = "self.get_clock().now().nanoseconds"
_PER_UNIT = {"us|microsec[a-z]*": "1000", "ms|millisec[a-z]*": "1_000_000"}


def per_unit(name: str, comment: str) -> str:
    """Return the nanoseconds per unit, from the name or the comment of a timestamp."""
    words = f"{name} {comment.lower()}".replace("_", " ")
    for unit, nanoseconds in _PER_UNIT.items():
        if re.search(rf"\b({unit})\b", words):
            return f" // {nanoseconds}"
    return ""


# -- flags

_TRUE = lazy_re.compile(
    "(is|has|can|was|use|enable)_|.*(success|successful|succeeded|valid|enabled|available|passed|present"
    "|ok|ready|connected|online|accepted|done|finished|healthy)$"
)


def is_true(name: str) -> bool:
    """Return whether a flag with this name is usually true."""
    return _TRUE.match(name) is not None
