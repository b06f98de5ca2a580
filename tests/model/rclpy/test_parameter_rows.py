"""Parameters that are declared in loops, and their descriptors."""

from __future__ import annotations

import pytest

from scaffold.model.package import Package
from scaffold.model.rclpy.entities import Parameter
from scaffold.model.rclpy.file import rclpy_file

_NODE = (
    "from rcl_interfaces.msg import FloatingPointRange, IntegerRange, ParameterDescriptor\n"
    "from rclpy.node import Node\n\n\n"
    "class Talker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('talker')\n"
)


def declared(body: str) -> list[Parameter]:
    text = _NODE + "".join(f"        {line}\n" for line in body.splitlines())
    facts = rclpy_file(Package.of({"talker.py": text}), "talker.py")
    return list(facts.parameters)


@pytest.mark.parametrize(
    "loop",
    [
        "for name, default in [('rate', 1.0), ('mode', 'slow')]:",
        "for name, default in (('rate', 1.0), ('mode', 'slow')):",
        "for name, default in {'rate': 1.0, 'mode': 'slow'}.items():",
        "pairs = [('rate', 1.0), ('mode', 'slow')]\nfor name, default in pairs:",
    ],
)
def test_loop_over_a_literal(loop: str) -> None:
    result = declared(f"{loop}\n    self.declare_parameter(name, default)")
    assert [(item.name, item.type) for item in result] == [("rate", "double"), ("mode", "string")]


@pytest.mark.parametrize(
    "loop",
    [
        "for name, default in load():",
        "for name, default in [('rate', 1.0), *more]:",
        "for name, default in [('rate', 1.0), ('mode',)]:",
        "for name, default in {'rate': 1.0, **more}.items():",
    ],
)
def test_loop_over_an_unknown_value(loop: str) -> None:
    result = declared(f"{loop}\n    self.declare_parameter(name, default)")
    assert [isinstance(item.name, str) for item in result] == [False]


@pytest.mark.parametrize(
    ("body", "limits"),
    [
        ("limits = IntegerRange(from_value=1, to_value=9)", ["1 to 9"]),
        ("limits = IntegerRange()\nlimits.to_value = 9", ["0 to 9"]),
        ("limits = IntegerRange(to_value=9)\nif self:\n    limits.step = 2", None),
        ("limits = IntegerRange(to_value=9)\nself.widen(limits)", None),
        ("limits = load()", None),
    ],
)
def test_parameter_ranges(body: str, limits: list[str] | None) -> None:
    body += "\ndescriptor = ParameterDescriptor()\ndescriptor.integer_range.append(limits)"
    (entry,) = declared(f"{body}\nself.declare_parameter('count', 5, descriptor)")
    descriptor = entry.descriptor
    assert (descriptor and [item.text for item in descriptor.ranges]) == limits


@pytest.mark.parametrize(
    ("value", "allowed"),
    [("0.3", True), ("1.0", True), ("0.25", False), ("1.1", False), ("-1e-9", False)],
)
def test_steps_of_ranges_follow_rclpy(value: str, allowed: bool) -> None:
    (item,) = declared(
        "limits = FloatingPointRange(from_value=0.0, to_value=1.0, step=0.1)\n"
        "descriptor = ParameterDescriptor(floating_point_range=[limits])\n"
        f"self.declare_parameter('gain', {value}, descriptor)"
    )
    assert item.descriptor is not None
    assert item.descriptor.ranges[0].allows(float(value)) is allowed
