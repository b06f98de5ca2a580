"""The values that the names in a helper function or in a loop of a launch file take."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Mapping, Sequence
from itertools import islice
from typing import TYPE_CHECKING

from scaffold.model.python.evaluation.given_arguments import given_argument
from scaffold.model.python.evaluation.values import UNKNOWN
from scaffold.record import NamedTuple

if TYPE_CHECKING:
    from scaffold.model.launch.evaluation.evaluator import LaunchEvaluator
    from scaffold.model.python.module import PythonModule

_MOST = 50
"""The maximum number of cases; of more, only these are known."""
_MOST_FRAMES = 5
"""The maximum number of functions and loops around an expression."""

Name = tuple[ast.AST, str]
"""The scope and the name of a variable."""


class Case(NamedTuple):
    """One call of the functions, and one turn of the loops, around an expression."""

    values: Mapping[Name, object]
    places: Mapping[Name, ast.expr]
    """The expressions that give the values."""

    def place(self, module: PythonModule, node: ast.expr) -> ast.expr:
        """Return what gives an expression its value here: the last of the names in it."""
        names = [part for part in ast.walk(node) if isinstance(part, ast.Name)]
        keys = [key_of(module, name) for name in names]
        places = [self.places[key] for key in keys if key is not None and key in self.places]
        return places[-1] if places else node


def key_of(module: PythonModule, name: ast.Name) -> Name | None:
    """Return the variable that a name refers to; ``None`` if it has several values in a scope."""
    lookup = module.index.lookup(name.id, name)
    return (lookup[0], name.id) if lookup is not None and len(lookup[1]) == 1 else None


def cases(evaluator: LaunchEvaluator, node: ast.AST, depth: int = 0) -> Sequence[Case]:
    """Return the known cases of an expression; none if no function or loop is around it."""
    frame = innermost_frame(evaluator.module, node)
    if frame is None or depth >= _MOST_FRAMES:
        return ()
    return [*islice(_cases_of(evaluator, frame, depth), _MOST)]


def innermost_frame(module: PythonModule, node: ast.AST) -> ast.AST | None:
    """Return the function or loop around an expression in which it has several values."""
    inner = node
    for parent in module.parents(node):
        is_frame = isinstance(parent, ast.For | ast.FunctionDef | ast.ListComp | ast.GeneratorExp)
        if is_frame and not _is_header(parent, inner):
            return parent
        inner = parent
    return None


def _is_header(frame: ast.AST, inner: ast.AST) -> bool:
    """Return whether an expression is evaluated before a loop or function begins."""
    match frame:
        case ast.For():
            return inner is frame.iter
        case ast.FunctionDef():
            return inner not in frame.body
        case ast.ListComp() | ast.GeneratorExp():
            return inner is frame.generators[0]
    return True


def _cases_of(evaluator: LaunchEvaluator, frame: ast.AST, depth: int) -> Iterator[Case]:
    match frame:
        case ast.FunctionDef():
            yield from _calls_of(evaluator, frame, depth)
            return
        case ast.For(target=target, iter=iterable):
            scope = None
        case ast.ListComp(generators=[loop]) | ast.GeneratorExp(generators=[loop]):
            if loop.ifs:
                return
            target, iterable, scope = loop.target, loop.iter, frame
        case _:
            return
    for outer in cases(evaluator, frame, depth + 1) or (Case({}, {}),):
        with evaluator.bound(outer.values):
            for item, value in _turns(evaluator, iterable):
                yield _with(evaluator, outer, _bound(evaluator, target, item, value), scope)


def _calls_of(evaluator: LaunchEvaluator, function: ast.FunctionDef, depth: int) -> Iterator[Case]:
    """Yield a case for each call of a function, if all its uses are calls."""
    module = evaluator.module
    uses = [name for name in module.index.names(function.name) if isinstance(name.ctx, ast.Load)]
    calls = [module.parent(use) for use in uses]
    if function.decorator_list or function.args.vararg is not None:
        return
    signature = function.args
    parameters = [*signature.posonlyargs, *signature.args, *signature.kwonlyargs]
    for use, call in zip(uses, calls, strict=True):
        if not isinstance(call, ast.Call) or call.func is not use:
            return
    for call in calls:
        if not isinstance(call, ast.Call) or any(word.arg is None for word in call.keywords):
            continue
        for outer in cases(evaluator, call, depth + 1) or (Case({}, {}),):
            values, places = {**outer.values}, {**outer.places}
            with evaluator.bound(outer.values):
                for parameter in parameters:
                    given = given_argument(function, call, parameter, is_method=False)
                    values[function, parameter.arg] = evaluator.evaluate(given)
                    if given is not None:
                        places[function, parameter.arg] = outer.place(module, given)
                if signature.kwarg is not None:
                    known = {parameter.arg for parameter in parameters}
                    key = (function, signature.kwarg.arg)
                    values[key] = {
                        str(word.arg): evaluator.evaluate(word.value)
                        for word in call.keywords
                        if word.arg not in known
                    }
                    places[key] = call
            yield Case(values, places)


def _turns(evaluator: LaunchEvaluator, iterable: ast.expr) -> Iterator[tuple[ast.expr, object]]:
    """Yield the items that a loop runs through: where they are written, and their values."""
    match iterable:
        case ast.Call(func=ast.Attribute(value=holder, attr="items"), args=[]):
            literal = evaluator.module.index.only_value(holder) or holder
            if isinstance(literal, ast.Dict) and isinstance(evaluator.evaluate(holder), dict):
                for key, value in zip(literal.keys, literal.values, strict=True):
                    if key is not None:
                        pair = ast.Tuple([key, value], ast.Load())
                        yield pair, (evaluator.evaluate(key), evaluator.evaluate(value))
            return
    elements = evaluator.elements(iterable)
    if elements.complete:
        for item in elements.items:
            yield item.node, item.value


def _bound(
    evaluator: LaunchEvaluator, target: ast.expr, item: ast.expr, value: object
) -> Iterator[tuple[ast.Name, ast.expr, object]]:
    """Yield the names in the target of a loop, with what they are in one turn."""
    match target, item:
        case ast.Name(), _:
            yield target, item, value
        case (ast.Tuple(elts=names), ast.Tuple(elts=items) | ast.List(elts=items)) if len(
            names
        ) == len(items):
            for name, part in zip(names, items, strict=True):
                yield from _bound(evaluator, name, part, evaluator.evaluate(part))
        case ast.Tuple(elts=names), _:
            parts = value if isinstance(value, list | tuple) else ()
            for number, name in enumerate(names):
                yield from _bound(
                    evaluator, name, item, parts[number] if number < len(parts) else UNKNOWN
                )


def _with(
    evaluator: LaunchEvaluator,
    outer: Case,
    names: Iterator[tuple[ast.Name, ast.expr, object]],
    scope: ast.AST | None,
) -> Case:
    values, places = {**outer.values}, {**outer.places}
    for name, place, value in names:
        key = (scope, name.id) if scope is not None else key_of(evaluator.module, name)
        if key is not None:
            values[key] = value
            places[key] = place
    return Case(values, places)
