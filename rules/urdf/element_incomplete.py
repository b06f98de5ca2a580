"""UR010: the elements of URDF and xacro have what their readers demand."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from scaffold.api import Diagnostic, Example, Package, Report, Rule, ViewError, closest_name
from scaffold.api.formats import Element
from scaffold.api.robot import Part, robot_file, robot_paths, robots, urdf_parts

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


class ElementIncomplete(Rule):
    """An element of URDF or xacro lacks an attribute or a child without which nobody reads it.

    **Why.** The parser of URDF refuses the whole file, and xacro stops: robot_state_publisher ends
    with ``Failed to parse robot description``, for a joint with ``Joint [axis] is of type REVOLUTE
    but it does not specify limits``.

    **Fix.** Write the attribute or the element; ``<xacro:arg>`` needs a default as well, and a
    wheel is ``continuous`` and needs no limits.

    **Source.** urdfdom, ``joint.cpp`` and ``link.cpp``; xacro, ``reqd_attrs``.
    """

    code = "UR010"
    name = "element-incomplete"
    examples = (
        Example("complete", {"robot.urdf": _ROBOT.format("value")}),
        Example(
            "of a program for browsers, which npm builds",
            {"web/package.json": "{}\n", "web/public/robot.urdf": "<robot>\n</robot>\n"},
        ),
        Example(
            "a joint of ros2_control, in a macro that others call",
            {
                "robot.xacro": _XACRO.format(' default="false"'),
                "control.xacro": '<robot xmlns:xacro="http://www.ros.org/wiki/xacro">\n'
                '  <xacro:macro name="driven" params="name">\n    <joint name="${name}">\n'
                '      <command_interface name="velocity"/>\n    </joint>\n'
                "  </xacro:macro>\n</robot>\n",
            },
        ),
        Example(
            "a material for Gazebo, in a macro that others call",
            {
                "materials.xacro": '<robot xmlns:xacro="http://www.ros.org/wiki/xacro">\n'
                '  <xacro:macro name="black">\n    <visual>\n      <material>\n'
                "        <diffuse>0 0 0 1</diffuse>\n      </material>\n    </visual>\n"
                "  </xacro:macro>\n</robot>\n",
            },
        ),
        Example(
            "another name for an attribute",
            {"robot.urdf": _ROBOT.format("val")},
            Report(
                "4:8", "<mass> has no 'value': urdfdom refuses the whole file; 'val' is not read"
            ),
        ),
        Example(
            "an argument without a default",
            {"robot.xacro": _XACRO.format("")},
            Report("2:4", "<xacro:arg> has no 'default': xacro stops here"),
        ),
        Example(
            "a robot without a name",
            {"robot.urdf": '<robot>\n  <link name="base_link"/>\n</robot>\n'},
            Report("1:2", "<robot> has no 'name': urdfdom refuses the whole file"),
        ),
        Example(
            "a joint with limits", {"robot.urdf": _ROBOT_JOINTS.format("revolute", _CHILD + _LIMIT)}
        ),
        Example(
            "a wheel without limits", {"robot.urdf": _ROBOT_JOINTS.format("continuous", _CHILD)}
        ),
        Example(
            "a joint without limits",
            {"robot.urdf": _ROBOT_JOINTS.format("revolute", _CHILD)},
            Report(
                "4:4",
                "joint 'axis' is revolute and has no <limit>: urdfdom refuses the "
                "whole file; add effort, velocity, lower and upper",
            ),
        ),
        Example(
            "a joint without a child",
            {"robot.urdf": _ROBOT_JOINTS.format("prismatic", _LIMIT)},
            Report("4:4", "joint 'axis' has no <child>: urdfdom refuses the whole file"),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        yield from self._check_attributes(package)
        yield from self._check_joints(package)

    def _check_attributes(self, package: Package) -> Iterator[Diagnostic]:
        for robot in robots(package).whole:
            if robot.file.is_robot and robot.root.get("name") is None:
                message = "<robot> has no 'name': urdfdom refuses the whole file"
                yield self.report(robot.root, message)
        for part in filter(_is_urdf, urdf_parts(package)):
            holder = part.holder.tag if part.holder is not None else ""
            for name in _OF_URDF.get((holder, part.tag), ()):
                if name not in part.attributes:
                    closest = closest_name(package, name, list(part.attributes), 0.6)
                    hint = f"; {closest!r} is not read" if closest else ""
                    message = f"<{part.tag}> has no {name!r}: urdfdom refuses the whole file{hint}"
                    yield self.report(part, message)
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
            name = part.get("name")
            for tag in ("parent", "child"):
                if part.one(tag) is None:
                    message = f"joint {name!r} has no <{tag}>: urdfdom refuses the whole file"
                    yield self.report(part, message)
            type_ = part.get("type")
            if type_ in {"revolute", "prismatic"} and part.one("limit") is None:
                message = (
                    f"joint {name!r} is {type_} and has no <limit>: urdfdom refuses the whole "
                    "file; add effort, velocity, lower and upper"
                )
                yield self.report(part, message)


def _is_urdf(part: Part) -> bool:
    """Tell whether a part is not that of a macro that may be called for Gazebo."""
    holder = part.holder
    if holder is None or holder.tag not in _OF_LINK:
        return True
    while holder is not None and holder.tag != "link":
        holder = holder.holder
    return holder is not None


def _missing(element: Element) -> list[str]:
    names = _OF_XACRO.get(element.tag, ())
    return [name for name in names if element.get(name) is None]
