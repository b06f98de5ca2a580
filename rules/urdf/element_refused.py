"""UR010: elements of URDF and xacro have their required parts and valid values."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from scaffold.api import (
    Diagnostic,
    Example,
    Package,
    Report,
    Rule,
    Severity,
    ViewError,
    closest_name,
)
from scaffold.api.formats import Element
from scaffold.api.robot import Part, is_known, robot_file, robot_paths, robots, shown, urdf_parts

_ROBOT = (
    '<robot name="robot">\n  <link name="base_link">\n    <inertial>\n      <mass {}="2.0"/>\n'
    '      <inertia ixx="0.02" ixy="0" ixz="0" iyy="0.03" iyz="0" izz="0.04"/>\n'
    "    </inertial>\n  </link>\n</robot>\n"
)
_XACRO = (
    '<robot name="robot" xmlns:xacro="http://www.ros.org/wiki/xacro">\n'
    '  <xacro:arg name="sim"{}/>\n'
    '  <link name="base_link"/>\n</robot>\n'
)
_OF_URDF: Mapping[tuple[str, str], tuple[str, ...]] = {
    ("robot", "link"): ("name",),
    ("robot", "joint"): ("name", "type"),
    ("joint", "parent"): ("link",),
    ("joint", "child"): ("link",),
    ("joint", "mimic"): ("joint",),
    ("joint", "limit"): ("effort", "velocity"),
    ("joint", "safety_controller"): ("k_velocity",),
    ("inertial", "mass"): ("value",),
    ("inertial", "inertia"): ("ixx", "ixy", "ixz", "iyy", "iyz", "izz"),
    ("geometry", "box"): ("size",),
    ("geometry", "cylinder"): ("radius", "length"),
    ("geometry", "sphere"): ("radius",),
    ("geometry", "mesh"): ("filename",),
    ("visual", "material"): ("name",),
}
_REPEATED = frozenset({"link", "joint", "visual"})
"""Elements of which urdfdom reads more than the first one."""
_OF_LINK = frozenset({"inertial", "visual", "geometry"})
_OF_XACRO: Mapping[str, tuple[str, ...]] = {
    "xacro:include": ("filename",),
    "xacro:property": ("name",),
    "xacro:macro": ("name",),
    "xacro:arg": ("name", "default"),
    "xacro:if": ("value",),
    "xacro:unless": ("value",),
    "xacro:insert_block": ("name",),
    "xacro:attribute": ("name", "value"),
    "xacro:call": ("macro",),
}
_ROBOT_JOINTS = (
    '<robot name="robot">\n  <link name="base_link"/>\n  <link name="wheel"/>\n'
    '  <joint name="axis" type="{}">\n    <parent link="base_link"/>\n{}  </joint>\n</robot>\n'
)
_CHILD = '    <child link="wheel"/>\n'
_LIMIT = '    <limit lower="0" upper="1" effort="1" velocity="1"/>\n'
_ROBOT_VALUES = (
    '<robot name="robot">\n  <link name="base_link"/>\n  <link name="wheel">\n    <visual>\n'
    "      <geometry><{}/></geometry>\n    </visual>\n  </link>\n"
    '  <joint name="axis" type="{}">\n    <parent link="base_link"/>\n    <child link="wheel"/>\n'
    '    <origin xyz="{}"/>\n  </joint>\n</robot>\n'
)
_TYPES = ("revolute", "continuous", "prismatic", "fixed", "floating", "planar")
_SHAPES = ("box", "cylinder", "sphere", "mesh", "capsule")
_COUNTS: Mapping[tuple[str, str], int] = {
    ("origin", "xyz"): 3,
    ("origin", "rpy"): 3,
    ("axis", "xyz"): 3,
    ("box", "size"): 3,
    ("mesh", "scale"): 3,
    ("color", "rgba"): 4,
    ("cylinder", "radius"): 1,
    ("cylinder", "length"): 1,
    ("sphere", "radius"): 1,
    ("mass", "value"): 1,
    ("limit", "lower"): 1,
    ("limit", "upper"): 1,
    ("limit", "effort"): 1,
    ("limit", "velocity"): 1,
    **{("inertia", name): 1 for name in ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")},
}
"""The number of values in an attribute."""
_READ = frozenset(
    {"robot", "link", "joint", "material", "inertial", "visual", "collision", "geometry"}
)
"""Elements whose children urdfdom reads; it skips all others."""


class ElementRefused(Rule):
    """An element of URDF or xacro lacks an attribute or a child, or has an invalid value.

    **Why.** The URDF parser rejects the whole file, and xacro stops: robot_state_publisher exits
    with ``Failed to parse robot description``, for a joint with ``Joint [axis] is of type REVOLUTE
    but it does not specify limits`` or ``has no known type [continous]``.

    **Fix.** Add the attribute or the element, such as a default for ``<xacro:arg>``. A wheel is a
    ``continuous`` joint, which needs no limits. Joint types are ``revolute``, ``continuous``,
    ``prismatic``, ``fixed``, ``floating`` and ``planar``; numbers are separated by spaces.

    **Source.** urdfdom, ``joint.cpp``, ``link.cpp`` and ``pose.cpp``; xacro, ``reqd_attrs``.
    """

    code = "UR010"
    name = "element-refused"
    other_severities = {Severity.WARNING: "a color has an invalid value, and is dropped"}
    examples = (
        Example(
            "SRDF macro for MoveIt with <joint> elements",
            {
                "srdf/arm.xacro": '<robot xmlns:xacro="http://www.ros.org/wiki/xacro">\n'
                '  <xacro:macro name="arm">\n    <disable_collisions link1="a" link2="b"/>\n'
                '    <joint name="elbow" value="0"/>\n  </xacro:macro>\n</robot>\n'
            },
        ),
        Example("complete elements", {"robot.urdf": _ROBOT.format("value")}),
        Example(
            "second mass, which urdfdom does not read",
            {
                "robot.urdf": _ROBOT.format("value").replace(
                    "    </inertial>", "      <mass>2.0</mass>\n    </inertial>"
                )
            },
        ),
        Example(
            "robot file of a web application",
            {"web/package.json": "{}\n", "web/public/robot.urdf": "<robot>\n</robot>\n"},
        ),
        Example(
            "ros2_control joint in a macro",
            {
                "robot.xacro": _XACRO.format(' default="false"'),
                "control.xacro": '<robot xmlns:xacro="http://www.ros.org/wiki/xacro">\n'
                '  <xacro:macro name="driven" params="name">\n    <joint name="${name}">\n'
                '      <command_interface name="velocity"/>\n    </joint>\n'
                "  </xacro:macro>\n</robot>\n",
            },
        ),
        Example(
            "Gazebo material in a macro",
            {
                "materials.xacro": '<robot xmlns:xacro="http://www.ros.org/wiki/xacro">\n'
                '  <xacro:macro name="black">\n    <visual>\n      <material>\n'
                "        <diffuse>0 0 0 1</diffuse>\n      </material>\n    </visual>\n"
                "  </xacro:macro>\n</robot>\n",
            },
        ),
        Example(
            "wrong attribute name",
            {"robot.urdf": _ROBOT.format("val")},
            "4:8: <mass> has no 'value': urdfdom rejects the whole file; 'val' is ignored",
        ),
        Example(
            "inertia matrix without ixy, ixz and iyz",
            {
                "robot.urdf": '<robot name="r">\n  <link name="a">\n    <inertial>\n'
                '      <mass value="1"/>\n'
                '      <inertia ixx="1" iyy="1" izz="1"/>\n'
                "    </inertial>\n  </link>\n</robot>\n"
            },
            "5:8: <inertia> has no 'ixy', 'ixz' or 'iyz': urdfdom rejects the whole file",
        ),
        Example(
            "<limit> without effort and velocity",
            {
                "robot.urdf": '<robot name="r">\n  <link name="a"/>\n  <link name="b"/>\n'
                '  <joint name="c" type="revolute">\n'
                '    <parent link="a"/>\n    <child link="b"/>\n'
                '    <limit lower="-1" upper="1"/>\n  </joint>\n</robot>\n'
            },
            "7:6: <limit> has no 'effort' or 'velocity': urdfdom rejects the whole file",
        ),
        Example(
            "<xacro:arg> without a default",
            {"robot.xacro": _XACRO.format("")},
            "2:4: <xacro:arg> has no 'default': xacro stops here",
        ),
        Example(
            "robot without a name",
            {"robot.urdf": '<robot>\n  <link name="base_link"/>\n</robot>\n'},
            "1:2: <robot> has no 'name': urdfdom rejects the whole file",
        ),
        Example(
            "revolute joint with limits",
            {"robot.urdf": _ROBOT_JOINTS.format("revolute", _CHILD + _LIMIT)},
        ),
        Example(
            "continuous joint without limits",
            {"robot.urdf": _ROBOT_JOINTS.format("continuous", _CHILD)},
        ),
        Example(
            "revolute joint without limits",
            {"robot.urdf": _ROBOT_JOINTS.format("revolute", _CHILD)},
            "4:4: joint 'axis' is revolute and has no <limit>: urdfdom rejects the whole file; "
            "add effort, velocity, lower and upper",
        ),
        Example(
            "joint without a child",
            {"robot.urdf": _ROBOT_JOINTS.format("prismatic", _LIMIT)},
            "4:4: joint 'axis' has no <child>: urdfdom rejects the whole file",
        ),
        Example(
            "valid shape, joint type and numbers",
            {
                "robot.urdf": _ROBOT_VALUES.format(
                    'sphere radius="0.1"', "continuous", "0 0.1 -1e-3"
                )
            },
        ),
        Example(
            "invalid numbers in an element that urdfdom skips",
            {
                "robot.urdf": _ROBOT_VALUES.format(
                    'sphere radius="0.1"', "continuous", "0 0 0"
                ).replace(
                    "    <visual>", '    <collission><origin xyz="x"/></collission>\n    <visual>'
                )
            },
        ),
        Example(
            "color without alpha, material after the shape",
            {
                "robot.urdf": _ROBOT_VALUES.format(
                    'sphere radius="0.1"', "continuous", "0 0 0"
                ).replace(
                    "</geometry>",
                    '<material name="grey"/></geometry>\n'
                    '      <material name="grey"><color rgba="0.8 0.8 0.8"/></material>',
                )
            },
            Report(
                "6:42",
                "rgba is '0.8 0.8 0.8', but must be 4 numbers with spaces between: "
                "urdfdom drops the color",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "misspelled joint type, joint type of Gazebo",
            {
                "a.urdf": _ROBOT_VALUES.format('sphere radius="0.1"', "continous", "0 0 0"),
                "b.urdf": _ROBOT_VALUES.format('sphere radius="0.1"', "ball", "0 0 0"),
            },
            "a.urdf:8:28: unknown joint type 'continous': urdfdom rejects the whole file; did you "
            "mean 'continuous'?",
            "b.urdf:8:28: unknown joint type 'ball': urdfdom rejects the whole file; known: "
            "revolute, continuous, prismatic, fixed, floating, planar",
        ),
        Example(
            "unknown shape, commas between numbers, too few numbers",
            {
                "a.urdf": _ROBOT_VALUES.format('cube size="1 1 1"', "fixed", "0, 0, 0"),
                "b.urdf": _ROBOT_VALUES.format('box size="1 1"', "fixed", "0 0 0"),
            },
            "a.urdf:5:18: unknown shape <cube>: urdfdom rejects the whole file; known: box, "
            "cylinder, sphere, mesh",
            "a.urdf:11:18: xyz is '0, 0, 0', but must be 3 numbers with spaces between: urdfdom "
            "rejects the whole file",
            "b.urdf:5:28: size is '1 1', but must be 3 numbers with spaces between: urdfdom "
            "rejects the whole file",
        ),
        Example(
            "a word for a number",
            {"robot.urdf": _ROBOT_VALUES.format('sphere radius="small"', "fixed", "0 0 0")},
            "5:33: radius is 'small', but must be a number: urdfdom rejects the whole file",
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        yield from self._check_parts(package)
        yield from self._check_values(package)

    def _check_parts(self, package: Package) -> Iterator[Diagnostic]:
        yield from self._check_attributes(package)
        yield from self._check_joints(package)

    def _check_attributes(self, package: Package) -> Iterator[Diagnostic]:
        for robot in robots(package).whole:
            if robot.file.is_robot and robot.root.get("name") is None:
                message = "<robot> has no 'name': urdfdom rejects the whole file"
                yield self.report(robot.root, message)
        for part in filter(_is_urdf, urdf_parts(package)):
            if _is_skipped(part):
                continue
            holder = part.holder.tag if part.holder is not None else ""
            names = _OF_URDF.get((holder, part.tag), ())
            missing = [name for name in names if name not in part.attributes]
            if missing:
                others = [name for name in part.attributes if name not in names]
                suggestions = [closest_name(package, name, others, 0.6) for name in missing]
                hint = "".join(f"; {closest!r} is ignored" for closest in suggestions if closest)
                which = f"<{part.tag}> has no {_or_list(missing)}"
                yield self.report(part, f"{which}: urdfdom rejects the whole file{hint}")
        for path in robot_paths(package):
            try:
                file = robot_file(package, path)
            except ViewError:
                continue
            for element in file.root.descendants() if file is not None and file.is_xacro else ():
                for name in _missing(element):
                    message = f"<{element.tag}> has no {name!r}: xacro stops here"
                    yield self.report(element.name_location, message)

    def _check_joints(self, package: Package) -> Iterator[Diagnostic]:
        whole = {expansion.file.path for expansion in robots(package).whole}
        for part in urdf_parts(package):
            holder = part.holder
            if part.tag != "joint" or holder is None or holder.tag != "robot" or not whole:
                continue
            if any(child.tag.startswith("xacro:") for child in part.element.children):
                continue  # a macro or a condition may add it
            name = shown(part.get("name") or "")
            for tag in ("parent", "child"):
                if part.one(tag) is None:
                    message = f"joint {name!r} has no <{tag}>: urdfdom rejects the whole file"
                    yield self.report(part, message)
            type_ = part.get("type")
            if type_ in {"revolute", "prismatic"} and part.one("limit") is None:
                message = (
                    f"joint {name!r} is {type_} and has no <limit>: urdfdom rejects the whole "
                    "file; add effort, velocity, lower and upper"
                )
                yield self.report(part, message)

    def _check_values(self, package: Package) -> Iterator[Diagnostic]:
        for part in urdf_parts(package):
            holder = part.holder.tag if part.holder is not None else ""
            type_ = part.get("type") if (holder, part.tag) == ("robot", "joint") else None
            if type_ is not None and is_known(type_) and type_ not in _TYPES:
                closest = closest_name(package, type_.lower(), _TYPES, 0.7)
                hint = f"did you mean {closest!r}?" if closest else f"known: {', '.join(_TYPES)}"
                message = f"unknown joint type {type_!r}: urdfdom rejects the whole file; {hint}"
                yield self.report(part.at("type"), message)
            if holder == "geometry" and part.tag not in _SHAPES and _is_shape(part):
                message = (
                    f"unknown shape <{part.tag}>: urdfdom rejects the whole file; "
                    "known: box, cylinder, sphere, mesh"
                )
                yield self.report(part, message)
            for name, value in part.attributes.items():
                count = _COUNTS.get((part.tag, name)) if _is_read(part) else None
                if count and is_known(value) and not _has_numbers(value, count):
                    numbers = "a number" if count == 1 else f"{count} numbers with spaces between"
                    effect = "urdfdom rejects the whole file"
                    if name == "rgba":
                        effect = "urdfdom drops the color"
                    message = f"{name} is {value!r}, but must be {numbers}: {effect}"
                    severity = Severity.WARNING if name == "rgba" else None
                    yield self.report(part.at(name), message, severity=severity)


def _or_list(names: Sequence[str]) -> str:
    """Return names as in a sentence: ``'ixx', 'iyy' or 'izz'``."""
    *others, last = [repr(name) for name in names]
    return f"{', '.join(others)} or {last}" if others else last


def _is_urdf(part: Part) -> bool:
    """Return whether a part is not in a macro that may be called for Gazebo."""
    holder = part.holder
    if holder is None or holder.tag not in _OF_LINK:
        return True
    while holder is not None and holder.tag != "link":
        holder = holder.holder
    return holder is not None


def _is_skipped(part: Part) -> bool:
    """Return whether urdfdom skips a part: it only reads the first ``<mass>``, for example."""
    if part.holder is None or part.tag in _REPEATED:
        return False
    alike = [child for child in part.holder.element.children if child.tag == part.tag]
    return any(child is part.element for child in alike[1:])


def _is_shape(part: Part) -> bool:
    """Return whether urdfdom reads a part of a geometry: the first one."""
    children = part.holder.element.children if part.holder is not None else []
    return ":" not in part.tag and part.element in children[:1]


def _is_read(part: Part) -> bool:
    """Return whether urdfdom reads a part, as it knows the elements around it."""
    holder = part.holder
    while holder is not None and holder.tag in _READ:
        holder = holder.holder
    return holder is None


def _missing(element: Element) -> list[str]:
    names = _OF_XACRO.get(element.tag, ())
    return [name for name in names if element.get(name) is None]


def _has_numbers(value: str, count: int) -> bool:
    """Return whether a text consists of this many numbers."""
    words = value.split()
    try:
        return len([float(word) for word in words]) == count
    except ValueError:
        return False
