"""PF032: lists in parameter files are not empty."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Report, Rule
from scaffold.api.formats import Sequence
from scaffold.api.launch import nodes_for
from scaffold.api.parameters import declared_by, parameter_file, parameter_paths, place_of
from scaffold.api.python import is_handled
from scaffold.api.rclpy import NodeClass, NodeDefinition, ParameterRead

_NODE = (
    "from rclpy.node import Node\n\n\n"
    "class Talker(Node):\n    def __init__(self):\n        super().__init__('talker')\n"
    "        self.declare_parameter('names', ['a'])\n"
    "        self.names = self.{}.value\n"
)
_FILE = "talker:\n  ros__parameters:\n    names: {}\n"


class ListEmpty(Rule):
    """A parameter that the node reads is set to an empty list in a parameter file.

    **Why.** rcl treats it as unset, and the default is not used either:
    ``ParameterUninitializedException: The parameter 'names' is not initialized``.

    **Fix.** Remove the line, or write ``['']`` and have the node skip empty names.

    **Source.** ``rcl_yaml_param_parser/src/parse.c``; ``rclpy/node.py``, ``get_parameter``.
    """

    code = "PF032"
    name = "list-empty"
    examples = (
        Example(
            "items",
            {"talker.py": _NODE.format("get_parameter('names')"), "a.yaml": _FILE.format("[b]")},
        ),
        Example(
            "empty, and a node that handles it",
            {"talker.py": _NODE.format("get_parameter_or('names')"), "a.yaml": _FILE.format("[]")},
        ),
        Example(
            "empty",
            {"talker.py": _NODE.format("get_parameter('names')"), "a.yaml": _FILE.format("[]")},
            Report(
                "a.yaml:3:12",
                "empty list leaves 'names' unset, and talker.py:8 reads it: "
                "ParameterUninitializedException",
            ),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for path in parameter_paths(package):
            file = parameter_file(package, path)
            for section in file.sections if file else ():
                for entry in section.entries:
                    if not isinstance(entry.value, Sequence) or entry.value.items:
                        continue
                    for owner in nodes_for(package, path, section):
                        read = _read(owner.definition(package), entry.name)
                        if read is None or not declared_by(owner, package).types.get(entry.name):
                            continue
                        where = place_of(owner.package, read.location, package)
                        message = (
                            f"empty list leaves {entry.name!r} unset, and "
                            f"{where} reads it: ParameterUninitializedException"
                        )
                        yield self.report(entry.value, message)
                        break


def _read(owner: NodeDefinition, name: str) -> ParameterRead | None:
    """Return a place where the node fails when a parameter has no value."""
    current: NodeDefinition | None = owner
    while current is not None:
        for read in current.parameter_reads:
            if read.name == name and read.method == "get_parameter":
                module = current.facts.module
                if not is_handled(module, read.call, "ParameterUninitializedException"):
                    return read
        current = current.base if isinstance(current, NodeClass) else None
    return None
