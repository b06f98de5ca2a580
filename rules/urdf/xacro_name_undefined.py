"""UR030: the macros, parameters, properties and arguments that a xacro file uses are defined."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress

from scaffold.api import (
    Diagnostic,
    Example,
    Package,
    Report,
    Rule,
    Severity,
    ViewError,
    closest_name,
    listed_names,
)
from scaffold.api.robot import Misfit, Undefined, is_argument_given, is_launched, robots

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
_SIMILAR = 0.6
"""Minimum similarity, from 0 to 1, of a suggested name."""
_PLAIN = (
    '<robot name="robot">\n  <link name="base">\n    <visual>\n      <geometry>'
    '<mesh filename="$(find robot)/base.stl"/></geometry>\n    </visual>\n  </link>\n</robot>\n'
)


def _robot(place: int, text: str) -> str:
    return _ROBOT.format(*_GOOD[:place], text, *_GOOD[place + 1 :])


_ROBOT_CALLS = (
    '<robot name="robot" xmlns:xacro="http://www.ros.org/wiki/xacro">\n'
    '  <xacro:macro name="wheel" params="name y:=0 *origin">\n    <link name="${{name}}">\n'
    '      <visual>\n        <xacro:insert_block name="origin"/>\n'
    '        <geometry><sphere radius="0.1"/></geometry>\n'
    "      </visual>\n    </link>\n  </xacro:macro>\n"
    "  <xacro:wheel {}>{}</xacro:wheel>\n</robot>\n"
)
_CONDITION = (
    '<robot name="robot" xmlns:xacro="http://www.ros.org/wiki/xacro">\n'
    '  <xacro:arg name="model" default="a"/>\n'
    '  <xacro:macro name="laser"><link name="laser"/></xacro:macro>\n'
    "  <xacro:if value=\"${{'$(arg model)' != 'a'}}\">\n    <xacro:{}/>\n  </xacro:if>\n"
    '  <link name="base"/>\n</robot>\n'
)
_ORIGIN = '<origin xyz="0 0 0"/>'


class XacroNameUndefined(Rule):
    """A xacro file uses an undefined name, or calls a macro with wrong parameters.

    **Why.** xacro stops with ``unknown macro name: xacro:weel``, ``name 'radus' is not defined``,
    ``Undefined parameters [y]`` or ``Invalid parameter "z"``, and there is no robot description. A
    macro call without the ``xacro:`` prefix is not expanded.

    **Fix.** Define the name, or include the file that defines it, before its first use. Pass every
    macro parameter that has no default, and no others.

    **Source.** xacro, ``handle_macro_call`` and ``eval_text``.
    """

    code = "UR030"
    name = "xacro-name-undefined"
    other_severities = {Severity.WARNING: "another package may process the file with xacro"}
    examples = (
        Example("defined names", {"robot.xacro": _robot(1, "${radius}")}),
        Example(
            "Python names, macro of an include in another package",
            {
                "robot.xacro": _robot(1, "${max(radius, pi / 2)}"),
                "other.xacro": '<robot xmlns:xacro="http://www.ros.org/wiki/xacro">\n'
                '  <xacro:include filename="$(find other)/parts.xacro"/>\n'
                "  <xacro:part/>\n</robot>\n",
            },
        ),
        Example(
            "macro in a namespace that calls another macro of its file",
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
            "macro with the name of a Gazebo element",
            {
                "robot.xacro": '<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">\n'
                '  <xacro:macro name="imu">\n'
                '    <gazebo reference="base"><sensor type="imu"><imu/></sensor></gazebo>\n'
                "  </xacro:macro>\n  <xacro:imu/>\n</robot>\n"
            },
        ),
        Example(
            "macro that creates an element of the same name",
            {
                "robot.xacro": '<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">\n'
                '  <xacro:macro name="contact"><contact mu="1"/></xacro:macro>\n'
                '  <link name="base">\n    <collision><xacro:contact/></collision>\n  </link>\n'
                "</robot>\n"
            },
        ),
        Example(
            "undefined properties, invalid expression",
            {
                "a.xacro": _robot(1, "${radus}"),
                "b.xacro": _robot(1, "${radius *}"),
                "c.xacro": _robot(1, "${height}"),
            },
            "a.xacro:8:35: property 'radus' is not defined here: xacro stops; did you mean "
            "'radius'?",
            "b.xacro:8:35: ${radius *} is not a valid Python expression: xacro stops",
            "c.xacro:8:35: property 'height' is not defined here: xacro stops",
        ),
        Example(
            "misspelled macro name",
            {"robot.xacro": _ROBOT.format(*_GOOD[:2], "xacro:w", "left", "xacro:w")},
            "12:4: macro 'wwheel' is not defined here: xacro stops; did you mean 'wheel'?",
        ),
        Example(
            "template of a code generator",
            {"templates/robot.xacro": _ROBOT_CALLS.replace("<xacro:wheel", "<xacro:$NAME$")},
        ),
        Example(
            "undefined macro used to stop xacro for invalid arguments",
            {"robot.xacro": _CONDITION.format("wrong_model")},
        ),
        Example(
            "misspelled macro name in a condition",
            {"robot.xacro": _CONDITION.format("laserr")},
            "5:6: macro 'laserr' is not defined here: xacro stops; did you mean 'laser'?",
        ),
        Example(
            "undefined block, undefined argument, substitution that only launch has",
            {
                "a.xacro": _robot(0, '<xacro:insert_block name="pose"/>'),
                "b.xacro": _robot(3, "$(arg prefx)wheel"),
                "c.xacro": _robot(3, "$(var prefix)wheel"),
            },
            "a.xacro:7:35: block 'pose' is not a parameter of this macro: xacro stops; add '*pose'",
            "b.xacro:12:22: argument 'prefx' has no <xacro:arg>: xacro stops unless it is given; "
            "did you mean 'prefix'?",
            "c.xacro:12:22: xacro has no $(var ...): it stops; known: find, env, optenv, dirname, "
            "arg",
        ),
        Example(
            "macro call without the xacro: prefix",
            {"robot.xacro": _ROBOT.format(*_GOOD[:2], "", "left", "")},
            "12:4: <wheel> is not expanded without its prefix; write <xacro:wheel>",
        ),
        Example(
            "call with all parameters",
            {"robot.xacro": _ROBOT_CALLS.format('name="left" y="1"', _ORIGIN)},
        ),
        Example(
            "call without a parameter that has a default",
            {"robot.xacro": _ROBOT_CALLS.format('name="left"', _ORIGIN)},
        ),
        Example(
            "default with an extra quote, which xacro accepts",
            {
                "robot.xacro": _ROBOT_CALLS.format('name="left" y="1"', _ORIGIN).replace(
                    "y:=0", "y:='''"
                )
            },
        ),
        Example(
            "missing parameter",
            {"robot.xacro": _ROBOT_CALLS.format('y="1"', _ORIGIN)},
            "10:4: macro 'wheel' needs 'name': xacro stops with 'Undefined parameters'",
        ),
        Example(
            "unknown parameter",
            {"robot.xacro": _ROBOT_CALLS.format('name="left" z="1"', _ORIGIN)},
            "10:28: macro 'wheel' has no parameter 'z': xacro stops; it has name, y",
        ),
        Example(
            "missing block",
            {"robot.xacro": _ROBOT_CALLS.format('name="left"', "")},
            "10:4: macro 'wheel' needs an element for its block 'origin': xacro stops",
        ),
        Example(
            "extra block",
            {"robot.xacro": _ROBOT_CALLS.format('name="left"', f"{_ORIGIN}<limit/>")},
            "10:50: macro 'wheel' has no block for <limit>: xacro stops with 'Unused block'",
        ),
        Example(
            "invalid condition",
            {
                "robot.xacro": '<robot name="a" xmlns:xacro="http://www.ros.org/wiki/xacro">\n'
                '  <link name="a"/>\n  <xacro:if value="yes"/>\n</robot>\n'
            },
            "3:20: 'yes' is not a condition: xacro stops; write true, false, 0, 1 or ${...}",
        ),
        Example(
            "URDF file that is not processed by xacro",
            {"robot.urdf": _PLAIN},
            Report(
                "4:33",
                "only xacro reads $(find ...), which does not process this file: write "
                "package:// and the package",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "URDF file that a launch file passes to xacro",
            {
                "robot.urdf": _PLAIN,
                "launch/a.launch.py": "import xacro\n\n\n"
                "def generate_launch_description():\n    xacro.process_file('robot.urdf')\n",
            },
        ),
        Example(
            "misspelled parameter of a macro",
            {"robot.xacro": _ROBOT_CALLS.format('nmae="a"', _ORIGIN)},
            "10:4: macro 'wheel' needs 'name': xacro stops with 'Undefined parameters'",
            "10:16: macro 'wheel' has no parameter 'nmae': xacro stops; did you mean 'name'?",
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        yield from self._check_names(package)
        yield from self._check_calls(package)
        yield from self._check_plain(package)

    def _check_names(self, package: Package) -> Iterator[Diagnostic]:
        for robot in robots(package).whole:
            is_used_here = is_launched(package, robot.file.path)
            for undefined in robot.problems.undefined:
                message = _message_of_name(package, undefined, is_used_here=is_used_here)
                if message:
                    cause = "macros without a prefix" if undefined[0] == "tag" else ""
                    yield self.report(undefined, message, cause=cause)

    def _check_calls(self, package: Package) -> Iterator[Diagnostic]:
        for robot in robots(package).whole:
            for misfit in robot.problems.misfits:
                cause = f"calls of {misfit.macro}" if misfit.kind != "condition" else ""
                yield self.report(misfit, _message_of_call(package, misfit), cause=cause)

    def _check_plain(self, package: Package) -> Iterator[Diagnostic]:
        """Check URDF files in a package that does not use xacro."""
        for robot in robots(package).whole:
            for element in (robot.file.root, *robot.file.root.descendants()):
                for attribute in element.attributes.values():
                    is_plain = not robot.file.is_xacro and attribute.value.startswith("$(find ")
                    if is_plain and not _uses_xacro(package):
                        message = (
                            "only xacro reads $(find ...), which does not process this file: write "
                            "package:// and the package"
                        )
                        yield self.report(attribute, message, severity=Severity.WARNING)


def _uses_xacro(package: Package) -> bool:
    """Return whether any other file of a package mentions xacro."""
    for path in package.files:
        if path.endswith((".py", ".xml", ".yaml", ".yml", ".txt", ".sh", ".xacro")):
            with suppress(ViewError, OSError):
                if "xacro" in path or "xacro" in package.source(path).text:
                    return True
    return False


def _message_of_name(package: Package, undefined: Undefined, *, is_used_here: bool) -> str:
    kind, name, _, names = undefined
    closest = closest_name(package, name, names, _SIMILAR)
    hint = f"; did you mean {closest!r}?" if closest else ""
    messages = {
        "property": f"property {name!r} is not defined here: xacro stops{hint}",
        "macro": f"macro {name!r} is not defined here: xacro stops{hint}",
        "block": f"block {name!r} is not a parameter of this macro: xacro stops; add '*{name}'",
        "command": f"xacro has no $({name} ...): it stops; known: {', '.join(names[:5])}",
        "expression": f"${{{name}}} is not a valid Python expression: xacro stops",
        "tag": f"<{name}> is not expanded without its prefix; write <xacro:{name}>",
    }
    if kind == "stop":  # in a condition, where an undefined macro serves as an error message
        return messages["macro"] if closest else ""
    is_given = kind == "argument" and is_argument_given(package, name)
    if kind == "argument" and not is_given and (closest or is_used_here):
        return f"argument {name!r} has no <xacro:arg>: xacro stops unless it is given{hint}"
    return messages.get(kind, "")


def _message_of_call(package: Package, misfit: Misfit) -> str:
    kind, macro, name, _, names = misfit
    if kind == "missing":
        return f"macro {macro!r} needs {name!r}: xacro stops with 'Undefined parameters'"
    if kind == "unknown":
        closest = closest_name(package, name, names, _SIMILAR)
        hint = f"did you mean {closest!r}?" if closest else f"it has {listed_names(names, name)}"
        return f"macro {macro!r} has no parameter {name!r}: xacro stops; {hint}"
    if kind == "block missing":
        return f"macro {macro!r} needs an element for its block {name!r}: xacro stops"
    if kind == "block unused":
        return f"macro {macro!r} has no block for <{name}>: xacro stops with 'Unused block'"
    return f"{name!r} is not a condition: xacro stops; write true, false, 0, 1 or ${{...}}"
