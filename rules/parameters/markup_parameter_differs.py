"""PF033: launch files in XML and YAML give parameters that the node has, of their types."""

from __future__ import annotations

import re
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Report, Rule, nearest
from scaffold.api.launch import MarkupNode, is_known, markup_files
from scaffold.api.parameters import declared_by, place_of
from scaffold.api.programs import nodes_of
from scaffold.api.rclpy import NodeClass, NodeOwner

_WORDS = {
    r"[+-]?(?:0|[1-9]\d*)": "integer",
    r"[+-]?(?:\d+\.\d*|\.\d+)": "double",
    r"true|True|TRUE|false|False|FALSE": "bool",
    r"[A-Za-z_/][\w/-]*": "string",
}
"""Words that launch and rcl take for the same; others are not judged."""
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
    """A launch file in XML or YAML sets a parameter to another type than the node declares.

    **Why.** ``InvalidParameterTypeException: Trying to set parameter 'rate' to '2' of type
    'INTEGER', expecting type 'DOUBLE'``; a name that is not declared is dropped without a word.

    **Fix.** Write ``2.0``, or ``type='str'`` for text that looks like a number; the declared name.

    **Source.** ``launch_ros/actions/node.py``, ``parse_nested_parameters``;
    ``launch/utilities/type_utils.py``.
    """

    code = "PF033"
    name = "markup-parameter-differs"
    examples = (
        Example("its type", {**_FILES, "launch/a.launch.xml": _LAUNCH.format("rate", "2.0")}),
        Example(
            "a text that stands for something",
            {**_FILES, "launch/a.launch.xml": _LAUNCH.format("rate", "$(var rate)")},
        ),
        Example(
            "an integer, in XML and YAML",
            {
                **_FILES,
                "launch/a.launch.xml": _LAUNCH.format("rate", "2"),
                "launch/b.launch.yaml": _YAML.format("2"),
            },
            reports=(
                Report(
                    "launch/a.launch.xml:3:31",
                    "rate (demo/talk.py:7) is declared as double, but this is an "
                    "integer: the node dies",
                ),
                Report(
                    "launch/b.launch.yaml:7:14",
                    "rate (demo/talk.py:7) is declared as double, but this is an "
                    "integer: the node dies",
                ),
            ),
        ),
        Example(
            "another name",
            {**_FILES, "launch/a.launch.xml": _LAUNCH.format("rates", "2.0")},
            reports=(
                Report(
                    "launch/a.launch.xml:3:18",
                    "the node declares no parameter 'rates'; 'rate' is meant",
                ),
            ),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for file in markup_files(package):
            for node in file.nodes:
                owner = _owner(package, node) if node.parameters else None
                if owner is None:
                    continue
                declared = declared_by(owner, package)
                # A program that makes a node on the side may well make another one.
                is_all = declared.complete and isinstance(owner, NodeClass)
                for name, value in node.parameters:
                    if not is_known(name):
                        continue
                    if is_all and not declared.has(name.value):
                        near = nearest(package, name.value, sorted(declared.types), 0.6)
                        hint = f"; {near!r} is meant" if near else ""
                        message = f"the node declares no parameter {name.value!r}{hint}"
                        yield self.report(name, message)
                    kind, given = declared.types.get(name.value), _type(value.value)
                    if kind and given and kind != given:
                        where = place_of(declared.places[name.value], package)
                        article = "an" if given == "integer" else "a"
                        message = f"{name.value} ({where}) is declared as {kind}, but this is "
                        yield self.report(value, f"{message}{article} {given}: the node dies")


def _owner(package: Package, node: MarkupNode) -> NodeOwner | None:
    """Return the code of a node, when it is Python of this package or one of the workspace."""
    if node.package is None or node.executable is None:
        return None
    name = node.package.value
    home = package if name == package.name else package.workspace.get(name)
    found = nodes_of(home, node.executable.value) if home is not None else []
    return found[0] if len(found) == 1 else None


def _type(text: str) -> str | None:
    """Return the type that launch gives a word; ``None`` when that is not sure."""
    if text.lower() in _UNSURE:
        return None
    return next((kind for word, kind in _WORDS.items() if re.fullmatch(word, text)), None)
