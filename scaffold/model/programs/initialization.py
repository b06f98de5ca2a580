"""Whether rclpy is initialized before a program creates its first node."""

from __future__ import annotations

import ast
import builtins
import sys
from typing import TYPE_CHECKING

from scaffold.model.facts import fact

if TYPE_CHECKING:
    from scaffold.model.package import Package
    from scaffold.model.programs.entry_points import Execution
    from scaffold.model.rclpy.file import RclpyFile

_HARMLESS = frozenset({"rclpy", *dir(builtins)})


def late_init(file: RclpyFile, made: ast.Call) -> ast.Call | None:
    """Return the only initialization of a file, if it comes too late in the same function."""
    mentions = [*file.module.index.attributes("init"), *file.module.index.names("init")]
    if len(file.init_calls) != 1 or len(mentions) != 1:
        return None
    call = file.init_calls[0].call
    is_certain = not file.is_conditional(call) and not file.is_conditional(made)
    is_same = file.function_of(call) is file.function_of(made)
    return call if is_certain and is_same and call.lineno > made.lineno else None


@fact
def may_init(package: Package, path: str) -> bool:
    """Return whether a file may initialize rclpy, or creates its own context; raises ViewError."""
    module = package.module(path)
    index = module.index
    for name in ("init", "Context"):
        if index.attributes(name) or index.names(name):
            return True
    return any(
        name.name in {"init", "Context"} or (name.name == "*" and not _is_standard(item.root))
        for item in module.imports
        for name in item.names
    )


def calls_others(package: Package, run: Execution, made: ast.Call) -> bool:
    """Return whether foreign code runs before the node is created, which may initialize rclpy."""
    module = run.file.module
    function = run.file.function_of(made)
    own = {part for path in package.python_files for part in path.split("/")}
    for call in run.calls:
        is_later = run.file.function_of(call) is function and call.lineno > made.lineno
        if call is made or is_later or module.enclosing_class(call) is not None:
            continue
        for name in module.qualified_names(call.func):
            root = name.partition(".")[0]
            is_own = root in own or f"{root}.py" in own
            if root and root not in _HARMLESS and not is_own and not _is_standard(root):
                return True
    return False


def _is_standard(root: str) -> bool:
    return root in sys.stdlib_module_names
