"""UR031: calls of xacro macros give the parameters that the macros have."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Report, Rule, closest_name, listed_names
from scaffold.api.robot import Misfit, robots

_ROBOT = (
    '<robot name="robot" xmlns:xacro="http://www.ros.org/wiki/xacro">\n'
    '  <xacro:macro name="wheel" params="name y:=0 *origin">\n    <link name="${{name}}">\n'
    '      <visual>\n        <xacro:insert_block name="origin"/>\n'
    '        <geometry><sphere radius="0.1"/></geometry>\n'
    "      </visual>\n    </link>\n  </xacro:macro>\n"
    "  <xacro:wheel {}>{}</xacro:wheel>\n</robot>\n"
)
_ORIGIN = '<origin xyz="0 0 0"/>'


class MacroCallUnfit(Rule):
    """A call of a xacro macro lacks a parameter, or gives one that the macro does not have.

    **Why.** xacro stops, ``Undefined parameters [y]`` or ``Invalid parameter "z"``, so the robot
    has no description.

    **Fix.** Give each parameter without a default, and no others.

    **Source.** xacro, ``handle_macro_call``.
    """

    code = "UR031"
    name = "macro-call-unfit"
    examples = (
        Example("as defined", {"robot.xacro": _ROBOT.format('name="left" y="1"', _ORIGIN)}),
        Example("the default", {"robot.xacro": _ROBOT.format('name="left"', _ORIGIN)}),
        Example(
            "a default with a quote too many, which xacro reads",
            {"robot.xacro": _ROBOT.format('name="left" y="1"', _ORIGIN).replace("y:=0", "y:='''")},
        ),
        Example(
            "left out",
            {"robot.xacro": _ROBOT.format('y="1"', _ORIGIN)},
            Report("10:4", "macro 'wheel' needs 'name': xacro stops with 'Undefined parameters'"),
        ),
        Example(
            "another one",
            {"robot.xacro": _ROBOT.format('name="left" z="1"', _ORIGIN)},
            Report("10:28", "macro 'wheel' has no parameter 'z': xacro stops; it has name, y"),
        ),
        Example(
            "no block",
            {"robot.xacro": _ROBOT.format('name="left"', "")},
            Report("10:4", "macro 'wheel' needs an element for its block 'origin': xacro stops"),
        ),
        Example(
            "a block too many",
            {"robot.xacro": _ROBOT.format('name="left"', f"{_ORIGIN}<limit/>")},
            Report(
                "10:50", "macro 'wheel' has no block for <limit>: xacro stops with 'Unused block'"
            ),
        ),
        Example(
            "a condition that is no truth",
            {
                "robot.xacro": '<robot name="a" xmlns:xacro="http://www.ros.org/wiki/xacro">\n'
                '  <link name="a"/>\n  <xacro:if value="yes"/>\n</robot>\n'
            },
            Report("3:20", "'yes' is no condition: xacro stops; write true, false, 0, 1 or ${...}"),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for robot in robots(package).whole:
            for misfit in robot.problems.misfits:
                cause = f"calls of {misfit.macro}" if misfit.kind != "condition" else ""
                yield self.report(misfit, _message(package, misfit), cause=cause)


def _message(package: Package, misfit: Misfit) -> str:
    kind, macro, name, _, names = misfit
    if kind == "missing":
        return f"macro {macro!r} needs {name!r}: xacro stops with 'Undefined parameters'"
    if kind == "unknown":
        closest = closest_name(package, name, names, 0.6)
        hint = f"closest: {closest!r}" if closest else f"it has {listed_names(names, name)}"
        return f"macro {macro!r} has no parameter {name!r}: xacro stops; {hint}"
    if kind == "block missing":
        return f"macro {macro!r} needs an element for its block {name!r}: xacro stops"
    if kind == "block unused":
        return f"macro {macro!r} has no block for <{name}>: xacro stops with 'Unused block'"
    return f"{name!r} is no condition: xacro stops; write true, false, 0, 1 or ${{...}}"
