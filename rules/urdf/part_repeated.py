"""UR021: the links and the joints of a robot have names of their own."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Report, Rule
from scaffold.api.robot import Expansion, Part, robots

_ROBOT = (
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


class PartRepeated(Rule):
    """Two links or two joints of a robot have the same name.

    **Why.** ``link 'wheel' is not unique``: the parser of URDF refuses the whole file, and
    robot_state_publisher ends.

    **Fix.** Give each a name of its own; in a macro, make it of a parameter: ``${name}_link``.

    **Source.** urdfdom, ``model.cpp``.
    """

    code = "UR021"
    name = "part-repeated"
    examples = (
        Example("each its own", {"robot.urdf": _ROBOT.format("arm", "shoulder", "arm")}),
        Example("a macro with a name", {"robot.xacro": _MACRO.format("${name}", "${name}")}),
        Example(
            "a link twice",
            {"robot.urdf": _ROBOT.format("wheel", "shoulder", "arm")},
            Report(
                "4:15",
                "a link 'wheel' is already defined in robot.urdf:3: urdfdom refuses the whole file",
            ),
        ),
        Example(
            "a joint twice",
            {"robot.urdf": _ROBOT.format("arm", "axis", "arm")},
            Report(
                "9:16",
                "a joint 'axis' is already defined in robot.urdf:5: urdfdom refuses the whole file",
            ),
        ),
        Example(
            "a macro without",
            {"robot.xacro": _MACRO.format("wheel", "wheel")},
            Report(
                "4:17",
                "a link 'wheel' is already defined in an earlier call of the macro: "
                "urdfdom refuses the whole file",
            ),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for robot in robots(package).whole:
            if robot.file.is_robot and not robot.problems.undefined:
                yield from self._check(package, robot)

    def _check(self, package: Package, robot: Expansion) -> Iterator[Diagnostic]:
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
                    f"a {tag} {_shown(name)!r} is already defined in {where}: urdfdom refuses "
                    "the whole file"
                )
                yield self.report(part.at("name"), message)


def _shown(name: str) -> str:
    return name.replace("\0", "")
