"""Branches of Python code that a constant disables."""

from __future__ import annotations

import ast
import operator
import re
from collections.abc import Callable, Mapping
from contextlib import suppress
from typing import TYPE_CHECKING

from scaffold.model.facts import fact
from scaffold.source import ViewError

if TYPE_CHECKING:
    from scaffold.model.package import Package
    from scaffold.model.python.module import PythonModule

_COMPARISONS: Mapping[type[ast.cmpop], Callable[[object, object], object]] = {
    ast.Eq: operator.eq,
    ast.NotEq: operator.ne,
    ast.Is: operator.is_,
    ast.IsNot: operator.is_not,
}


@fact
def is_in_disabled_branch(package: Package, path: str, line: int) -> bool:
    """Return whether a line is in a branch whose condition is false, as long as nobody edits it.

    The condition asks for a constant of the file, or for an attribute that only ``__init__`` sets,
    to a constant.

    Raises:
        ViewError: the file cannot be read.
    """
    module = package.module(path)
    return any(
        branch
        and branch[0].lineno <= line <= (branch[-1].end_lineno or 0)
        and _truth(package, module, node.test) is (not is_taken)
        for node in module.walk(ast.If)
        if node.lineno <= line <= (node.end_lineno or 0)
        for branch, is_taken in ((node.body, True), (node.orelse, False))
    )


def _truth(package: Package, module: PythonModule, test: ast.expr) -> bool | None:
    """Return whether a condition is true; ``None`` if unknown."""
    match test:
        case ast.UnaryOp(op=ast.Not(), operand=operand):
            value = _truth(package, module, operand)
            return None if value is None else not value
        case ast.BoolOp(op=op, values=values):
            deciding = isinstance(op, ast.Or)
            known = [_truth(package, module, value) for value in values]
            return deciding if deciding in known else None
        case ast.Compare(left=left, ops=[op], comparators=[ast.Constant(value=other)]):
            constant = _constant(package, module, left)
            compare = _COMPARISONS.get(type(op))
            if constant is None or compare is None:
                return None
            return bool(compare(constant.value, other))
    constant = _constant(package, module, test)
    return bool(constant.value) if constant is not None else None


def _constant(package: Package, module: PythonModule, node: ast.expr) -> ast.Constant | None:
    """Return the only value of a global variable or of an attribute of ``self``."""
    match node:
        case ast.Name(id=name):
            scope, bindings = module.index.lookup(name, node) or (None, ())
            value = bindings[0].value if len(bindings) == 1 and scope is module.tree else None
        case ast.Attribute(value=ast.Name(id="self"), attr=name):
            value = _only_value(module, node)
        case _:
            return None
    if not isinstance(value, ast.Constant) or _is_set_elsewhere(package, module, node, name):
        return None
    return value


def _only_value(module: PythonModule, attribute: ast.Attribute) -> ast.expr | None:
    """Return the value of an attribute that is set once in the file, in ``__init__``."""
    stores = [
        use for use in module.index.attributes(attribute.attr) if not isinstance(use.ctx, ast.Load)
    ]
    class_ = module.enclosing_class(attribute)
    if len(stores) != 1 or class_ is None or attribute.attr in module.index.bindings(class_):
        return None
    function, statement = module.enclosing_function(stores[0]), module.parent(stores[0])
    is_initial = function is not None and function.name == "__init__"
    if not is_initial or module.enclosing_class(stores[0]) is not class_:
        return None
    return statement.value if isinstance(statement, ast.Assign) else None


def _is_set_elsewhere(package: Package, module: PythonModule, node: ast.expr, name: str) -> bool:
    """Return whether another file may set a variable or an attribute, or this one by its name.

    There ``self`` is another object, unless the file knows the class.
    """
    if module.mentions("setattr(", "__dict__", "vars(", "globals("):
        return True
    class_ = module.enclosing_class(node)
    setting = rb"\.%b\b[ \t]*(?::[^=\n]{1,80})?=(?!=)" % name.encode()
    for path in package.python_files:
        with suppress(ViewError):
            data = package.data(path) if path != module.path else b""
            is_known = class_ is not None and class_.name.encode() in data
            if re.search(setting if is_known else rb"(?<!\bself)" + setting, data):
                return True
    return False
