"""String literals as written: Python joins adjacent ones."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator, Sequence

from scaffold.model.python.module import PythonModule

_LITERAL = (
    r"(?s)[rRbBuUfF]{0,2}(?:\"\"\"(?:\\.|[^\\])*?\"\"\"|'''(?:\\.|[^\\])*?'''"
    r"|\"(?:\\.|[^\"\\])*\"|'(?:\\.|[^'\\])*')"
)
_NAME = r"(?a)/?\w[\w./-]*"
_LINE = 79
"""The line length up to which a string need not be split."""


def string_pieces(module: PythonModule, node: ast.expr) -> Iterator[tuple[int, int]]:
    """Yield the spans of the string literals that make up one string expression."""
    start, end = module.span(node)
    text = module.source.text
    literal = re.compile(_LITERAL)
    at = start
    while at < end:
        matched = literal.match(text, at, end)
        if matched:
            yield matched.span()
            at = matched.end()
        elif text[at] == "#":
            newline = text.find("\n", at, end)
            at = end if newline < 0 else newline
        else:
            at += 1


def joined_names(module: PythonModule, node: ast.expr) -> Sequence[str]:
    """Return names joined by a missing comma: ``['left' 'right']``.

    Strings with spaces, parts of paths, and long strings are split on purpose.
    """
    if not isinstance(node, ast.Constant) or not isinstance(node.value, str):
        return ()
    if node.col_offset + len(node.value) + len("'',") > _LINE:
        return ()
    pieces = [module.source.text[start:end] for start, end in string_pieces(module, node)]
    names = [str(ast.literal_eval(piece)) for piece in pieces]
    are_names = all(re.fullmatch(_NAME, name) and name[-1].isalnum() for name in names)
    are_alike = len({name.startswith("/") for name in names}) == 1
    return names if len(names) > 1 and are_names and are_alike else ()
