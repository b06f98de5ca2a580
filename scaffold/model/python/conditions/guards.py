"""Code whose exceptions do not matter: guarded, caught or never executed."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.model.python.conditions.handlers import expected_errors, last_names
from scaffold.model.python.conditions.skips import skip_conditions
from scaffold.model.python.imports import IMPORT_OR_SKIP
from scaffold.model.python.module import PythonModule
from scaffold.record import NamedTuple

_LEAVING = (ast.Return, ast.Raise, ast.Continue, ast.Break)
"""Statements that leave their block."""
_ENDING = frozenset(
    {"sys.exit", "exit", "quit", "os._exit"}
    | {"pytest.skip", "pytest.fail", "pytest.xfail", "pytest.exit"}
)
"""Functions that do not return."""
_ENDING_METHODS = frozenset({"skipTest", "fail"})
"""Methods of a ``TestCase`` that do not return."""
_ALL = frozenset({"Exception", "BaseException"})
_SHORT = 2
"""The maximum number of statements of a ``try`` that only probes whether something works."""


def is_handled(
    module: PythonModule, node: ast.AST, exception: str, *, is_broad: bool = True
) -> bool:
    """Return whether an exception raised at a node is caught in its function, or never raised.

    Args:
        module: The file.
        node: The place where it is raised.
        exception: The last part of its name, such as ``AttributeError``.
        is_broad: Whether handlers of any exception are accepted.
    """
    expecting = {exception, *_ALL} if is_broad else {exception}
    child = node
    for parent in module.parents(node):
        if child in module.passed_over or _is_never_evaluated(module, child, parent):
            return True
        if expecting & _expected_in(parent, child):
            return True
        if isinstance(parent, ast.Try) and module.index.place(child)[0] == "body":
            for handler in parent.handlers:
                is_any = handler.type is None
                if (is_any and is_broad) or (handler.type and expecting & last_names(handler.type)):
                    return True
        if isinstance(parent, ast.FunctionDef | ast.AsyncFunctionDef):
            return False
        child = parent
    return False


def is_expected(module: PythonModule, node: ast.AST, exception: str) -> bool:
    """Return whether code expects an exception that a node always raises.

    A handler of any exception that only logs it does not.

    Args:
        module: The file.
        node: The place where it is raised.
        exception: The last part of its name, such as ``AttributeError``.
    """
    if is_handled(module, node, exception, is_broad=False):
        return True
    if has_fallback(module, node, is_rare=False):
        return True
    child = node
    for parent in module.parents(node):
        if isinstance(parent, ast.FunctionDef | ast.AsyncFunctionDef):
            return False
        if isinstance(parent, ast.Try) and module.index.place(child)[0] == "body":
            broad = [
                handler
                for handler in parent.handlers
                if handler.type is None or _ALL & last_names(handler.type)
            ]
            if any(is_probe(parent, handler) for handler in broad):
                return True
        child = parent
    return False


def is_probe(node: ast.Try, handler: ast.ExceptHandler) -> bool:
    """Return whether a ``try`` is so short, and a handler so quiet, that it only probes."""
    logs = any(isinstance(part, ast.Call) for part in ast.walk(handler))
    return len(node.body) <= _SHORT and not logs


def has_fallback(module: PythonModule, node: ast.AST, *, is_rare: bool) -> bool:
    """Return whether a handler of any exception replaces a failing node.

    A handler that logs, or that sets a constant, hides a permanent failure; occasional
    failures are what such handlers are for.

    Args:
        module: The file.
        node: The failing node.
        is_rare: Whether it only fails occasionally.
    """
    child = node
    for parent in module.parents(node):
        if isinstance(parent, ast.Try) and isinstance(child, ast.stmt) and child in parent.body:
            for handler in parent.handlers:
                is_broad = handler.type is None or _ALL & last_names(handler.type)
                replaces = _goes_on if is_rare else _replaces
                if is_broad and replaces(module, child, handler):
                    return True
        if isinstance(parent, ast.FunctionDef | ast.AsyncFunctionDef):
            return False
        child = parent
    return False


def _goes_on(module: PythonModule, failing: ast.stmt, handler: ast.ExceptHandler) -> bool:
    """Return whether all names are set after a handler, or no code follows it."""
    if any(isinstance(node, ast.Raise) for node in module.below(handler, ast.Raise)):
        return False
    if leaves_block(module, handler.body[-1]):
        return True
    bound = [node for node in module.below(failing, ast.Name) if isinstance(node.ctx, ast.Store)]
    lookups = [module.index.lookup(node.id, node) for node in bound]
    return all(lookup is not None and len(lookup[1]) > 1 for lookup in lookups)


def _replaces(module: PythonModule, failing: ast.stmt, handler: ast.ExceptHandler) -> bool:
    """Return whether a handler computes the result of a statement in another way."""
    for instead in handler.body:
        match failing, instead:
            case ast.Assign(targets=[target]), ast.Assign(targets=[other], value=value):
                is_same = module.text(target) == module.text(other)
            case ast.Return(value=ast.expr()), ast.Return(value=ast.expr() as value):
                is_same = True
            case ast.Expr(value=ast.Call() as first), ast.Expr(value=ast.Call() as value):
                is_same = _does_the_same(module, first, value)
            case _:
                continue
        if is_same and not isinstance(value, ast.Constant):
            return True
    return False


def _does_the_same(module: PythonModule, first: ast.Call, second: ast.Call) -> bool:
    """Return whether two calls are of one function, or of methods with equal arguments."""
    if module.text(first.func) == module.text(second.func):
        return True
    match first.func, second.func:
        case ast.Attribute(value=one), ast.Attribute(value=other):
            given = [[*map(ast.unparse, (*call.args, *call.keywords))] for call in (first, second)]
            is_given = bool(given[0]) and given[0] == given[1]
            return is_given and module.text(one) == module.text(other)
    return False


def _expected_in(parent: ast.AST, child: ast.AST) -> set[str]:
    """Return the exceptions that a ``with`` expects: ``with pytest.raises(TypeError):``."""
    if not isinstance(parent, ast.With) or child not in parent.body:
        return set()
    return set().union(*map(expected_errors, parent.items))


def is_unevaluated(module: PythonModule, node: ast.AST) -> bool:
    """Return whether a name is in an unevaluated annotation, or only for type checkers.

    Python never evaluates those of local variables, and those that are strings.
    """
    child = node
    is_text = isinstance(node, ast.Constant)
    for parent in module.parents(node):
        if is_text and _is_annotation(child, parent):
            return True
        is_local = isinstance(parent, ast.AnnAssign) and parent.annotation is child
        if is_local and module.enclosing_function(parent) is not None:
            return True
        if _is_never_evaluated(module, child, parent):
            return True
        child = parent
    return False


def _is_never_evaluated(module: PythonModule, node: ast.AST, parent: ast.AST) -> bool:
    """Return whether a node is for type checkers, or a postponed annotation."""
    match parent:
        case ast.If(test=ast.Name() | ast.Attribute() as test, body=body):
            return node in body and module.text(test).rpartition(".")[2] == "TYPE_CHECKING"
    return _is_annotation(node, parent) and any(
        item.module == "__future__" and any(name.name == "annotations" for name in item.names)
        for item in module.imports
    )


def _is_annotation(node: ast.AST, parent: ast.AST) -> bool:
    match parent:
        case ast.arg(annotation=written) | ast.AnnAssign(annotation=written):
            return written is node
        case ast.FunctionDef(returns=written) | ast.AsyncFunctionDef(returns=written):
            return written is node
    return False


def is_guarded_by(module: PythonModule, node: ast.AST, value: ast.expr) -> bool:
    """Return whether a node runs only if a condition on a value holds: ``if self.topic:``.

    Args:
        module: The file.
        node: The executed node.
        value: The expression; a condition is about it if it contains the same words.
    """
    words = ast.unparse(value)
    child = node
    for parent in module.parents(node):
        if (
            isinstance(parent, ast.If | ast.IfExp | ast.While)
            and child is not parent.test
            and words in module.words_of(parent.test)
        ):
            return True
        if isinstance(parent, ast.FunctionDef | ast.AsyncFunctionDef):
            return False
        child = parent
    return False


def caught_around(module: PythonModule, node: ast.AST) -> frozenset[str]:
    """Return the last parts of the names of exceptions caught around a node in its function."""
    result: set[str] = set()
    child = node
    for parent in module.parents(node):
        if isinstance(parent, ast.Try) and module.index.place(child)[0] == "body":
            for handler in parent.handlers:
                result |= last_names(handler.type) if handler.type else _ALL
        result |= _expected_in(parent, child)
        if isinstance(parent, ast.FunctionDef | ast.AsyncFunctionDef):
            break
        child = parent
    return frozenset(result)


class Condition(NamedTuple):
    """A condition, and its required value."""

    test: ast.expr
    needed: bool
    is_of_leaving: bool = False
    """Whether it is that of an earlier branch that leaves the block."""


def conditions_on(module: PythonModule, node: ast.AST) -> list[ast.expr]:
    """Return the conditions in its function that decide whether a node is run.

    Those of branches and loops around it, earlier operands of ``and``, and the conditions of
    earlier branches that leave.
    """
    result: list[ast.expr] = []
    child = node
    for parent in module.parents(node):
        result += (item.test for item in _conditions_of(module, child, parent))
        if isinstance(parent, ast.FunctionDef | ast.AsyncFunctionDef | ast.Lambda):
            break
        child = parent
    return result


def all_conditions(module: PythonModule, node: ast.AST) -> Iterator[Condition]:
    """Yield the conditions that decide whether a node is run, including those of skipped tests.

    Args:
        module: The file.
        node: The executed node; the conditions around its function are included.
    """
    child = node
    for parent in module.parents(node):
        yield from _conditions_of(module, child, parent)
        if isinstance(parent, ast.FunctionDef | ast.AsyncFunctionDef) and child in parent.body:
            for skip in skip_conditions(module, parent):
                yield Condition(skip.test, skip.needed)
        child = parent


def values_asked(module: PythonModule, test: ast.expr) -> list[ast.expr]:
    """Return the expressions that a condition depends on, through names and functions.

    The values of names and attributes in it, of functions of the file, and those
    behind them, as long as they are conditions themselves.

    Args:
        module: The file.
        test: The condition.
    """
    values: dict[ast.expr, None] = {}
    pending = [test]
    while pending:
        value = pending.pop()
        if value in values:
            continue
        values[value] = None
        if value is test or _is_question(value):
            for node in ast.walk(value):
                pending += _sources_of(module, node)
    return [*values]


def _is_question(value: ast.expr) -> bool:
    """Return whether an expression is a condition, or another name of one."""
    if isinstance(value, ast.Call):
        return not value.args and not value.keywords
    kinds = (ast.Compare, ast.BoolOp, ast.UnaryOp, ast.IfExp, ast.Name, ast.Attribute)
    return isinstance(value, kinds)


def _sources_of(module: PythonModule, node: ast.AST) -> Iterator[ast.expr]:
    """Yield the values of a name or an attribute, and those returned by a function."""
    match node:
        case ast.Name(id=name):
            lookup = module.index.lookup(name, node)
            bindings = lookup[1] if lookup else ()
        case ast.Attribute(value=ast.Name(id=owner), attr=name):
            is_own = owner in {"self", "cls"}
            if is_own:
                yield from _stored(module, name)
            defined = module.classes.get(owner)
            class_ = module.enclosing_class(node) if is_own else defined and defined.node
            bindings = module.index.bindings(class_).get(name, ()) if class_ else ()
        case _:
            return
    for binding in bindings:
        if binding.value is not None:
            yield binding.value
        if isinstance(binding.value, ast.Constant):
            yield from _choices(module, binding.value)
        if isinstance(binding.node, ast.FunctionDef):
            for item in module.below(binding.node, ast.Return):
                if item.value is not None:
                    yield item.value


def _choices(module: PythonModule, constant: ast.Constant) -> Iterator[ast.expr]:
    """Yield the condition that decides whether a name is set to a constant."""
    assignment = module.parent(constant)
    branch = module.parent(assignment) if assignment else None
    if isinstance(branch, ast.If):
        yield branch.test


def _stored(module: PythonModule, name: str) -> Iterator[ast.expr]:
    """Yield the values of an attribute of ``self``."""
    for store in module.index.attributes(name):
        match module.parent(store):
            case ast.Assign(targets=targets, value=value) if store in targets:
                yield value
            case ast.AnnAssign(target=target, value=ast.expr() as value) if store is target:
                yield value


def leaves_block(module: PythonModule, statement: ast.stmt) -> bool:
    """Return whether a statement always leaves its block."""
    match statement:
        case ast.Expr(value=ast.Call(func=func)):
            name = func.id if isinstance(func, ast.Name) else ""
            if isinstance(func, ast.Attribute) and module.text(func.value) == "self":
                return func.attr in _ENDING_METHODS
            return (module.qualified_name(func) or name) in _ENDING
    return isinstance(statement, _LEAVING)


def _conditions_of(module: PythonModule, child: ast.AST, parent: ast.AST) -> Iterator[Condition]:
    """Yield the conditions in a node that decide whether its child is run."""
    match parent:
        case ast.If(test=test) | ast.While(test=test) if child is not test:
            yield Condition(test, child in parent.body)
        case ast.IfExp(test=test) if child is not test:
            yield Condition(test, child is parent.body)
        case ast.BoolOp(op=op, values=values) if isinstance(child, ast.expr):
            for value in values[: values.index(child)]:
                yield Condition(value, isinstance(op, ast.And))
    yield from _left_before(module, child, parent)


def _left_before(module: PythonModule, child: ast.AST, parent: ast.AST) -> Iterator[Condition]:
    """Yield the conditions of earlier statements in the same block that may leave it."""
    if not isinstance(child, ast.stmt):
        return
    field, number = module.index.place(child)
    block = getattr(parent, field, None)
    for earlier in block[:number] if isinstance(block, list) else ():
        match earlier:
            case ast.If(test=test, body=[*_, last]) if leaves_block(module, last):
                yield Condition(test, needed=False, is_of_leaving=True)
            case ast.Expr(value=ast.Call() as call) | ast.Assign(value=ast.Call() as call):
                if module.qualified_name(call.func) == IMPORT_OR_SKIP:
                    yield Condition(call, needed=True, is_of_leaving=True)
