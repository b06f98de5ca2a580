"""Actions of a launch file, and the values they read, that no LaunchDescription gets."""

from __future__ import annotations

import ast
from typing import TYPE_CHECKING

from scaffold.model.facts import fact
from scaffold.model.launch.python_file import LaunchFile
from scaffold.source import ViewError

if TYPE_CHECKING:
    from scaffold.model.package import Package
    from scaffold.model.python.scopes import ScopeIndex

_LOOKUPS = ("locals()", "vars()", "globals()", "eval(", "exec(")
"""Functions that may read any variable."""
_ENDING = ".launch.py"
"""The ending of launch files that no other module can import: their name has a dot."""
_STRAIGHT = (ast.Assign, ast.AnnAssign, ast.AugAssign, ast.Expr)
"""Statements after which the next one is executed, if any."""
_VIEWS = frozenset({"items", "format", "join", "str"})
"""Functions that only read an object, such as the dictionary of ``launch_arguments``."""


@fact
def is_in_unlaunched_action(package: Package, path: str, line: int, column: int) -> bool:
    """Return whether a place is in an action, or a value of one, that is never launched.

    Raises:
        ViewError: the file cannot be read.
    """
    launch = LaunchFile.of(package, path)
    around = [call for call in launch.module.walk(ast.Call) if covers(call, line, column)]
    return any(is_never_used(launch, call) for call in around[-1:] if _makes_object(call))


def is_only_stored(package: Package, path: str, text: str) -> bool:
    """Return whether a launch file has a text only in values that it never uses."""
    if not path.endswith(_ENDING):
        return False
    try:
        launch = LaunchFile.of(package, path)
    except ViewError:
        return False
    constants = [
        constant
        for constant in launch.module.walk(ast.Constant)
        if isinstance(constant.value, str) and text in constant.value
    ]
    return bool(constants) and all(is_never_used(launch, constant) for constant in constants)


def covers(node: ast.expr, line: int, column: int) -> bool:
    """Return whether an expression contains a place."""
    start = node.lineno, node.col_offset
    end = node.end_lineno or node.lineno, node.end_col_offset or 0
    return start <= (line, column - 1) < end


def is_never_used(
    launch: LaunchFile,
    node: ast.AST,
    seen: frozenset[ast.Name] = frozenset(),
    ignored: frozenset[ast.AST] = frozenset(),
) -> bool:
    """Return whether a path or an action is only printed, or stored in a variable never read.

    The variable is a local one, or one of a launch file that no module can import. Classes of
    launch access files when executed, functions may do so immediately.

    Args:
        launch: The launch file.
        node: The path, the action, or a variable with it.
        seen: The variables followed so far, where they are set.
        ignored: The actions that do not count as a use.
    """
    if not ignored.isdisjoint(launch.module.parents(node)):
        return True
    if _is_printed(launch, node):
        return True
    target = _variable_with(launch, node)
    if target is None:
        return False
    if target in seen:
        return True
    reads = _reads(launch, target)
    following = seen | {target}
    return reads is not None and all(
        is_never_used(launch, use, following, ignored) for use in reads
    )


def is_unread(launch: LaunchFile, target: ast.Name) -> bool:
    """Return whether nothing reads a variable after it is set here, not even to store it again."""
    return _reads(launch, target) == []


def _reads(launch: LaunchFile, target: ast.Name) -> list[ast.Name] | None:
    """Return the uses of a variable that is set; ``None`` if others may use it."""
    index = launch.module.index
    scope = index.scope_of(target)
    is_local = isinstance(scope, ast.FunctionDef | ast.AsyncFunctionDef)
    is_of_file = isinstance(scope, ast.Module) and launch.path.endswith(_ENDING)
    if not (is_local or is_of_file) or launch.module.mentions(*_LOOKUPS):
        return None
    reads = [use for use in index.uses_of(target) if isinstance(use.ctx, ast.Load)]
    return _reached(launch, target, reads)


def _is_printed(launch: LaunchFile, node: ast.AST) -> bool:
    """Return whether a value is an argument of ``print()``, perhaps in a format string."""
    for parent in launch.module.parents(node):
        if not isinstance(parent, ast.FormattedValue | ast.JoinedStr):
            match parent:
                case ast.Call(func=ast.Name(id="print")):
                    return True
            return False
    return False


def _variable_with(launch: LaunchFile, node: ast.AST) -> ast.Name | None:
    """Return the variable that is set to an object with a node, and to nothing else."""
    for parent in launch.module.parents(node):
        match parent:
            case ast.Assign(targets=[ast.Name() as target]):
                return target
            case ast.Call() if not _makes_object(parent):
                return None
            case ast.stmt() | ast.NamedExpr() | ast.Await() | ast.Yield() | ast.YieldFrom():
                return None
    return None


def _makes_object(call: ast.Call) -> bool:
    """Return whether a call is that of a class, or of a method without effects."""
    name = call.func.attr if isinstance(call.func, ast.Attribute) else call.func
    name = name.id if isinstance(name, ast.Name) else name
    return isinstance(name, str) and (name[:1].isupper() or name in _VIEWS)


def _reached(launch: LaunchFile, target: ast.Name, reads: list[ast.Name]) -> list[ast.Name]:
    """Return the uses of a variable, up to the statement that certainly sets it again."""
    index = launch.module.index
    scope = index.scope_of(target)
    statement = index.parent(target)
    body = getattr(scope, "body", [])
    if statement not in body or any(index.scope_of(use) is not scope for use in reads):
        return reads
    uses: dict[ast.AST, list[ast.Name]] = {}
    for use in reads:
        uses.setdefault(_part_with(index, use, scope), []).append(use)
    reached: list[ast.Name] = []
    for later in body[body.index(statement) + 1 :]:
        if not isinstance(later, _STRAIGHT):
            break
        reached += uses.get(later, ())
        match later:
            case ast.Assign(targets=[ast.Name(id=name)]) if name == target.id:
                return reached
    return reads


def _part_with(index: ScopeIndex, node: ast.AST, scope: ast.AST) -> ast.AST:
    """Return the child of a scope with a node, such as a statement of its body."""
    for parent in index.parents(node):
        if parent is scope:
            break
        node = parent
    return node
