"""UR030: the macros, properties and arguments that a xacro file uses are defined."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Report, Rule, closest_name
from scaffold.api.robot import Undefined, is_argument_given, is_launched, robots

_ROBOT = (
    '<robot name="robot" xmlns:xacro="http://www.ros.org/wiki/xacro">\n'
    '  <xacro:arg name="prefix" default=""/>\n'
    '  <xacro:property name="radius" value="0.05"/>\n'
    '  <xacro:macro name="wheel" params="name *origin">\n    <link name="${{name}}">\n'
    "      <visual>\n"
    '        {}\n        <geometry><sphere radius="{}"/></geometry>\n'
    "      </visual>\n    </link>\n  </xacro:macro>\n"
    '  <{}wheel name="{}"><origin xyz="0 0 0"/></{}wheel>\n</robot>\n'
)
_GOOD = (
    '<xacro:insert_block name="origin"/>',
    "${radius * 2}",
    "xacro:",
    "$(arg prefix)wheel",
    "xacro:",
)
_FIRST = 0.6


def _robot(place: int, text: str) -> str:
    return _ROBOT.format(*_GOOD[:place], text, *_GOOD[place + 1 :])


class XacroNameUndefined(Rule):
    """A xacro file uses a macro, a property, a block or an argument that nothing defines.

    **Why.** xacro stops, ``unknown macro name: xacro:weel`` or ``name 'radus' is not defined``,
    so the robot has no description. A macro without its prefix stays as it is, unread.

    **Fix.** Use a name that the file or one that it includes defines, above its use.

    **Source.** xacro, ``handle_macro_call`` and ``eval_text``.
    """

    code = "UR030"
    name = "xacro-name-undefined"
    examples = (
        Example("all defined", {"robot.xacro": _robot(1, "${radius}")}),
        Example(
            "names of Python and of another file",
            {
                "robot.xacro": _robot(1, "${max(radius, pi / 2)}"),
                "other.xacro": '<robot xmlns:xacro="http://www.ros.org/wiki/xacro">\n'
                '  <xacro:include filename="$(find other)/parts.xacro"/>\n'
                "  <xacro:part/>\n</robot>\n",
            },
        ),
        Example(
            "a macro of a namespace, which calls another of its file",
            {
                "robot.xacro": '<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">\n'
                '  <xacro:include filename="parts.xacro" ns="parts"/>\n'
                "  <xacro:parts.arm/>\n</robot>\n",
                "parts.xacro": '<robot xmlns:xacro="http://www.ros.org/wiki/xacro">\n'
                '  <xacro:macro name="piece"><link name="arm"/></xacro:macro>\n'
                '  <xacro:macro name="arm"><xacro:piece/></xacro:macro>\n</robot>\n',
            },
        ),
        Example(
            "a macro with the name of an element that Gazebo reads",
            {
                "robot.xacro": '<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">\n'
                '  <xacro:macro name="imu">\n'
                '    <gazebo reference="base"><sensor type="imu"><imu/></sensor></gazebo>\n'
                "  </xacro:macro>\n  <xacro:imu/>\n</robot>\n"
            },
        ),
        Example(
            "a property; an expression",
            {
                "a.xacro": _robot(1, "${radus}"),
                "b.xacro": _robot(1, "${radius *}"),
                "c.xacro": _robot(1, "${height}"),
            },
            Report(
                "a.xacro:8:35",
                "property 'radus' is not defined here: xacro stops; closest: 'radius'",
            ),
            Report("b.xacro:8:35", "${radius *} is not an expression of Python: xacro stops"),
            Report("c.xacro:8:35", "property 'height' is not defined here: xacro stops"),
        ),
        Example(
            "a macro",
            {"robot.xacro": _ROBOT.format(*_GOOD[:2], "xacro:w", "left", "xacro:w")},
            Report("12:4", "macro 'wwheel' is not defined here: xacro stops; closest: 'wheel'"),
        ),
        Example(
            "a block; an argument; a command of launch",
            {
                "a.xacro": _robot(0, '<xacro:insert_block name="pose"/>'),
                "b.xacro": _robot(3, "$(arg prefx)wheel"),
                "c.xacro": _robot(3, "$(var prefix)wheel"),
            },
            Report(
                "a.xacro:7:35",
                "block 'pose' is not a parameter of this macro: xacro stops; add '*pose'",
            ),
            Report(
                "b.xacro:12:22",
                "argument 'prefx' has no <xacro:arg>: xacro stops unless it is "
                "given; closest: 'prefix'",
            ),
            Report(
                "c.xacro:12:22",
                "xacro has no $(var ...): it stops; known: find, env, optenv, dirname, arg",
            ),
        ),
        Example(
            "a macro without its prefix",
            {"robot.xacro": _ROBOT.format(*_GOOD[:2], "", "left", "")},
            Report("12:4", "<wheel> is not expanded without its prefix: write <xacro:wheel>"),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for robot in robots(package).whole:
            is_used_here = is_launched(package, robot.file.path)
            for undefined in robot.problems.undefined:
                message = _message(package, undefined, is_used_here=is_used_here)
                if message:
                    cause = "macros without a prefix" if undefined[0] == "tag" else ""
                    yield self.report(undefined, message, cause=cause)


def _message(package: Package, undefined: Undefined, *, is_used_here: bool) -> str:
    kind, name, _, names = undefined
    closest = closest_name(package, name, names, _FIRST)
    hint = f"; closest: {closest!r}" if closest else ""
    messages = {
        "property": f"property {name!r} is not defined here: xacro stops{hint}",
        "macro": f"macro {name!r} is not defined here: xacro stops{hint}",
        "block": f"block {name!r} is not a parameter of this macro: xacro stops; add '*{name}'",
        "command": f"xacro has no $({name} ...): it stops; known: {', '.join(names[:5])}",
        "expression": f"${{{name}}} is not an expression of Python: xacro stops",
        "tag": f"<{name}> is not expanded without its prefix: write <xacro:{name}>",
    }
    is_given = kind == "argument" and is_argument_given(package, name)
    if kind == "argument" and not is_given and (closest or is_used_here):
        return f"argument {name!r} has no <xacro:arg>: xacro stops unless it is given{hint}"
    return messages.get(kind, "")
