"""UR014: angles, limits, masses and axes are physically possible."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Effect, Example, Package, Rule, Severity
from scaffold.api.robot import Part, is_known, urdf_parts

_ROBOT = (
    '<robot name="robot">\n  <link name="arm">\n    <inertial>\n      <mass value="{}"/>\n'
    '      <inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/>\n    </inertial>\n  </link>\n'
    '  <link name="base_link"/>\n  <joint name="axis" type="revolute">\n'
    '    <parent link="base_link"/>\n    <child link="arm"/>\n    <axis xyz="{}"/>\n'
    '    <limit lower="{}" upper="{}" effort="1" velocity="1"/>\n  </joint>\n</robot>\n'
)
_MOVING = frozenset({"revolute", "continuous", "prismatic"})
_ROBOT_ANGLES = (
    '<robot name="robot">\n  <link name="base_link"/>\n  <link name="wheel"/>\n'
    '  <joint name="axis" type="{}">\n    <parent link="base_link"/>\n    <child link="wheel"/>\n'
    '    <origin xyz="0 0 0" rpy="{} 0 0"/>\n    <limit lower="{}" upper="{}" effort="1" '
    'velocity="1"/>\n  </joint>\n</robot>\n'
)
_SMALLEST = 15
"""Degrees; integers from here on are implausible as radians."""
_LARGEST = 3600
"""Degrees; larger numbers, such as 100000, mean no limit."""
_STEP = 5
_RADIAN = 3.14159265 / 180


class ValueImpossible(Rule):
    """An angle is in degrees, or an axis, limit, mass or color is impossible.

    **Why.** URDF uses radians: an angle of 90 rotates the part by 116.6 degrees, and limits in
    degrees do not limit the joint at all. With swapped limits or an axis of length zero, the joint
    cannot move. Gazebo ignores a link without mass.

    **Fix.** Write ``1.5708``, or ``${radians(90)}`` or ``${pi/2}`` in xacro. ``lower`` is the
    smaller limit, and an axis is a direction such as ``0 0 1``.

    **Source.** URDF, "joint": rpy, lower and upper are in radians; "inertial".
    """

    code = "UR014"
    name = "value-impossible"
    severity = Severity.WARNING
    effect = Effect.WRONG_BEHAVIOR
    examples = (
        Example("valid values", {"robot.urdf": _ROBOT.format("2", "0 0 1", "-1", "1")}),
        Example(
            "link without mass at a fixed joint, which Gazebo merges into its parent",
            {
                "robot.urdf": _ROBOT.format("0", "0 0 0", "0", "0").replace(
                    'type="revolute"', 'type="fixed"'
                )
            },
        ),
        Example(
            "mass of 0, color components up to 255",
            {
                "robot.urdf": _ROBOT.format("0.0", "0 0 1", "-1", "1").replace(
                    "</robot>",
                    '  <material name="a"><color rgba="255 128 0 1"/></material>\n'
                    '  <material name="b"><color rgba="1 0.5 0 1.0"/></material>\n</robot>',
                )
            },
            "4:20: a mass of 0: Gazebo ignores the link and its joint",
            "15:35: colors and alpha are from 0 to 1, larger values count as 1; divide by 255",
        ),
        Example(
            "moments of inertia of 0",
            {
                "robot.urdf": _ROBOT.format("2", "0 0 1", "-1", "1")
                .replace('ixx="1"', 'ixx="0"')
                .replace('iyy="1"', 'iyy="0.0"')
                .replace('izz="1"', 'izz="0"')
            },
            "5:21: all moments of inertia are 0: in Gazebo, the link has no rotational inertia",
        ),
        Example(
            "negative mass, axis of length zero, swapped limits",
            {"robot.urdf": _ROBOT.format("-2", "0 0 0", "1", "-1")},
            "4:20: a mass must not be negative: Gazebo rejects the link",
            "12:16: the axis has no direction: the joint cannot move; write 0 0 1",
            "13:19: lower is 1 and upper is -1: no position is within these limits; swap them",
        ),
        Example(
            "angles in radians, winch with several turns, height of a lift",
            {
                "a.urdf": _ROBOT_ANGLES.format("revolute", "1.5708", "-3.14", "6.2832"),
                "b.urdf": _ROBOT_ANGLES.format("revolute", "0", "-31.4", "31.4"),
                "c.urdf": _ROBOT_ANGLES.format("prismatic", "0", "0", "90"),
                "d.xacro": '<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">\n'
                "  <xacro:property name=\"yaw\" value=\"${xacro.load_yaml('a.yaml')['yaw']}\"/>\n"
                '  <link name="a"/>\n  <link name="b"/>\n  <joint name="c" type="fixed">\n'
                '    <parent link="a"/>\n    <child link="b"/>\n'
                '    <origin rpy="0 0 ${pi - yaw * pi / 180 }"/>\n  </joint>\n</robot>\n',
            },
        ),
        Example(
            "very large limits",
            {"robot.urdf": _ROBOT_ANGLES.format("revolute", "0", "-100000", "1e16")},
        ),
        Example(
            "angles in degrees",
            {"robot.urdf": _ROBOT_ANGLES.format("revolute", "90", "-45", "180")},
            "7:30: rpy is in radians, but 90 looks like degrees; write 1.5708",
            "8:19: lower is in radians, but -45 looks like degrees; write -0.7854",
            "8:31: upper is in radians, but 180 looks like degrees; write 3.1416",
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        yield from self._check_values(package)
        yield from self._check_angles(package)

    def _check_values(self, package: Package) -> Iterator[Diagnostic]:
        for part in urdf_parts(package):
            joint = part.holder
            moves = joint is not None and joint.get("type") in _MOVING
            if part.tag == "mass" and any(value < 0 for value in _numbers(part, "value")):
                message = "a mass must not be negative: Gazebo rejects the link"
                yield self.report(part.at("value"), message)
            elif part.tag == "mass" and _numbers(part, "value") == [0] and _is_moved(part):
                message = "a mass of 0: Gazebo ignores the link and its joint"
                yield self.report(part.at("value"), message)
            elif part.tag == "color" and any(value > 1 for value in _numbers(part, "rgba")):
                message = (
                    "colors and alpha are from 0 to 1, larger values count as 1; divide by 255"
                )
                yield self.report(part.at("rgba"), message)
            elif part.tag == "axis" and moves and _numbers(part, "xyz") == [0, 0, 0]:
                message = "the axis has no direction: the joint cannot move; write 0 0 1"
                yield self.report(part.at("xyz"), message)
            elif part.tag == "limit" and moves:
                lower, upper = _numbers(part, "lower"), _numbers(part, "upper")
                if lower and upper and lower > upper:
                    message = (
                        f"lower is {lower[0]:g} and upper is {upper[0]:g}: no position is within "
                        f"these limits; swap them"
                    )
                    yield self.report(part.at("lower"), message)
            elif part.tag == "inertia" and _has_no_moment(part) and _is_moved(part):
                message = (
                    "all moments of inertia are 0: in Gazebo, the link has no rotational inertia"
                )
                yield self.report(part.at("ixx"), message)

    def _check_angles(self, package: Package) -> Iterator[Diagnostic]:
        for part in urdf_parts(package):
            for name, value in _angles(part):
                number = _degrees(value)
                if number is not None:
                    message = (
                        f"{name} is in radians, but {number:g} looks like degrees; write "
                        f"{number * _RADIAN:.4f}"
                    )
                    yield self.report(part.at(name), message)


def _has_no_moment(inertia: Part) -> bool:
    return all(_numbers(inertia, name) == [0] for name in ("ixx", "iyy", "izz"))


def _is_moved(mass: Part) -> bool:
    """Return whether the link of a mass is moved by a joint."""
    link = mass.holder.holder if mass.holder is not None else None
    robot = link.holder if link is not None else None
    if link is None or robot is None:
        return False
    return any(
        joint.get("type") in _MOVING and child.get("link") == link.get("name")
        for joint in robot.all("joint")
        for child in joint.all("child")
    )


def _numbers(part: Part, name: str) -> list[float]:
    """Return the numbers in an attribute; empty if it contains anything else."""
    text = part.attributes.get(name, "")
    try:
        return [float(word) for word in text.split()] if is_known(text) else []
    except ValueError:
        return []


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
    """Return a number that must be in degrees."""
    try:
        number = float(text) if is_known(text) else 0.0
    except ValueError:
        return None
    is_whole = _SMALLEST <= abs(number) <= _LARGEST and number % _STEP == 0
    return number if is_whole else None
