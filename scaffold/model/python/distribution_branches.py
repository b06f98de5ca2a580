"""Branches of a Python file that are for other distributions: they ask for ROS_DISTRO."""

from __future__ import annotations

import ast
import operator
from collections.abc import Callable, Iterator, Mapping, Sequence
from itertools import chain

from scaffold.distributions import VARIABLE, target
from scaffold.model.python.evaluator import Evaluator
from scaffold.model.python.guards import LEAVING
from scaffold.model.python.module import PythonModule
from scaffold.model.python.values import UNKNOWN, is_known

_GETTERS = frozenset({"os.environ.get", "os.getenv"})
_ENDERS = frozenset({"sys.exit", "exit", "quit", "os._exit"})
_COMPARISONS: Mapping[type[ast.cmpop], Callable[[str, str], bool]] = {
    ast.Lt: operator.lt,
    ast.LtE: operator.le,
    ast.Gt: operator.gt,
    ast.GtE: operator.ge,
}
_DEEPEST = 20
"""The most names that a condition is followed through."""

Stretch = tuple[int, int, int, int]
"""Line and column of the start and of the end, as in a location."""


def stretches_not_run(module: PythonModule) -> Iterator[Stretch]:
    """Yield the places of what does not run on the target distribution."""
    for first, last in chain(_dead(module), _dead_parts(module)):
        start, end = module.location(first), module.location(last)
        if isinstance(first, ast.expr):
            yield start.line, start.column, end.end_line, end.end_column
            continue
        # With what is around the statements of a block, for findings of style.
        before = module.source.lines[start.line - 1][: start.column - 1]
        yield start.line, start.column if before.strip() else 0, end.end_line + 1, 0


def holds(module: PythonModule, test: ast.expr, depth: int = 0) -> bool | None:
    """Return whether a condition is true on the target; ``None`` if that is not known.

    Args:
        module: The file.
        test: The condition.
        depth: The names that it was followed through.
    """
    match test:
        case ast.UnaryOp(op=ast.Not(), operand=operand):
            inner = holds(module, operand, depth)
            return None if inner is None else not inner
        case ast.BoolOp(op=op, values=values):
            deciding = isinstance(op, ast.Or)
            parts = {holds(module, value, depth) for value in values}
            if deciding in parts:
                return deciding
            return None if None in parts else not deciding
    value, notes = _DistributionEvaluator(module).trace(test)
    if VARIABLE in notes and is_known(value):
        return bool(value)
    if isinstance(test, ast.Name) and depth < _DEEPEST:
        found = module.index.lookup(test.id, test)
        bindings = found[1] if found else ()
        if len(bindings) == 1 and bindings[0].kind == "assignment" and bindings[0].value:
            return holds(module, bindings[0].value, depth + 1)
    return None


def is_unsure(module: PythonModule, test: ast.expr) -> bool:
    """Tell whether a condition asks for the distribution in a way that cannot be decided."""
    return asks(module, test) and holds(module, test) is None


def asks(module: PythonModule, value: ast.expr) -> bool:
    """Tell whether the distribution decides what an expression is worth."""
    if VARIABLE not in module.source.text:
        return False
    evaluator = _DistributionEvaluator(module)
    return any(
        VARIABLE in evaluator.trace(node)[1]
        for node in ast.walk(value)
        if isinstance(node, ast.expr)
    )


class _DistributionEvaluator(Evaluator):
    """Knows the variable ROS_DISTRO, and notes where a value comes from it."""

    def call(self, node: ast.Call) -> object:
        """Return the value of the variable, or what a method says of a text."""
        match node:
            case ast.Call(func=func, args=[ast.Constant(value=key), *_]) if (
                key == VARIABLE and self.module.qualified_name(func) in _GETTERS
            ):
                return self._asked()
            case ast.Call(
                func=ast.Attribute(attr="startswith" | "endswith" as method, value=holder),
                args=[argument],
                keywords=[],
            ):
                text, part = self.evaluate(holder), self.evaluate(argument)
                parts = part if isinstance(part, tuple) else (part,)
                words = [item for item in parts if isinstance(item, str)]
                if isinstance(text, str) and len(words) == len(parts):
                    begins = method == "startswith"
                    return any(
                        text.startswith(word) if begins else text.endswith(word) for word in words
                    )
            case ast.Call(func=ast.Name(id=name), args=[], keywords=[]):
                return self._returned(name, node.func)
        for argument in node.args:
            self.evaluate(argument)  # for its notes
        return UNKNOWN

    def _returned(self, name: str, at: ast.expr) -> object:
        """Return what a function of the file without arguments does, if that is all that it is."""
        found = self.module.index.lookup(name, at)
        match [item.node for item in (found[1] if found else ())]:
            case [ast.FunctionDef(body=[*_, ast.Return(value=value)] as body, decorator_list=[])]:
                is_all = all(isinstance(one, ast.Expr) for one in body[:-1])
                return self.evaluate(value) if is_all else UNKNOWN
        return UNKNOWN

    def attribute(self, node: ast.Attribute) -> object:
        """Return the value of an attribute of ``self`` that is set once."""
        index = self.module.index
        class_ = next((one for one in index.parents(node) if isinstance(one, ast.ClassDef)), None)
        if class_ is None or not isinstance(node.value, ast.Name) or node.value.id != "self":
            return UNKNOWN
        values = [binding.value for binding in index.bindings(class_).get(node.attr, ())]
        for store in index.attributes(node.attr):
            if not isinstance(store.ctx, ast.Load):
                above = index.parent(store)
                values.append(above.value if isinstance(above, ast.Assign) else None)
        known = [self.evaluate(value) for value in values]  # each has notes
        return known[0] if len(known) == 1 else UNKNOWN

    def _asked(self) -> str:
        self.note(VARIABLE)
        return target().name

    def _subscript(self, node: ast.Subscript) -> object:
        match node:
            case ast.Subscript(value=value, slice=ast.Constant(value=key)) if key == VARIABLE:
                if self.module.qualified_name(value) == "os.environ":
                    return self._asked()
        return super()._subscript(node)

    def _comparison(self, node: ast.Compare) -> object:
        match node:
            case ast.Compare(
                left=ast.Constant(value=word), ops=[ast.In() | ast.NotIn() as op], comparators=[of]
            ) if word == VARIABLE and self.module.qualified_name(of) == "os.environ":
                self.note(VARIABLE)
                return isinstance(op, ast.In)
            case ast.Compare(left=left, ops=[ast.In() | ast.NotIn() as op], comparators=[of]):
                return self._contained(self.evaluate(left), op, self.evaluate(of))
            case ast.Compare(left=left, ops=[op], comparators=[right]) if type(op) in _COMPARISONS:
                first, second = self.evaluate(left), self.evaluate(right)
                if isinstance(first, str) and isinstance(second, str):
                    return _COMPARISONS[type(op)](first, second)
                return UNKNOWN
        return super()._comparison(node)

    def _contained(self, item: object, op: ast.cmpop, holder: object) -> object:
        if not isinstance(item, str) or not isinstance(holder, str | tuple | list | set | dict):
            return UNKNOWN
        if not isinstance(holder, str) and not all(isinstance(one, str) for one in holder):
            return UNKNOWN
        return (item in holder) == isinstance(op, ast.In)


