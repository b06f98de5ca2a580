"""UR020: the links and joints that a robot names are there."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from scaffold.api import Diagnostic, Example, Package, Report, Rule, closest_name
from scaffold.api.robot import UNKNOWN_MARK, Expansion, Part, is_known, robots

_ROBOT = (
    '<robot name="robot">\n  <link name="base_link"/>\n  <link name="wheel"/>\n'
    '  <joint name="axis" type="continuous">\n    <parent link="{}"/>\n    <child link="{}"/>\n'
    "  </joint>\n</robot>\n"
)
_MIMIC = (
    '<robot name="robot">\n  <link name="base_link"/>\n  <link name="wheel"/>\n'
    '  <joint name="axis" type="continuous">\n    <parent link="base_link"/>\n'
    '    <child link="wheel"/>\n    <mimic joint="{}"/>\n  </joint>\n</robot>\n'
)


class LinkUndefined(Rule):
    """A joint or a gazebo element names a link that the robot does not have.

    **Why.** ``Failed to build tree: parent link [base] of joint [axis] not found``:
    robot_state_publisher ends. Gazebo leaves out the sensors, plugins and friction of what is not
    there, without a word.

    **Fix.** Use the name of a link, or add the link.

    **Source.** urdfdom, ``ModelInterface::initTree``.
    """

    code = "UR020"
    name = "link-undefined"
    examples = (
        Example("both there", {"robot.urdf": _ROBOT.format("base_link", "wheel")}),
        Example(
            "a gripper, which hangs on the arm of a file that includes it",
            {
                "gripper.xacro": '<robot name="gripper">\n  <link name="finger"/>\n'
                '  <joint name="grip" type="fixed">\n    <parent link="wrist"/>\n'
                '    <child link="finger"/>\n  </joint>\n</robot>\n'
            },
        ),
        Example(
            "a name that is not there",
            {"robot.urdf": _ROBOT.format("base", "wheel")},
            Report(
                "5:19",
                "parent 'base' of joint 'axis' is not a link of this robot: "
                "robot_state_publisher ends; closest: 'base_link'",
            ),
        ),
        Example(
            "nothing like it",
            {"robot.urdf": _ROBOT.format("base_link", "camera")},
            Report(
                "6:18",
                "child 'camera' of joint 'axis' is not a link of this robot: "
                "robot_state_publisher ends",
            ),
        ),
        Example(
            "a gazebo element of an unknown link",
            {
                "robot.urdf": _ROBOT.format("base_link", "wheel").replace(
                    "</robot>",
                    '  <gazebo reference="wheel"/>\n  <gazebo reference="axis"/>\n'
                    '  <gazebo reference="wheels"/>\n  <gazebo/>\n</robot>',
                )
            },
            Report(
                "10:22",
                "gazebo is about 'wheels', which is no link or joint of this robot: "
                "Gazebo ignores it; closest: 'wheel'",
            ),
        ),
        Example(
            "a joint to mimic",
            {"robot.urdf": _MIMIC.format("axle")},
            Report("7:19", "'axis' mimics 'axle', which is not a joint of this robot"),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for robot in robots(package).whole:
            is_whole = robot.is_complete and _has_root(robot)
            if robot.file.is_robot and is_whole:
                yield from self._check(package, robot)

    def _check(self, package: Package, robot: Expansion) -> Iterator[Diagnostic]:
        links = [part.get("name") or "" for part in robot.root.all("link")]
        joints = [part.get("name") or "" for part in robot.root.all("joint")]
        for joint in robot.root.all("joint"):
            name = joint.get("name")
            for tag in ("parent", "child"):
                end = joint.one(tag)
                link = end.get("link") if end is not None else None
                if end is None or link is None or _is_among(link, links) or not links:
                    continue
                hint = _hint(package, link, links)
                message = (
                    f"{tag} {link!r} of joint {name!r} is not a link of this robot: "
                    f"robot_state_publisher ends{hint}"
                )
                if _is_here(package, end):
                    yield self.report(end.at("link"), message)
            yield from self._check_mimic(package, joint, joints)
        for part in robot.root.all("gazebo"):
            reference = part.get("reference")
            if reference and links and not _is_among(reference, [*links, *joints]):
                hint = _hint(package, reference, links)
                message = (
                    f"gazebo is about {reference!r}, which is no link or joint of this robot: "
                    f"Gazebo ignores it{hint}"
                )
                if _is_here(package, part):
                    yield self.report(part.at("reference"), message)

    def _check_mimic(
        self, package: Package, joint: Part, joints: Sequence[str]
    ) -> Iterator[Diagnostic]:
        mimic = joint.one("mimic")
        other = mimic.get("joint") if mimic is not None else None
        if mimic is not None and other and not _is_among(other, joints):
            name, hint = joint.get("name"), _hint(package, other, joints)
            message = f"{name!r} mimics {other!r}, which is not a joint of this robot{hint}"
            if _is_here(package, mimic):
                yield self.report(mimic.at("joint"), message)


def _has_root(robot: Expansion) -> bool:
    """Tell whether a link is no child of a joint; a part that others include hangs on theirs."""
    links = {part.get("name") for part in robot.root.all("link")}
    children = [joint.one("child") for joint in robot.root.all("joint")]
    return not links or bool(links - {child.get("link") for child in children if child})


def _is_here(package: Package, part: Part) -> bool:
    return part.file.package is package


def _hint(package: Package, name: str, names: Sequence[str]) -> str:
    closest = closest_name(package, name, [item for item in names if is_known(item)], 0.6)
    return f"; closest: {closest!r}" if closest else ""


def _is_among(name: str, names: Sequence[str]) -> bool:
    """Tell whether a name may be among others; parts of each may be unknown."""
    if name in names:
        return True
    if not is_known(name):
        return True
    patterns = (item for item in names if not is_known(item))
    return any(re.fullmatch(_pattern(item), name) for item in patterns)


def _pattern(name: str) -> str:
    parts = name.split(UNKNOWN_MARK)
    return ".*".join(re.escape(part) for part in parts[::2])
