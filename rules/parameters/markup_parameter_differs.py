"""PF033: XML and YAML launch files set declared parameters with the declared types."""

from __future__ import annotations

import re
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Rule, closest_name
from scaffold.api.formats import Attribute
from scaffold.api.launch import MarkupFile, MarkupNode, code_of, is_known, markup_files
from scaffold.api.parameters import declared_by, place_of
from scaffold.api.programs import KnownNode

_WORDS = {
    r"[+-]?(?:0|[1-9]\d*)": "integer",
    r"[+-]?(?:\d+\.\d*|\.\d+)": "double",
    r"true|True|TRUE|false|False|FALSE": "bool",
    r"[A-Za-z_/][\w/-]*": "string",
}
"""Values that launch and rcl parse as the same type; others are not checked."""
_UNSURE = frozenset({"y", "n", "yes", "no", "on", "off", "null", "inf", "nan", "infinity"})
_FILES = {
    "package.xml": "<package><name>demo</name>"
    "<export><build_type>ament_python</build_type></export></package>\n",
    "setup.py": "from setuptools import setup\n\nsetup(\n    name='demo',\n"
    "    entry_points={'console_scripts': ['talk = demo.talk:main']},\n)\n",
    "demo/talk.py": "from rclpy.node import Node\n\n\nclass Talker(Node):\n"
    "    def __init__(self):\n        super().__init__('talker')\n"
    "        self.declare_parameter('rate', 1.0)\n",
}
_LAUNCH = (
    "<launch>\n  <node pkg='demo' exec='talk'>\n"
    "    <param name='{}' value='{}'/>\n  </node>\n</launch>\n"
)
_YAML = (
    "launch:\n- node:\n    pkg: demo\n    exec: talk\n"
    "    param:\n    - name: rate\n      value: {}\n"
)


class MarkupParameterDiffers(Rule):
    """An XML or YAML launch file sets an undeclared parameter, or a value of another type.

    **Why.** ``InvalidParameterTypeException: Trying to set parameter 'rate' to '2' of type
    'INTEGER', expecting type 'DOUBLE'``; an undeclared parameter is silently dropped.

    **Fix.** Write ``2.0``, or ``type='str'`` for strings that look like numbers; use the declared
    name.

    **Source.** ``launch_ros/actions/node.py``, ``parse_nested_parameters``;
    ``launch/utilities/type_utils.py``.
    """

    code = "PF033"
    name = "markup-parameter-differs"
    examples = (
        Example(
            "the declared type", {**_FILES, "launch/a.launch.xml": _LAUNCH.format("rate", "2.0")}
        ),
        Example(
            "a substitution",
            {**_FILES, "launch/a.launch.xml": _LAUNCH.format("rate", "$(var rate)")},
        ),
        Example(
            "the default of a launch argument",
            {
                **_FILES,
                "launch/a.launch.xml": _LAUNCH.format("rate", "$(var rate)").replace(
                    "<launch>", "<launch>\n  <arg name='rate' default='2'/>"
                ),
                "launch/b.launch.xml": _LAUNCH.format("rate", "$(var rate)").replace(
                    "<launch>", "<launch>\n  <arg name='rate' default='2.0'/>"
                ),
            },
            "launch/a.launch.xml:4:31: 'rate' is declared as double (demo/talk.py:7), but the "
            "default of 'rate' is an integer: InvalidParameterTypeException",
        ),
        Example(
            "an integer for a double, in XML and YAML",
            {
                **_FILES,
                "launch/a.launch.xml": _LAUNCH.format("rate", "2"),
                "launch/b.launch.yaml": _YAML.format("2"),
            },
            "launch/a.launch.xml:3:31: 'rate' is declared as double (demo/talk.py:7), but this is "
            "an integer: InvalidParameterTypeException",
            "launch/b.launch.yaml:7:14: 'rate' is declared as double (demo/talk.py:7), but this "
            "is an integer: InvalidParameterTypeException",
        ),
        Example(
            "another name",
            {**_FILES, "launch/a.launch.xml": _LAUNCH.format("rates", "2.0")},
            "launch/a.launch.xml:3:18: node declares no parameter 'rates': the value is ignored; "
            "did you mean 'rate'?",
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for file in markup_files(package):
            for node in file.nodes:
                owner = _owner(package, node) if node.parameters else None
                if owner is None:
                    continue
                declared = declared_by(owner, package)
                # A program that creates nodes inline may create others.
                is_all = declared.complete and owner.is_class
                for name, value in node.parameters:
                    if not is_known(name):
                        continue
                    if is_all and not declared.has(name.value):
                        closest = closest_name(package, name.value, sorted(declared.types), 0.6)
                        hint = f"; did you mean {closest!r}?" if closest else ""
                        message = (
                            f"node declares no parameter {name.value!r}: the value is ignored{hint}"
                        )
                        yield self.report(name, message)
                    kind, (argument, given) = declared.types.get(name.value), _given(file, value)
                    if kind and given and kind != given:
                        place = declared.places[name.value]
                        where = place_of(place.package, place.location, package)
                        subject = f"the default of {argument!r}" if argument else "this"
                        article = "an" if given == "integer" else "a"
                        message = f"{name.value!r} is declared as {kind} ({where}), but {subject} "
                        message += f"is {article} {given}: InvalidParameterTypeException"
                        yield self.report(value, message)


def _owner(package: Package, node: MarkupNode) -> KnownNode | None:
    if node.package is None or node.executable is None:
        return None
    return code_of(package, node.package.value, node.executable.value)


def _given(file: MarkupFile, value: Attribute) -> tuple[str, str | None]:
    """Return the type of a value, and the launch argument whose default it is, if any."""
    reference = re.fullmatch(r"\$\(var ([\w-]+)\)", value.value)
    if reference is None:
        return "", _type(value.value)
    default = file.default_of(reference[1])
    return reference[1], _type(default.value) if default is not None else None


def _type(text: str) -> str | None:
    """Return the type that launch infers for a word; ``None`` if not certain."""
    if text.lower() in _UNSURE:
        return None
    return next((kind for word, kind in _WORDS.items() if re.fullmatch(word, text)), None)
