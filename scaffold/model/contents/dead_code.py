"""Python code that is never executed: after ``return``, disabled by a constant, or replaced."""

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
    from scaffold.model.python.scopes import FunctionNode

_COMPARISONS: Mapping[type[ast.cmpop], Callable[[object, object], object]] = {
    ast.Eq: operator.eq,
    ast.NotEq: operator.ne,
    ast.Is: operator.is_,
    ast.IsNot: operator.is_not,
}
_USING = (ast.Call, ast.Await, ast.Name)
"""What uses a function, or may call one that does."""


@fact
def is_dead(package: Package, path: str, line: int) -> bool:
    """Return whether Python never executes a line, whatever is called, until somebody edits it.

    It is after a statement that leaves its block; in a branch whose condition is false; or in a
    function that a later one replaces. The condition asks for a constant of the file, of its class,
    of the function, or of a module that the file sets; or for an attribute that only ``__init__``
    sets, to a constant.

    Raises:
        ViewError: the file cannot be read.
    """
    module = package.module(path)
    return (
        any(_covers(statement, line) for statement in module.passed_over)
        or any(_covers(node, line) and _is_replaced(module, node) for node in module.function_nodes)
        or any(
            branch
            and branch[0].lineno <= line <= (branch[-1].end_lineno or 0)
            and _truth(package, module, node.test) is (not is_taken)
            for node in module.walk(ast.If)
            if _covers(node, line)
            for branch, is_taken in ((node.body, True), (node.orelse, False))
        )
    )


def _covers(node: ast.AST, line: int) -> bool:
    start = getattr(node, "lineno", line + 1)
    return start <= line <= (getattr(node, "end_lineno", None) or start)


def _is_replaced(module: PythonModule, function: FunctionNode) -> bool:
    """Return whether a function or method is defined again before anything can call it."""
    block = getattr(module.parent(function), "body", None)
    field, number = module.index.place(function)
    if field != "body" or not isinstance(block, list) or function.decorator_list:
        return False
    for later in block[number + 1 :]:
        if later.__class__ is function.__class__ and not later.decorator_list:
            if later.name == function.name:
                return True
        elif any(_may_use(function.name, node) for node in module.below(later, *_USING)):
            return False
    return False


def _may_use(name: str, node: ast.AST) -> bool:
    return getattr(node, "id", name) == name


def _truth(package: Package, module: PythonModule, test: ast.expr) -> bool | None:
    """Return whether a condition is true; ``None`` if unknown."""
    match test:
        case ast.GeneratorExp():
            return True
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
    """Return the only value of a variable, or of an attribute of ``self`` or a module."""
    match node:
        case ast.Name(id=name):
            scope, bindings = module.index.lookup(name, node) or (None, ())
            value = bindings[0].value if len(bindings) == 1 else None
            if isinstance(scope, ast.FunctionDef | ast.AsyncFunctionDef):
                return value if isinstance(value, ast.Constant) else None
        case ast.Attribute(value=ast.Name(id="self" | "cls"), attr=name):
            value = _only_value(module, node)
        case ast.Attribute(value=ast.Name(), attr=name):
            value = _value_of_class(module, node) or _value_set_at_import(module, node)
        case _:
            return None
    if not isinstance(value, ast.Constant) or _is_set_elsewhere(package, module, node, value):
        return None
    return value


def _stores(module: PythonModule, name: str) -> list[ast.Attribute]:
    return [use for use in module.index.attributes(name) if not isinstance(use.ctx, ast.Load)]


def _only_value(module: PythonModule, attribute: ast.Attribute) -> ast.expr | None:
    """Return the value of an attribute that is set once: in ``__init__``, or in a class."""
    stores = _stores(module, attribute.attr)
    class_ = module.enclosing_class(attribute)
    if class_ is None:
        return None
    if attribute.attr in module.index.bindings(class_):
        return _value_in_class(module, class_, attribute.attr)
    if len(stores) != 1:
        return None
    function, statement = module.enclosing_function(stores[0]), module.parent(stores[0])
    is_initial = function is not None and function.name == "__init__"
    if not is_initial or module.enclosing_class(stores[0]) is not class_:
        return None
    return statement.value if isinstance(statement, ast.Assign) else None


def _value_of_class(module: PythonModule, attribute: ast.Attribute) -> ast.expr | None:
    """Return the value of an attribute of a class of the file that no code of the file sets."""
    class_ = module.classes.get(module.text(attribute.value))
    return _value_in_class(module, class_.node, attribute.attr) if class_ else None


def _value_in_class(module: PythonModule, class_: ast.ClassDef, name: str) -> ast.expr | None:
    """Return the value of an attribute that only the body of a class sets."""
    own = module.index.bindings(class_).get(name, ())
    all_bindings = [
        item
        for other in module.walk(ast.ClassDef)
        for item in module.index.bindings(other).get(name, ())
    ]
    is_only = len(own) == len(all_bindings) == 1 and not _stores(module, name)
    return own[0].value if is_only else None


def _value_set_at_import(module: PythonModule, attribute: ast.Attribute) -> ast.expr | None:
    """Return what the file sets an attribute of a module to, once and at its top level."""
    match [(store, module.parent(store)) for store in _stores(module, attribute.attr)]:
        case [(ast.Attribute() as store, ast.Assign(value=value) as statement)]:
            is_same = module.qualified_name(store) == module.qualified_name(attribute) is not None
            return value if is_same and module.parent(statement) is module.tree else None
    return None


def _is_set_elsewhere(
    package: Package, module: PythonModule, node: ast.expr, value: ast.Constant
) -> bool:
    """Return whether other code may set a variable or an attribute, to something else.

    There ``self`` is another object, unless the file knows the class.
    """
    if module.mentions("setattr(", "__dict__", "vars(", "globals("):
        return True
    owner, _, name = module.text(node).rpartition(".")
    class_ = module.enclosing_class(node)
    class_name = class_.name if class_ is not None and owner in {"", "self", "cls"} else owner
    same = re.escape(module.text(value)).encode()
    setting = rb"%b\b[ \t]*(?::[^=\n]{1,80})?=(?!=)(?![ \t]*%b\s)" % (name.encode(), same)
    setting += rb"|\bglobal\b[^\n]*\b%b\b" % name.encode()
    for path in package.python_files:
        with suppress(ViewError):
            data = package.data(path) if path != module.path else b""
            is_known = class_name != "" and class_name.encode() in data
            start = rb"(?m)(?:\.|^[ \t]+)" if is_known else rb"(?<!\bself)\."
            if re.search(start + setting, data):
                return True
    return False
