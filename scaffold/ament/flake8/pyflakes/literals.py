"""F541, F601, F602: f-strings without placeholders, keys given twice, placed as pyflakes does."""

from __future__ import annotations

import ast
from collections import Counter
from collections.abc import Hashable, Iterator

from scaffold.ament.finding import Finding
from scaffold.ament.python_text.text import PythonText


def check(text: PythonText) -> Iterator[Finding]:
    """Yield what is wrong with f-strings and dict literals."""
    for node in text.nodes(ast.JoinedStr):
        has_placeholder = any(isinstance(value, ast.FormattedValue) for value in node.values)
        # Formats within an f-string are f-strings to ``ast``.
        if not has_placeholder and not any(
            isinstance(parent, ast.JoinedStr) for parent in text.parents(node)
        ):
            yield _finding(text, "F541", node, "an f-string without placeholders")
    for literal in text.nodes(ast.Dict):
        yield from _repeated(text, literal)


def _repeated(text: PythonText, node: ast.Dict) -> Iterator[Finding]:
    keys = [_value(key) for key in node.keys]
    counts = Counter(keys)
    if len(counts) == len(keys):
        return
    for key, count in counts.items():
        if count == 1:
            continue
        places = [at for at, item in enumerate(keys) if item == key]
        values = Counter(_value(node.values[at]) for at in places)
        if 1 not in values.values():
            continue
        for at in places:
            place = node.keys[at]
            if place is not None:
                code = "F602" if isinstance(place, ast.Name) else "F601"
                message = f"the key {ast.unparse(place)} is given {count} times with other values"
                yield _finding(text, code, place, message)


def _value(node: ast.expr | None) -> Hashable:
    """Return something that is equal for nodes that certainly have the same value."""
    if isinstance(node, ast.Constant):
        # 1, 1.0 and True are the same key; b'' and '' are not.
        return ("constant", isinstance(node.value, bytes), node.value)
    if isinstance(node, ast.Tuple):
        return ("tuple", *(_value(elt) for elt in node.elts))
    if isinstance(node, ast.Name):
        return ("name", node.id)
    return ("other", id(node))


def _finding(text: PythonText, code: str, node: ast.expr, message: str) -> Finding:
    return Finding(code, node.lineno, text.column(node.lineno, node.col_offset), message)
