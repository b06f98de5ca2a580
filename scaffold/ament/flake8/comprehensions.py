"""C400 to C420: calls that a literal or a comprehension would replace.

flake8-comprehensions checks names and syntax only. ruff also checks that the name refers to the
builtin, and reports some findings at the argument instead of the call.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.ament import linters
from scaffold.ament.finding import Finding
from scaffold.ament.python_text.text import PythonText

_CASTS = {
    "set": {"list", "reversed", "sorted", "tuple", "set"},
    "sorted": {"list", "reversed", "sorted", "tuple"},
    "list": {"list", "tuple"},
    "tuple": {"list", "tuple"},
}
_SINCE = {"C417": (3, 9), "C418": (3, 10), "C419": (3, 10), "C420": (3, 16)}
"""The versions that added codes."""
_PAIR = 2
_Copy = ast.ListComp | ast.SetComp | ast.DictComp


def check(text: PythonText) -> Iterator[Finding]:
    """Yield the calls and comprehensions that can be written shorter."""
    unknown = _unknown_codes()
    for finding in _findings(text):
        if finding.code not in unknown:
            yield finding


def _unknown_codes() -> frozenset[str]:
    """Return the codes that the version on the target lacks."""
    target = linters.of_target()
    return frozenset(
        code
        for code, version in _SINCE.items()
        if not target.since("flake8-comprehensions", *version)
    )


def _findings(text: PythonText) -> Iterator[Finding]:
    inner_maps: set[ast.AST] = set()
    for call in text.nodes(ast.Call):
        if isinstance(call.func, ast.Name) and (code := _call(call, call.func.id, inner_maps)):
            yield _finding(text, code, call)
    copies: list[_Copy] = [
        *text.nodes(ast.ListComp),
        *text.nodes(ast.SetComp),
        *text.nodes(ast.DictComp),
    ]
    for copy in copies:
        if _copies(copy):
            yield _finding(text, "C416", copy)
        elif _repeats(copy):
            yield _finding(text, "C420", copy)


def _finding(text: PythonText, code: str, node: ast.expr) -> Finding:
    column = text.column(node.lineno, node.col_offset)
    end = node.end_lineno or node.lineno
    return Finding(code, node.lineno, column, "", end, text.column(end, node.end_col_offset or 0))


def _call(node: ast.Call, name: str, inner_maps: set[ast.AST]) -> str:
    """Return the code for a call of a name; empty if there is none."""
    if not node.args:
        return _empty_call(node, name)
    first = node.args[0]
    code = _of_one(node, name, first) if len(node.args) == 1 else ""
    return code or _nested_call(name, first) or _map_call(node, name, first, inner_maps)


def _nested_call(name: str, first: ast.expr) -> str:
    """Return the code for a repeated operation: sorting, copying, reversing."""
    if name in ("reversed", "set", "sorted") and _is_reversal(first):
        return "C415"
    if not isinstance(first, ast.Call) or not isinstance(first.func, ast.Name):
        return ""
    if name in ("list", "reversed") and first.func.id == "sorted":
        return "C413"
    return "C414" if first.func.id in _CASTS.get(name, ()) else ""


def _map_call(node: ast.Call, name: str, first: ast.expr, inner_maps: set[ast.AST]) -> str:
    """Return the code for ``map`` with a lambda, alone or inside a call that collects it."""
    if name == "map":
        return "C417" if node not in inner_maps and _maps_lambda(node) else ""
    if name not in ("list", "set", "dict") or len(node.args) != 1:
        return ""
    if not isinstance(first, ast.Call) or not _is_name(first.func, "map"):
        return ""
    if not _maps_lambda(first):
        return ""
    inner_maps.add(first)
    return "C417" if name != "dict" or _returns_pair(first.args[0]) else ""


def _empty_call(node: ast.Call, name: str) -> str:
    if name == "dict" and all(keyword.arg for keyword in node.keywords):
        return "C408"
    return "C408" if name in ("tuple", "list") and not node.keywords else ""


def _of_one(node: ast.Call, name: str, first: ast.expr) -> str:
    """Return the code for a call with one positional argument."""
    if isinstance(first, (ast.GeneratorExp, ast.ListComp)):
        is_list = isinstance(first, ast.ListComp)
        if name == "dict" and not node.keywords and _is_pair(first.elt):
            return "C404" if is_list else "C402"
        if is_list:
            codes = {"list": "C411", "set": "C403", "any": "C419", "all": "C419"}
        else:
            codes = {"list": "C400", "set": "C401"}
        return codes.get(name, "")
    if isinstance(first, (ast.Dict, ast.DictComp)):
        return "C418" if name == "dict" and not node.keywords else ""
    if isinstance(first, (ast.Tuple, ast.List)):
        if name == "dict":
            kind = (
                ast.Tuple
                if linters.of_target().since("flake8-comprehensions", 3, 9)
                else (ast.Tuple, ast.List)
            )
            pairs = all(isinstance(elt, kind) and len(elt.elts) == _PAIR for elt in first.elts)
            return "C406" if pairs else ""
        return {"tuple": "C409", "list": "C410", "set": "C405"}.get(name, "")
    return ""


def _is_pair(node: ast.expr) -> bool:
    return isinstance(node, ast.Tuple) and len(node.elts) == len(("key", "value"))


def _is_name(node: ast.expr, name: str) -> bool:
    return isinstance(node, ast.Name) and node.id == name


def _maps_lambda(node: ast.Call) -> bool:
    return len(node.args) == len(("function", "values")) and isinstance(node.args[0], ast.Lambda)


def _returns_pair(node: ast.expr) -> bool:
    body = node.body if isinstance(node, ast.Lambda) else node
    return isinstance(body, (ast.List, ast.Tuple)) and len(body.elts) == len(("key", "value"))


def _is_reversal(node: ast.expr) -> bool:
    if not isinstance(node, ast.Subscript) or not isinstance(node.slice, ast.Slice):
        return False
    part = node.slice
    return part.lower is None and part.upper is None and _is_minus_one(part.step)


def _is_minus_one(node: ast.expr | None) -> bool:
    return (
        isinstance(node, ast.UnaryOp)
        and isinstance(node.op, ast.USub)
        and isinstance(node.operand, ast.Constant)
        and node.operand.value == 1
    )


def _copies(node: _Copy) -> bool:
    """Return whether a comprehension yields its unchanged items."""
    if len(node.generators) != 1 or node.generators[0].ifs or node.generators[0].is_async:
        return False
    target = node.generators[0].target
    if isinstance(node, ast.DictComp):
        if not linters.of_target().since("flake8-comprehensions", 3, 9):
            return False
        if not _is_pair(target) or not isinstance(target, ast.Tuple):
            return False
        return _same_name(node.key, target.elts[0]) and _same_name(node.value, target.elts[1])
    return _same_name(node.elt, target)


def _repeats(node: _Copy) -> bool:
    """Return whether a comprehension maps all keys to the same constant."""
    if not isinstance(node, ast.DictComp) or len(node.generators) != 1:
        return False
    (generator,) = node.generators
    is_plain = not generator.ifs and not generator.is_async
    return (
        is_plain and isinstance(node.value, ast.Constant) and _same_name(node.key, generator.target)
    )


def _same_name(node: ast.expr, two: ast.expr) -> bool:
    return isinstance(node, ast.Name) and isinstance(two, ast.Name) and node.id == two.id
