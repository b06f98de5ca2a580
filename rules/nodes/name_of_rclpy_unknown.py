"""ND045: names of rclpy that are imported or used exist."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from difflib import get_close_matches

from scaffold.api import Diagnostic, Example, Package, Report, Rule
from scaffold.api.python import Import, PythonModule, is_handled
from scaffold.api.rclpy import PLACES, first_unknown, known_names

_CODE = "import rclpy\nfrom rclpy.{} import {}\n\nrclpy.{}()\nQOS = ReliabilityPolicy.{}\n"
_RIGHT = _CODE.format("qos", "ReliabilityPolicy", "init", "RELIABLE")


class NameOfRclpyUnknown(Rule):
    """Code uses a name that rclpy does not have.

    **Why.** ``AttributeError`` or ``ImportError`` when the line is reached: ``module 'rclpy' has
    no attribute 'spin_forever'``, ``type object 'DurabilityPolicy' has no attribute 'LATCHED'``.

    **Fix.** Use the name in rclpy; functions of rospy are often methods of the node now.

    **Source.** The modules of rclpy 7.1 (ROS 2 Jazzy).
    """

    code = "ND045"
    name = "name-of-rclpy-unknown"
    examples = (
        Example("known names", {"talker.py": _RIGHT}),
        Example(
            "for type checkers only",
            {
                "talker.py": "from __future__ import annotations\n\nimport rclpy\n\n\n"
                "def name_of(node: rclpy.Node) -> str:\n    return node.get_name()\n"
            },
        ),
        Example(
            "a module and an import",
            {"talker.py": "from rclpy.nodes import Node\nfrom rclpy.qos import Reliability\n"},
            Report("1:1", "rclpy has no 'nodes': ImportError; did you mean 'node'?"),
            Report(
                "2:23",
                "rclpy.qos has no 'Reliability': ImportError; did you mean 'ReliabilityPolicy'?",
            ),
        ),
        Example(
            "a function and a member",
            {"talker.py": _CODE.format("qos", "ReliabilityPolicy", "initialize", "SURE")},
            Report("4:1", "rclpy has no 'initialize': AttributeError"),
            Report("5:7", "rclpy.qos.ReliabilityPolicy has no 'SURE': AttributeError"),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        if package.name == "rclpy":
            return
        for module in package.modules():
            if "rclpy" in module.imports_by_root and not module.in_tests:
                for statement in module.imports_by_root["rclpy"]:
                    yield from self._check_import(statement)
                yield from self._check_uses(module)

    def _check_import(self, statement: Import) -> Iterator[Diagnostic]:
        if statement.guarded or statement.conditional or statement.type_checking:
            return
        unknown = first_unknown(statement.module)
        if unknown is not None:
            yield self.report(statement, _message(*unknown, "ImportError"))
            return
        for name in statement.names:
            unknown = first_unknown(f"{statement.module}.{name.name}")
            is_misplaced = statement.module == "rclpy" and name.name in PLACES
            if unknown is not None and name.name != "*" and not is_misplaced:
                yield self.report(name, _message(*unknown, "ImportError"))

    def _check_uses(self, module: PythonModule) -> Iterator[Diagnostic]:
        for node in module.walk(ast.Attribute):
            if isinstance(module.parent(node), ast.Attribute):
                continue
            name = module.qualified_name(node) or ""
            unknown = first_unknown(name) if name.startswith("rclpy.") else None
            if unknown is not None and not is_handled(module, node, "AttributeError"):
                yield self.report(module.location(node), _message(*unknown, "AttributeError"))


def _message(owner: str, name: str, error: str) -> str:
    known = [x.removesuffix("()") for x in known_names()[owner] if not x.startswith("_")]
    near = get_close_matches(name, known, n=1, cutoff=0.75)
    hint = f"; did you mean {near[0]!r}?" if near else ""
    return f"{owner} has no {name!r}: {error}{hint}"
