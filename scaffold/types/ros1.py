"""Code for ROS 1 in files for ROS 1 and 2: guarded by the condition that guards rospy."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.model.python.conditions.guards import all_conditions
from scaffold.model.python.module import PythonModule

_ROS1 = "rospy"


def is_for_ros1(module: PythonModule, node: ast.AST) -> bool:
    """Return whether a node only runs where rospy is imported."""
    if _ROS1 not in module.imports_by_root:
        return False
    around = {*_conditions(module, node)}
    imports: list[ast.Import | ast.ImportFrom] = [*module.walk(ast.Import)]
    imports += module.walk(ast.ImportFrom)
    return any(
        not around.isdisjoint(_conditions(module, statement))
        for statement in imports
        if _ROS1 in {name.partition(".")[0] for name in _imported(statement)}
    )


def _imported(statement: ast.Import | ast.ImportFrom) -> list[str]:
    """Return the modules that a statement imports."""
    if isinstance(statement, ast.ImportFrom):
        return [statement.module or ""]
    return [alias.name for alias in statement.names]


def _conditions(module: PythonModule, node: ast.AST) -> Iterator[tuple[str, bool]]:
    """Yield the conditions under which a node runs; ``a != b`` and ``not a`` are negated."""
    for condition in all_conditions(module, node):
        test, needed = condition.test, condition.needed
        match test:
            case ast.UnaryOp(op=ast.Not(), operand=operand):
                test, needed = operand, not needed
            case ast.Compare(ops=[ast.NotEq()]):
                test = ast.Compare(test.left, [ast.Eq()], test.comparators)
                needed = not needed
        yield ast.dump(test), needed
