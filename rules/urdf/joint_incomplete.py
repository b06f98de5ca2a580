"""UR013: joints have a parent, a child, and limits where their type needs them."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Report, Rule
from scaffold.api.robot import robots, urdf_parts

_ROBOT = (
    '<robot name="robot">\n  <link name="base_link"/>\n  <link name="wheel"/>\n'
    '  <joint name="axis" type="{}">\n    <parent link="base_link"/>\n{}  </joint>\n</robot>\n'
)
_CHILD = '    <child link="wheel"/>\n'
_LIMIT = '    <limit lower="0" upper="1" effort="1" velocity="1"/>\n'


class JointIncomplete(Rule):
    """A joint has no parent, no child, or no limits although its type needs them.

    **Why.** ``Joint [axis] is of type REVOLUTE but it does not specify limits``: the parser
    refuses the whole file, and robot_state_publisher ends.

    **Fix.** Add the element; a wheel is ``continuous`` and needs no limits.

    **Source.** urdfdom, ``joint.cpp``.
    """

    code = "UR013"
    name = "joint-incomplete"
    examples = (
        Example("with limits", {"robot.urdf": _ROBOT.format("revolute", _CHILD + _LIMIT)}),
        Example("a wheel", {"robot.urdf": _ROBOT.format("continuous", _CHILD)}),
        Example(
            "without limits",
            {"robot.urdf": _ROBOT.format("revolute", _CHILD)},
            Report(
                "4:4",
                "joint 'axis' is revolute and has no <limit>: urdfdom refuses the "
                "whole file; add effort, velocity, lower and upper",
            ),
        ),
        Example(
            "without a child",
            {"robot.urdf": _ROBOT.format("prismatic", _LIMIT)},
            Report("4:4", "joint 'axis' has no <child>: urdfdom refuses the whole file"),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
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
