"""Branches of a Python file that do not run on the target distribution.

Conditions on the Python version are evaluated as well, as the distribution determines it.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator, Sequence
from itertools import chain

from scaffold.model.python.conditions.distribution_conditions import ASKED, holds, text_on_target
from scaffold.model.python.conditions.guards import leaves_block
from scaffold.model.python.conditions.skips import skip_conditions
from scaffold.model.python.module import PythonModule
from scaffold.source import Location

Stretch = tuple[int, int, int, int]
"""Line and column of the start and of the end, as in a location."""


def stretches_not_run(module: PythonModule) -> Iterator[Stretch]:
    """Yield the ranges of code that does not run on the target distribution."""
    if not module.mentions(*ASKED):
        return
    for first, last in chain(_skipped_branches(module), _dead_parts(module), _skipped(module)):
        start, end = module.location(first), module.location(last)
        if isinstance(first, ast.expr):
            yield start.line, start.column, end.end_line, end.end_column
            continue
        # With the whitespace around the statements of a block, for style findings.
        before = module.source.lines[start.line - 1][: start.column - 1]
        yield start.line, start.column if before.strip() else 0, end.end_line + 1, 0


def is_run(module: PythonModule, at: Location) -> bool:
    """Return whether a place may run on the target, judging by conditions on the distribution."""
    place = (at.line, at.column)
    return not any(item[:2] <= place < item[2:] for item in stretches_not_run(module))


def _skipped_branches(module: PythonModule) -> Iterator[tuple[ast.AST, ast.AST]]:
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
    for claim in module.walk(ast.Assert):
        if holds(module, claim.test) is False:
            yield from _left_out(module, claim)


def _dead_parts(module: PythonModule) -> Iterator[tuple[ast.AST, ast.AST]]:
    """Yield those of conditional expressions and of ``match``."""
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


def _left_out(module: PythonModule, node: ast.stmt) -> Iterator[tuple[ast.AST, ast.AST]]:
    """Yield the statements after one that leaves its block on the target."""
    if not _leaves_block(module, node):
        return
    field, number = module.index.place(node)
    block = getattr(module.index.parent(node), field, None)
    if isinstance(block, list) and block[number + 1 :]:
        yield block[number + 1], block[-1]


def _leaves_block(module: PythonModule, statement: ast.stmt) -> bool:
    """Return whether a statement leaves its block on the target."""
    if isinstance(statement, ast.If):
        decided = holds(module, statement.test)
        branches = [statement.body, statement.orelse]
        if decided is not None:
            branches = [statement.body if decided else statement.orelse]
        return all(branch and _leaves_block(module, branch[-1]) for branch in branches)
    if isinstance(statement, ast.Assert):
        return holds(module, statement.test) is False
    return leaves_block(module, statement)


def _skipped(module: PythonModule) -> Iterator[tuple[ast.AST, ast.AST]]:
    """Yield the bodies of skipped tests."""
    for function in module.function_nodes:
        conditions = skip_conditions(module, function)
        if any(holds(module, item.test) is (not item.needed) for item in conditions):
            yield function.body[0], function.body[-1]


def cases(module: PythonModule, choice: ast.Match) -> Sequence[bool | None]:
    """Return which cases of a ``match`` run on the target; ``None`` where unknown."""
    value = text_on_target(module, choice.subject)
    if value is None:
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
            parts = [_matched(item, value) for item in patterns]
            return True if True in parts else None if None in parts else False
        case ast.MatchAs(pattern=None):
            return True
        case ast.MatchAs(pattern=ast.pattern() as inner):
            return _matched(inner, value)
    return None