def _dead(module: PythonModule) -> Iterator[tuple[ast.AST, ast.AST]]:
    """Yield the first and last nodes of branches that do not run."""
    branches: list[ast.If | ast.While | ast.IfExp] = [*module.walk(ast.If), *module.walk(ast.While)]
    for node in (*branches, *module.walk(ast.IfExp)):
        decided = holds(module, node.test)
        dead = () if decided is None else node.orelse if decided else node.body
        if isinstance(dead, ast.expr):
            yield dead, dead
        elif dead:
            yield dead[0], dead[-1]
        if isinstance(node, ast.If) and decided is not None:
            yield from _left_out(module, node)


def _dead_parts(module: PythonModule) -> Iterator[tuple[ast.AST, ast.AST]]:
    """Yield the same of conditions without branches, and of ``match``."""
    for both in module.walk(ast.BoolOp):
        ending = isinstance(both.op, ast.Or)
        for at, value in enumerate(both.values[:-1], 1):
            if holds(module, value) is ending:
                yield both.values[at], both.values[-1]
                break
    for choice in module.walk(ast.Match):
        for case, runs in zip(choice.cases, cases(module, choice), strict=True):
            if runs is False:
                yield case.body[0], case.body[-1]


def _left_out(module: PythonModule, node: ast.If) -> Iterator[tuple[ast.AST, ast.AST]]:
    """Yield what follows an ``if`` that is left on the target."""
    if not _leaves(module, node):
        return
    field, number = module.index.place(node)
    block = getattr(module.index.parent(node), field, None)
    if isinstance(block, list) and block[number + 1 :]:
        yield block[number + 1], block[-1]


def _leaves(module: PythonModule, statement: ast.stmt) -> bool:
    """Tell whether what follows a statement in its block is not reached on the target."""
    match statement:
        case ast.If(test=test, body=body, orelse=orelse):
            decided = holds(module, test)
            branches = [body, orelse] if decided is None else [body if decided else orelse]
            return all(branch and _leaves(module, branch[-1]) for branch in branches)
        case ast.Expr(value=ast.Call(func=func)):
            name = func.id if isinstance(func, ast.Name) else ""
            return (module.qualified_name(func) or name) in _ENDERS
    return isinstance(statement, LEAVING)


def cases(module: PythonModule, choice: ast.Match) -> Sequence[bool | None]:
    """Return which cases of a ``match`` run on the target; ``None`` where that is not known."""
    value, notes = _DistributionEvaluator(module).trace(choice.subject)
    if VARIABLE not in notes or not isinstance(value, str):
        return [None] * len(choice.cases)
    result: list[bool | None] = []
    is_over: bool | None = False
    for case in choice.cases:
        matched = _matched(case.pattern, value)
        if matched and case.guard is not None:
            matched = holds(module, case.guard)
        if is_over or matched is False:
            result.append(False)
            continue
        result.append(None if is_over is None else matched)
        is_over = True if matched else None
    return result


def _matched(pattern: ast.pattern, value: str) -> bool | None:
    match pattern:
        case ast.MatchValue(value=ast.Constant(value=word)):
            return bool(word == value)
        case ast.MatchOr(patterns=patterns):
            parts = [_matched(one, value) for one in patterns]
            return True if True in parts else None if None in parts else False
        case ast.MatchAs(pattern=None):
            return True
        case ast.MatchAs(pattern=ast.pattern() as inner):
            return _matched(inner, value)
    return None
