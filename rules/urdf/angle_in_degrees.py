"""UR012: angles are in radians."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Report, Rule, Severity
from scaffold.api.robot import Part, is_known, urdf_parts

_ROBOT = (
    '<robot name="robot">\n  <link name="base_link"/>\n  <link name="wheel"/>\n'
    '  <joint name="axis" type="{}">\n    <parent link="base_link"/>\n    <child link="wheel"/>\n'
    '    <origin xyz="0 0 0" rpy="{} 0 0"/>\n    <limit lower="{}" upper="{}" effort="1" '
    'velocity="1"/>\n  </joint>\n</robot>\n'
)
_SMALLEST = 15
"""Degrees; a whole number of radians from here on is no angle that anybody writes."""
_STEP = 5
_RADIAN = 3.14159265 / 180


class AngleInDegrees(Rule):
    """An angle in a robot description is a whole number of degrees.

    **Why.** URDF has radians: with 90 for a quarter turn the part is turned by 116.6 degrees, and
    a joint with such limits is not limited at all.

    **Fix.** ``1.5708``, or ``${radians(90)}`` and ``${pi/2}`` in xacro.

    **Source.** URDF, "joint": rpy, lower and upper are in radians.
    """

    code = "UR012"
    name = "angle-in-degrees"
    severity = Severity.WARNING
    examples = (
        Example(
            "radians; a winch; the height of a lift",
            {
                "a.urdf": _ROBOT.format("revolute", "1.5708", "-3.14", "6.2832"),
                "b.urdf": _ROBOT.format("revolute", "0", "-31.4", "31.4"),
                "c.urdf": _ROBOT.format("prismatic", "0", "0", "90"),
                "d.xacro": '<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">\n'
                "  <xacro:property name=\"yaw\" value=\"${xacro.load_yaml('a.yaml')['yaw']}\"/>\n"
                '  <link name="a"/>\n  <link name="b"/>\n  <joint name="c" type="fixed">\n'
                '    <parent link="a"/>\n    <child link="b"/>\n'
                '    <origin rpy="0 0 ${pi - yaw * pi / 180 }"/>\n  </joint>\n</robot>\n',
            },
        ),
        Example(
            "degrees",
            {"robot.urdf": _ROBOT.format("revolute", "90", "-45", "180")},
            Report("7:30", "rpy is in radians, 90 looks like degrees; write 1.5708"),
            Report("8:19", "lower is in radians, -45 looks like degrees; write -0.7854"),
            Report("8:31", "upper is in radians, 180 looks like degrees; write 3.1416"),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for part in urdf_parts(package):
            for name, value in _angles(part):
                number = _degrees(value)
                if number is not None:
                    message = (
                        f"{name} is in radians, {number:g} looks like degrees; "
                        f"write {number * _RADIAN:.4f}"
                    )
                    yield self.report(part.at(name), message)


def _angles(part: Part) -> Iterator[tuple[str, str]]:
    """Yield the angles of an element, each with the name of its attribute."""
    if part.tag == "origin" and is_known(part.attributes.get("rpy", "")):
        for word in part.attributes.get("rpy", "").split():
            yield "rpy", word
    joint = part.holder
    if part.tag == "limit" and joint is not None and joint.get("type") == "revolute":
        for name in ("lower", "upper"):
            if name in part.attributes:
                yield name, part.attributes[name]


def _degrees(text: str) -> float | None:
    """Return a number that must be one of degrees."""
    try:
        number = float(text) if is_known(text) else 0.0
    except ValueError:
        return None
    is_whole = abs(number) >= _SMALLEST and number % _STEP == 0
    return number if is_whole else None
