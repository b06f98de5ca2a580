"""ND011: submodules of rclpy are imported before use, and names from the right module."""

from __future__ import annotations

import ast
import sys
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, PythonRule
from scaffold.api.python import PythonModule
from scaffold.api.rclpy import PLACES

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
    """A submodule of rclpy is used without an import, or one of its names imported from rclpy.

    **Why.** ``import rclpy`` does not load ``rclpy.node``: ``AttributeError: module 'rclpy' has no
    attribute 'node'``, ``ImportError: cannot import name 'Node' from 'rclpy'``. The first works
    only if other code has loaded the submodule; only certain failures are reported.

    **Fix.** Write ``from rclpy.node import Node``, or ``import rclpy.node``.

    **Source.** rclpy issue 1301; ``rclpy/__init__.py``.
    """

    code = "ND011"
    name = "submodule-not-imported"
    examples = (
        Example("a module imported", {"talker.py": _NODE.format("import rclpy.node\n")}),
        Example(
            "a module not imported",
            {"talker.py": _NODE.format("")},
            "4:14: 'import rclpy' does not load rclpy.node: AttributeError",
        ),
        Example("a name from its module", {"talker.py": "from rclpy.node import Node\n"}),
        Example(
            "a name from the package",
            {"talker.py": "from rclpy import Node\n"},
            "1:19: rclpy has no 'Node': ImportError; import it from rclpy.node",
        ),
    )

    def check_file(self, module: PythonModule) -> Iterator[Diagnostic]:
        yield from self._check_uses(module)
        yield from self._check_imports(module)

    def _check_uses(self, module: PythonModule) -> Iterator[Diagnostic]:
        if "rclpy" in module.imports_by_root:
            yield from self._check(module)

    def _check(self, module: PythonModule) -> Iterator[Diagnostic]:
        if not all(self._loads_nothing(root) for root in module.imports_by_root):
            return
        imports = module.imports_by_root["rclpy"]
        loaded = {x.module.split(".")[1] for x in imports if "." in x.module} | _LOADED
        if loaded & {"node", "executors", "action", "lifecycle"}:
            # Each of these imports most of the others.
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

    def _check_imports(self, module: PythonModule) -> Iterator[Diagnostic]:
        for statement in module.imports_by_root.get("rclpy", ()):
            if statement.module != "rclpy":
                continue
            for name in statement.names:
                place = PLACES.get(name.name)
                if place is not None:
                    message = f"rclpy has no {name.name!r}: ImportError; import it from {place}"
                    yield self.report(name, message)
