"""UR022: the links of a robot, each with its own name, are a tree with one root."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence

from scaffold.api import (
    Diagnostic,
    Example,
    Location,
    Package,
    Report,
    Rule,
    Severity,
    closest_name,
)
from scaffold.api.robot import Expansion, Part, is_known, may_be, robots, shown

_DRIVEN = frozenset(
    {"joint_name", "left_joint", "left_steering_joint", "right_joint", "right_steering_joint"}
)
"""Elements of plugins of Gazebo with the name of a joint."""
_ROBOT = (
    '<robot name="robot">\n  <link name="base_link"/>\n  <link name="wheel"/>\n'
    '  <link name="camera"/>\n'
    '  <joint name="axis" type="continuous">\n    <parent link="base_link"/>\n'
    '    <child link="wheel"/>\n  </joint>\n'
    '  <joint name="mount" type="fixed">\n    <parent link="{}"/>\n'
    '    <child link="{}"/>\n  </joint>\n</robot>\n'
)
_LOOP = (
    '<robot name="robot">\n  <link name="a"/>\n  <link name="b"/>\n'
    '  <joint name="ab" type="fixed">\n    <parent link="a"/>\n    <child link="b"/>\n  </joint>\n'
    '  <joint name="ba" type="fixed">\n    <parent link="b"/>\n    <child link="a"/>\n  </joint>\n'
    "</robot>\n"
)
_ROBOT_NAMES = (
    '<robot name="robot">\n  <link name="base_link"/>\n  <link name="wheel"/>\n'
    '  <link name="{}"/>\n'
    '  <joint name="axis" type="continuous">\n    <parent link="base_link"/>\n'
    '    <child link="wheel"/>\n  </joint>\n'
    '  <joint name="{}" type="continuous">\n    <parent link="base_link"/>\n'
    '    <child link="{}"/>\n  </joint>\n</robot>\n'
)
_MACRO = (
    '<robot name="robot" xmlns:xacro="http://www.ros.org/wiki/xacro">\n'
    '  <link name="base_link"/>\n'
    '  <xacro:macro name="wheel" params="name">\n    <link name="{}"/>\n'
    '    <joint name="${{name}}_joint" type="continuous">\n      <parent link="base_link"/>\n'
    '      <child link="{}"/>\n    </joint>\n  </xacro:macro>\n'
    '  <xacro:wheel name="left"/>\n  <xacro:wheel name="right"/>\n</robot>\n'
)
_ROBOT_LINKS = (
    '<robot name="robot">\n  <link name="base_link"/>\n  <link name="wheel"/>\n'
    '  <joint name="axis" type="continuous">\n    <parent link="{}"/>\n    <child link="{}"/>\n'
    "  </joint>\n</robot>\n"
)
_INCLUDING = (
    '<robot name="robot" xmlns:xacro="http://www.ros.org/wiki/xacro">\n'
    '  <xacro:include filename="simulation.xacro"/>\n  <link name="{}"/>\n</robot>\n'
)
_SIMULATION = '<robot>\n  <gazebo reference="camera"><sensor name="a"/></gazebo>\n</robot>\n'
_HINT = "; did you mean "
_SIMULATED = frozenset({"sensor", "plugin"})
"""Elements in gazebo elements that need the link, not only its color or friction."""
_MIMIC = (
    '<robot name="robot">\n  <link name="base_link"/>\n  <link name="wheel"/>\n'
    '  <joint name="axis" type="continuous">\n    <parent link="base_link"/>\n'
    '    <child link="wheel"/>\n    <mimic joint="{}"/>\n  </joint>\n</robot>\n'
)


class TreeBroken(Rule):
    """The links do not form a tree, have the same name, or do not exist.

    **Why.** ``Two root links found: [base_link] and [camera]``, ``link 'wheel' is not unique``,
    ``parent link [base] of joint [axis] not found``: the URDF parser rejects the whole file, and
    robot_state_publisher exits. Gazebo silently ignores the sensors, plugins and friction of
    missing links.

    **Fix.** Connect each link except the root to its parent with one joint. Use unique names, in a
    macro derived from a parameter: ``${name}_link``.

    **Source.** urdfdom, ``ModelInterface::initTree`` and ``initRoot``, ``model.cpp``.
    """

    code = "UR022"
    name = "tree-broken"
    other_severities = {Severity.WARNING: "Gazebo only ignores a color or the friction"}
    examples = (
        Example("valid tree", {"robot.urdf": _ROBOT.format("base_link", "camera")}),
        Example(
            "link with two parents, link without a parent",
            {"robot.urdf": _ROBOT.format("camera", "wheel")},
            "4:15: no joint connects 'camera': urdfdom finds two roots, it and 'base_link', and "
            "rejects the whole file",
            "9:4: link 'wheel' is the child of 'axis' and of 'mount': a link has one parent",
        ),
        Example(
            "joint with a child link that does not exist",
            {"robot.urdf": _ROBOT.format("wheel", "wheel2")},
            "11:18: child 'wheel2' of joint 'mount' is not a link of this robot: "
            "robot_state_publisher exits; did you mean 'wheel'?",
        ),
        Example(
            "loop of joints",
            {"robot.urdf": _LOOP},
            "8:4: joint 'ba' closes a loop: 'a' is above 'b' already, so no root leads to these "
            "links",
        ),
        Example(
            "macro with link names from a parameter",
            {"robot.xacro": _MACRO.format("${name}", "${name}")},
        ),
        Example(
            "duplicate link name",
            {"robot.urdf": _ROBOT_NAMES.format("wheel", "shoulder", "arm")},
            "4:15: a link 'wheel' is already defined in robot.urdf:3: urdfdom rejects the whole "
            "file",
            "11:18: child 'arm' of joint 'shoulder' is not a link of this robot: "
            "robot_state_publisher exits",
        ),
        Example(
            "duplicate joint name",
            {"robot.urdf": _ROBOT_NAMES.format("arm", "axis", "arm")},
            "9:16: a joint 'axis' is already defined in robot.urdf:5: urdfdom rejects the whole "
            "file",
        ),
        Example(
            "macro with a fixed link name, called twice",
            {"robot.xacro": _MACRO.format("wheel", "wheel")},
            "4:17: a link 'wheel' is already defined in an earlier call of the macro: urdfdom "
            "rejects the whole file",
            "5:6: link 'wheel' is the child of 'left_joint' and of 'right_joint': a link has one "
            "parent",
        ),
        Example(
            "existing parent and child", {"robot.urdf": _ROBOT_LINKS.format("base_link", "wheel")}
        ),
        Example(
            "gripper file whose parent link is in the file that includes it",
            {
                "gripper.xacro": '<robot name="gripper">\n  <link name="finger"/>\n'
                '  <joint name="grip" type="fixed">\n    <parent link="wrist"/>\n'
                '    <child link="finger"/>\n  </joint>\n</robot>\n'
            },
        ),
        Example(
            "misspelled parent link",
            {"robot.urdf": _ROBOT_LINKS.format("base", "wheel")},
            "5:19: parent 'base' of joint 'axis' is not a link of this robot: "
            "robot_state_publisher exits; did you mean 'base_link'?",
        ),
        Example(
            "unknown child link without a similar name",
            {"robot.urdf": _ROBOT_LINKS.format("base_link", "camera")},
            "6:18: child 'camera' of joint 'axis' is not a link of this robot: "
            "robot_state_publisher exits",
        ),
        Example(
            "Gazebo sensor on an unknown link",
            {
                "robot.urdf": _ROBOT_LINKS.format("base_link", "wheel").replace(
                    "</robot>", '  <gazebo reference="lidar"><sensor name="a"/></gazebo>\n</robot>'
                )
            },
            "8:22: gazebo reference 'lidar' is not a link or joint of this robot: Gazebo ignores "
            "it",
        ),
        Example(
            "Gazebo sensor on a link defined in a <gazebo> element",
            {
                "robot.urdf": _ROBOT_LINKS.format("base_link", "wheel").replace(
                    "</robot>",
                    '  <gazebo><link name="lidar"/></gazebo>\n'
                    '  <gazebo reference="lidar"><sensor name="a"/></gazebo>\n</robot>',
                )
            },
        ),
        Example(
            "shared file that references a link missing in both robots",
            {
                "simulation.xacro": _SIMULATION,
                "lite.xacro": _INCLUDING.format("camera_1"),
                "pro.xacro": _INCLUDING.format("camera_2"),
            },
            "simulation.xacro:2:22: gazebo reference 'camera' is not a link or joint of this "
            "robot: Gazebo ignores it; did you mean 'camera_1'?",
        ),
        Example(
            "<gazebo> elements with known and unknown references",
            {
                "robot.urdf": _ROBOT_LINKS.format("base_link", "wheel").replace(
                    "</robot>",
                    '  <gazebo reference="wheel"/>\n  <gazebo reference="axis"/>\n'
                    '  <gazebo reference="wheels"/>\n  <gazebo/>\n</robot>',
                )
            },
            Report(
                "10:22",
                "gazebo reference 'wheels' is not a link or joint of this robot: "
                "Gazebo ignores it; did you mean 'wheel'?",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "known and unknown joints of ros2_control",
            {
                "robot.urdf": _ROBOT_LINKS.format("base_link", "wheel").replace(
                    "</robot>",
                    '  <ros2_control name="arm" type="system">\n    <joint name="axis"/>\n'
                    '    <joint name="axel"/>\n    <sensor name="imu"/>\n  </ros2_control>\n'
                    "</robot>",
                )
            },
            "10:18: ros2_control joint 'axel' is not a joint of this robot",
        ),
        Example(
            "mimic of an unknown joint",
            {"robot.urdf": _MIMIC.format("axle")},
            "7:19: 'axis' mimics 'axle', which is not a joint of this robot",
        ),
        Example(
            "joints of a Gazebo plugin",
            {
                "drive.urdf": _ROBOT.format("base_link", "camera").replace(
                    "</robot>",
                    '  <gazebo>\n    <plugin filename="gz-sim-diff-drive-system" '
                    'name="gz::sim::systems::DiffDrive">\n'
                    "      <left_joint>axis</left_joint>\n"
                    "      <right_joint>axle</right_joint>\n"
                    "      <topic>cmd_vel</topic>\n"
                    "    </plugin>\n  </gazebo>\n</robot>",
                )
            },
            "16:8: right_joint 'axle' is not a joint of this robot: the plugin fails",
        ),
        Example(
            "links with a prefix that is an argument",
            {
                "robot.urdf.xacro": '<robot name="a" xmlns:xacro="http://www.ros.org/wiki/xacro">\n'
                '<xacro:arg name="prefix" default=""/>\n'
                '<xacro:property name="prefix" value="$(arg prefix)"/>\n'
                '<link name="${prefix}base"/>\n<link name="${prefix}wheel"/>\n'
                '<joint name="${prefix}a" type="fixed">\n'
                '  <parent link="${prefix}base"/>\n  <child link="${prefix}wheel"/>\n</joint>\n'
                '<link name="${prefix}mast"/>\n<joint name="${prefix}b" type="fixed">\n'
                '  <parent link="${prefix}chassis"/>\n  <child link="${prefix}mast"/>\n</joint>\n'
                "</robot>\n"
            },
            "12:17: parent '$(arg prefix)chassis' of joint '$(arg prefix)b' is not a link of this "
            "robot: robot_state_publisher exits",
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        reported: set[tuple[Location, str]] = set()
        for robot in robots(package).whole:
            if robot.file.is_robot and robot.is_complete:
                yield from self._check_tree(package, robot)
            if robot.file.is_robot and not robot.problems.undefined:
                yield from self._check_names(package, robot)
            if robot.file.is_robot and robot.is_complete and _has_root(robot):
                for diagnostic in self._check_links(package, robot):
                    # several robots include the same file, with different similar names
                    key = (diagnostic.location, diagnostic.message.partition(_HINT)[0])
                    if key not in reported:
                        reported.add(key)
                        yield diagnostic

    def _check_tree(self, package: Package, robot: Expansion) -> Iterator[Diagnostic]:
        links = {part.get("name") or "": part for part in robot.root.all("link")}
        parents: dict[str, Part] = {}
        for joint in robot.root.all("joint"):
            child, parent = _end(joint, "child"), _end(joint, "parent")
            if child not in links or parent not in links or not is_known(child + parent):
                return  # `_check_links` reports it, or it is unknown
            other = parents.setdefault(child, joint)
            if other is joint or not (other.is_certain and joint.is_certain):
                continue
            if joint.file.package is package and other.get("name") != joint.get("name"):
                message = (
                    f"link {child!r} is the child of {other.get('name')!r} and of "
                    f"{joint.get('name')!r}: a link has one parent"
                )
                yield self.report(joint, message)
        if not all(map(is_known, links)):
            return
        roots = [part for name, part in links.items() if name not in parents and part.is_certain]
        for part in roots[1:]:
            if part.file.package is package:
                message = (
                    f"no joint connects {part.get('name')!r}: urdfdom finds two roots, it and "
                    f"{roots[0].get('name')!r}, and rejects the whole file"
                )
                yield self.report(part.at("name"), message)
        for joint in _loops(parents):
            if joint.file.package is package:
                message = (
                    f"joint {joint.get('name')!r} closes a loop: {_end(joint, 'child')!r} is above "
                    f"{_end(joint, 'parent')!r} already, so no root leads to these links"
                )
                yield self.report(joint, message)

    def _check_names(self, package: Package, robot: Expansion) -> Iterator[Diagnostic]:
        for tag in ("link", "joint"):
            first: dict[str, Part] = {}
            for part in robot.root.all(tag):
                name = part.get("name")
                if name is None or not part.is_certain:
                    continue
                other = first.setdefault(name, part)
                if other is part or part.file.package is not package:
                    continue
                where = f"{other.location.path}:{other.location.line}"
                if other.element is part.element:
                    where = "an earlier call of the macro"
                message = (
                    f"a {tag} {shown(name)!r} is already defined in {where}: urdfdom rejects "
                    "the whole file"
                )
                cause = f"defined again in {part.location.path}"
                yield self.report(part.at("name"), message, cause=cause)

    def _check_links(self, package: Package, robot: Expansion) -> Iterator[Diagnostic]:
        links = [part.get("name") or "" for part in robot.root.all("link")]
        joints = [part.get("name") or "" for part in robot.root.all("joint")]
        for joint in robot.root.all("joint"):
            name = joint.get("name") or ""
            for tag in ("parent", "child"):
                end = joint.one(tag)
                link = end.get("link") if end is not None else None
                if end is None or link is None or _is_among(link, links) or not links:
                    continue
                hint = _hint(package, link, links)
                message = (
                    f"{tag} {shown(link)!r} of joint {shown(name)!r} is not a link of this robot: "
                    f"robot_state_publisher exits{hint}"
                )
                if _is_here(package, end):
                    yield self.report(end.at("link"), message)
            yield from self._check_mimic(package, joint, joints)
        yield from self._check_controlled(package, robot, joints)
        yield from self._check_driven(package, robot, joints)
        extensions = [*robot.root.all("gazebo")]
        added = [
            part.get("name") or ""
            for extension in extensions
            for part in extension.children
            if part.tag in {"link", "joint"}
        ]
        for part in extensions:
            reference = part.get("reference")
            if reference and links and not _is_among(reference, [*links, *joints, *added]):
                hint = _hint(package, reference, links)
                message = (
                    f"gazebo reference {shown(reference)!r} is not a link or joint of this robot: "
                    f"Gazebo ignores it{hint}"
                )
                if _is_here(package, part):
                    adds = any(child.tag in _SIMULATED for child in part.children)
                    severity = None if adds else Severity.WARNING
                    yield self.report(part.at("reference"), message, severity=severity)

    def _check_controlled(
        self, package: Package, robot: Expansion, joints: Sequence[str]
    ) -> Iterator[Diagnostic]:
        """Check the joints of the <ros2_control> elements."""
        for system in robot.root.all("ros2_control"):
            for part in system.all("joint"):
                name = part.get("name")
                if name and joints and not _is_among(name, joints) and _is_here(package, part):
                    hint = _hint(package, name, joints)
                    message = (
                        f"ros2_control joint {shown(name)!r} is not a joint of this robot{hint}"
                    )
                    yield self.report(part.at("name"), message)

    def _check_driven(
        self, package: Package, robot: Expansion, joints: Sequence[str]
    ) -> Iterator[Diagnostic]:
        """Check the joints that plugins of Gazebo move or read."""
        plugins = [plugin for part in robot.root.all("gazebo") for plugin in part.all("plugin")]
        for part in [part for plugin in plugins for part in plugin.children]:
            name = (part.element.text or "").strip()
            is_plain = part.tag in _DRIVEN and re.fullmatch(r"\w+", name)
            if is_plain and joints and not _is_among(name, joints) and _is_here(package, part):
                hint = _hint(package, name, joints)
                message = (
                    f"{part.tag} {name!r} is not a joint of this robot: the plugin fails{hint}"
                )
                yield self.report(part, message)

    def _check_mimic(
        self, package: Package, joint: Part, joints: Sequence[str]
    ) -> Iterator[Diagnostic]:
        mimic = joint.one("mimic")
        other = mimic.get("joint") if mimic is not None else None
        if mimic is not None and other and not _is_among(other, joints):
            name, hint = shown(joint.get("name") or ""), _hint(package, other, joints)
            problem = f"{shown(other)!r}, which is not a joint of this robot{hint}"
            message = f"{name!r} mimics {problem}"
            if _is_here(package, mimic):
                yield self.report(mimic.at("joint"), message)


def _loops(parents: Mapping[str, Part]) -> Iterator[Part]:
    """Yield a joint of each loop, the last one of the file."""
    done: set[str] = set()
    for start in parents:
        seen: list[str] = []
        link = start
        while link in parents and link not in done and link not in seen:
            seen.append(link)
            link = _end(parents[link], "parent")
        if link in seen:
            joints = [parents[item] for item in seen[seen.index(link) :]]
            if all(joint.is_certain for joint in joints):
                yield max(joints, key=lambda joint: joint.element.start)
        done.update(seen)


def _end(joint: Part, tag: str) -> str:
    """Return the link at an end of a joint."""
    end = joint.one(tag)
    return (end.get("link") if end is not None else None) or ""


def _has_root(robot: Expansion) -> bool:
    """Return whether a link is not a child of a joint; included parts are attached by others."""
    links = {part.get("name") for part in robot.root.all("link")}
    children = [joint.one("child") for joint in robot.root.all("joint")]
    return not links or bool(links - {child.get("link") for child in children if child})


def _is_here(package: Package, part: Part) -> bool:
    return part.file.package is package


def _hint(package: Package, name: str, names: Sequence[str]) -> str:
    closest = closest_name(package, name, [item for item in names if is_known(item)], 0.6)
    return f"{_HINT}{closest!r}?" if closest else ""


def _is_among(name: str, names: Sequence[str]) -> bool:
    """Return whether a name may be one of some others, which may be partly unknown."""
    return any(may_be(name, item) for item in names)
