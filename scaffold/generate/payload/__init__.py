"""What a generated node puts into a message: imports, statements, words.

A message is walked field by field, so any type can be filled once its fields are known; this
table holds those of std_msgs.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from difflib import get_close_matches
from typing import NamedTuple

from scaffold.errors import InputError
from scaffold.generate.payload.records import ActionPayload, Part, Payload, ServicePayload

__all__ = ["ActionPayload", "Part", "Payload", "ServicePayload", "payload"]


class Field(NamedTuple):
    """A field of a message definition."""

    name: str
    type: str
    """A primitive type or ``package/Name``."""


class Sample(NamedTuple):
    """A value that changes with ``self.count``, the number of messages published so far."""

    expression: str
    says: str
    """What it is, to be read after "the field holds"."""
    check: str
    """A Python expression that is true of a received ``{value}``."""
    imports: tuple[str, ...] = ()


def _integer(bits: int, *, signed: bool) -> Sample:
    """Return a counter that starts again before it would overflow."""
    values = 2 ** (bits - signed)
    expression = "self.count" if bits == _WIDEST else f"self.count % {_written(bits - signed)}"
    check = f"0 <= {{value}} < {_written(bits - signed)}"
    end = "" if bits == _WIDEST else f" from 0 to {values - 1}"
    return Sample(expression, f"a counter{end}", check)


_WIDEST = 64
"""Bits of an integer that no counter of messages fills."""


def _written(bits: int) -> str:
    return str(2**bits) if bits <= 16 else f"2**{bits}"  # noqa: PLR2004  readable up to 65536


_SINE = Sample(
    "math.sin(self.count / 10.0)",
    "a sine wave",
    "-1.0 <= {value} <= 1.0",
    ("import math",),
)

SAMPLES: Mapping[str, Sample] = {
    "string": Sample(
        "f'Hello World: {self.count}'",
        "a greeting with a counter",
        "{value}.startswith('Hello World: ')",
    ),
    "bool": Sample("self.count % 2 == 0", "true and false in turn", "isinstance({value}, bool)"),
    "byte": Sample(
        "bytes([self.count % 256])", "a counter from 0 to 255 in one byte", "len({value}) == 1"
    ),
    "char": _integer(8, signed=False),
    "float32": _SINE,
    "float64": _SINE,
    **{f"int{bits}": _integer(bits, signed=True) for bits in (8, 16, 32, 64)},
    **{f"uint{bits}": _integer(bits, signed=False) for bits in (8, 16, 32, 64)},
}

STD_MSGS: Mapping[str, Sequence[Field]] = {
    **{name: (Field("data", name.lower()),) for name in ("Bool", "Byte", "Char", "String")},
    **{f"Float{bits}": (Field("data", f"float{bits}"),) for bits in (32, 64)},
    **{f"Int{bits}": (Field("data", f"int{bits}"),) for bits in (8, 16, 32, 64)},
    **{f"UInt{bits}": (Field("data", f"uint{bits}"),) for bits in (8, 16, 32, 64)},
    "Header": (Field("stamp", "builtin_interfaces/Time"), Field("frame_id", "string")),
}
"""The fields of the std_msgs types that a node can publish."""

KNOWN_TYPES = tuple(sorted(f"std_msgs/msg/{name}" for name in STD_MSGS))


def payload(text: str) -> Payload:
    """Return how to fill messages of a type, written ``package/msg/Name`` or ``package/Name``.

    Raises:
        InputError: the type is not known.
    """
    match = re.fullmatch(r"(\w+)/(?:msg/)?(\w+)", text)
    fields = STD_MSGS.get(match[2]) if match and match[1] == "std_msgs" else None
    if match is None or fields is None:
        raise InputError(f"unknown message type {text!r}{_nearest(text)}")
    return _of(match[1], match[2], fields)


def _nearest(text: str) -> str:
    wanted = text.rpartition("/")[2].lower()
    by_name = {name.rpartition("/")[2].lower(): name for name in KNOWN_TYPES}
    near = [by_name[name] for name in get_close_matches(wanted, by_name, n=3, cutoff=0.5)]
    if near:
        return f"; did you mean {' or '.join(near)}?"
    return f"; the known ones are {', '.join(KNOWN_TYPES)}"


def _of(package: str, name: str, fields: Sequence[Field]) -> Payload:
    steps = list(_steps(f"{package}/{name}", fields, ""))
    imports = dict.fromkeys(line for step in steps for line in step.sample.imports)
    paths = [step.path for step in steps]
    return Payload(
        package=package,
        name=name,
        imports=(*imports, f"from {package}.msg import {name}"),
        statements=tuple(f"msg.{step.path} = {step.sample.expression}" for step in steps),
        log="{msg.data}" if paths == ["data"] else "{msg}",
        says=" and ".join(step.sample.says for step in steps),
        checks=tuple(
            step.sample.check.format(value=f"message.{step.path}")
            for step in steps
            if step.sample.check
        ),
        is_stamped=any("self.frame_id" in step.sample.expression for step in steps),
        is_counted=any("self.count" in step.sample.expression for step in steps),
        packages=(package,),
    )


class _Step(NamedTuple):
    """A field to fill: its path from the message, and its value."""

    path: str
    sample: Sample


def _steps(owner: str, fields: Sequence[Field], prefix: str) -> Iterator[_Step]:
    for field in fields:
        path = prefix + field.name
        if field.type == "builtin_interfaces/Time":
            now = "self.get_clock().now().to_msg()"
            yield _Step(path, Sample(now, "the time of publication", "{value}.sec > 0"))
        elif field.type == "std_msgs/Header":
            yield from _steps(field.type, STD_MSGS["Header"], f"{path}.")
        elif owner == "std_msgs/Header" and field.name == "frame_id":
            yield _Step(path, Sample("self.frame_id", "the name of a frame", "{value}"))
        else:
            yield _Step(path, SAMPLES[field.type])
