"""ND011: submodules of rclpy are imported before use."""

from __future__ import annotations

import ast
import sys
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, PythonRule, Report
from scaffold.api.python import PythonModule

SUBMODULES = frozenset(
    {
        "action",
        "callback_groups",
        "clock",
        "duration",
        "executors",
        "lifecycle",
        "node",
        "parameter",
    }
    | {"qos", "task", "time", "timer", "utilities"}
)
_LOADED = frozenset({"context", "utilities", "parameter", "task", "exceptions", "impl", "signals"})
"""What ``import rclpy`` itself imports at module level on Jazzy."""

_NODE = "import rclpy\n{}\n\nclass Talker(rclpy.node.Node):\n    pass\n"


class SubmoduleNotImported(PythonRule):
    """A submodule of rclpy, such as ``rclpy.node``, is used without being imported.

    **Why.** ``import rclpy`` does not load it: ``AttributeError: module 'rclpy' has no attribute
    'node'``. It works only where other code has loaded it; certain failures are reported.

    **Fix.** Write ``from rclpy.node import Node``, or ``import rclpy.node``.

    **Source.** rclpy issue 1301; ``rclpy/__init__.py``.
    """

    code = "ND011"
    name = "submodule-not-imported"
    examples = (
        Example("imported", {"talker.py": _NODE.format("import rclpy.node\n")}),
        Example(
            "not imported",
            {"talker.py": _NODE.format("")},
            Report("4:14", "'import rclpy' does not load rclpy.node: AttributeError"),
        ),
    )

    def check_file(self, module: PythonModule) -> Iterator[Diagnostic]:
        if "rclpy" in module.imports_by_root:
            yield from self._check(module)

    def _check(self, module: PythonModule) -> Iterator[Diagnostic]:
        if not all(self._loads_nothing(root) for root in module.imports_by_root):
            return
        imports = module.imports_by_root["rclpy"]
        loaded = {x.module.split(".")[1] for x in imports if "." in x.module} | _LOADED
        if loaded & {"node", "executors", "action", "lifecycle"}:
            # Each of these loads most of the others.
            loaded |= SUBMODULES - {"action", "lifecycle"}
        reported: set[str] = set()
        for node in module.walk(ast.Attribute):
            if node.attr not in SUBMODULES - loaded or node.attr in reported:
                continue
            if not isinstance(node.value, ast.Name) or module.qualified_name(node.value) != "rclpy":
                continue
            if not self._runs_at_import(module, node):
                continue
            reported.add(node.attr)
            message = f"'import rclpy' does not load rclpy.{node.attr}: AttributeError"
            yield self.report(module.location(node), message)

    def _loads_nothing(self, root: str) -> bool:
        """Return whether importing a package loads no module of rclpy."""
        return root in sys.stdlib_module_names or root == "rclpy" or root.endswith("_msgs")

    def _runs_at_import(self, module: PythonModule, node: ast.Attribute) -> bool:
        """Return whether the line runs before a call of rclpy may have loaded the module."""
        for parent in module.parents(node):
            if isinstance(parent, ast.FunctionDef | ast.AsyncFunctionDef | ast.Lambda):
                return False
            if isinstance(parent, ast.arg | ast.AnnAssign):
                return False
        return True
