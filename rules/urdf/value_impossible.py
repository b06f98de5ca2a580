"""UR014: limits, masses and axes are such as a joint and a body can have."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Report, Rule, Severity
from scaffold.api.robot import Part, is_known, urdf_parts

_ROBOT = (
    '<robot name="robot">\n  <link name="arm">\n    <inertial>\n      <mass value="{}"/>\n'
    '      <inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/>\n    </inertial>\n  </link>\n'
    '  <link name="base_link"/>\n  <joint name="axis" type="revolute">\n'
    '    <parent link="base_link"/>\n    <child link="arm"/>\n    <axis xyz="{}"/>\n'
    '    <limit lower="{}" upper="{}" effort="1" velocity="1"/>\n  </joint>\n</robot>\n'
)
_MOVING = frozenset({"revolute", "continuous", "prismatic"})


class ValueImpossible(Rule):
    """A joint has an axis of length zero or limits the wrong way round; a mass or a color is none.

    **Why.** The file is read, and then nothing can move the joint: planners find every position
    out of its limits, and Gazebo leaves the link out.

    **Fix.** The smaller limit is ``lower``; an axis is a direction such as ``0 0 1``.

    **Source.** URDF, "joint" and "inertial".
    """

    code = "UR014"
    name = "value-impossible"
    severity = Severity.WARNING
    examples = (
        Example("possible", {"robot.urdf": _ROBOT.format("2", "0 0 1", "-1", "1")}),
        Example(
            "no mass of what is fixed to another link, which Gazebo makes one body with it",
            {
                "robot.urdf": _ROBOT.format("0", "0 0 0", "0", "0").replace(
                    'type="revolute"', 'type="fixed"'
                )
            },
        ),
        Example(
            "no mass, colors up to 255",
            {
                "robot.urdf": _ROBOT.format("0.0", "0 0 1", "-1", "1").replace(
                    "</robot>",
                    '  <material name="a"><color rgba="255 128 0 1"/></material>\n'
                    '  <material name="b"><color rgba="1 0.5 0 1.0"/></material>\n</robot>',
                )
            },
            Report("4:20", "a mass of 0: Gazebo leaves the link out, and its joint"),
            Report("15:35", "colors are from 0 to 1, alpha as well: all above is 1; divide by 255"),
        ),
        Example(
            "no moments of inertia",
            {
                "robot.urdf": _ROBOT.format("2", "0 0 1", "-1", "1")
                .replace('ixx="1"', 'ixx="0"')
                .replace('iyy="1"', 'iyy="0.0"')
                .replace('izz="1"', 'izz="0"')
            },
            Report("5:21", "all moments of inertia are 0: Gazebo refuses the link"),
        ),
        Example(
            "impossible",
            {"robot.urdf": _ROBOT.format("-2", "0 0 0", "1", "-1")},
            Report("4:20", "a mass is not negative: Gazebo refuses the link"),
            Report("12:16", "the axis has no direction: the joint cannot move; write 0 0 1"),
            Report(
                "13:19",
                "lower is 1 and upper is -1: no position is within these limits; exchange them",
            ),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for part in urdf_parts(package):
            joint = part.holder
            moves = joint is not None and joint.get("type") in _MOVING
            if part.tag == "mass" and any(value < 0 for value in _numbers(part, "value")):
                message = "a mass is not negative: Gazebo refuses the link"
                yield self.report(part.at("value"), message)
            elif part.tag == "mass" and _numbers(part, "value") == [0] and _is_moved(part):
                message = "a mass of 0: Gazebo leaves the link out, and its joint"
                yield self.report(part.at("value"), message)
            elif part.tag == "color" and any(value > 1 for value in _numbers(part, "rgba")):
                message = "colors are from 0 to 1, alpha as well: all above is 1; divide by 255"
                yield self.report(part.at("rgba"), message)
            elif part.tag == "axis" and moves and _numbers(part, "xyz") == [0, 0, 0]:
                message = "the axis has no direction: the joint cannot move; write 0 0 1"
                yield self.report(part.at("xyz"), message)
            elif part.tag == "limit" and moves:
                lower, upper = _numbers(part, "lower"), _numbers(part, "upper")
                if lower and upper and lower > upper:
                    message = (
                        f"lower is {lower[0]:g} and upper is {upper[0]:g}: no position is within "
                        "these limits; exchange them"
                    )
                    yield self.report(part.at("lower"), message)
            elif part.tag == "inertia" and _has_no_moment(part) and _is_moved(part):
                message = "all moments of inertia are 0: Gazebo refuses the link"
                yield self.report(part.at("ixx"), message)


def _has_no_moment(inertia: Part) -> bool:
    return all(_numbers(inertia, name) == [0] for name in ("ixx", "iyy", "izz"))


def _is_moved(mass: Part) -> bool:
    """Tell whether the link of a mass is moved by a joint."""
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
    """Return the numbers in an attribute; none if it holds something else."""
    text = part.attributes.get(name, "")
    try:
        return [float(word) for word in text.split()] if is_known(text) else []
    except ValueError:
        return []
