"""Places and edits of the keyword arguments of setup()."""

from __future__ import annotations

import ast
from typing import TYPE_CHECKING

from scaffold.check.diagnostic import Edit

if TYPE_CHECKING:
    from scaffold.model.setup_py import Keyword, SetupPy


def literal_span(setup: SetupPy, keyword: Keyword) -> tuple[int, int]:
    """Return the offsets of the literal of a keyword: through ``name=package_name``, too."""
    node: ast.expr = keyword.node
    if isinstance(node, ast.Name):
        found = setup.module.index.lookup(node.id, node)
        bindings = found[1] if found else ()
        if len(bindings) == 1 and isinstance(bindings[0].value, ast.Constant):
            node = bindings[0].value
    return setup.module.span(node)


def span(setup: SetupPy, name: str) -> tuple[int, int] | None:
    """Return the offsets of ``name=value`` in the call; ``None`` if it stands elsewhere."""
    for word in setup.call.keywords if setup.call else ():
        if word.arg == name:
            return setup.module.span(word)
    return None


def insert(setup: SetupPy, text: str) -> Edit | None:
    """Return the edit that adds a keyword on a line of its own, in front of ``entry_points``.

    ``None`` for a call that is not written with one keyword per line.
    """
    words = [word for word in setup.call.keywords if word.arg] if setup.call else []
    if not words:
        return None
    before = next((word for word in words if word.arg == "entry_points"), None)
    source = setup.module.source
    start, end = setup.module.span(before or words[-1])
    line, column = source.position(start)
    indent = source.lines[line - 1][: column - 1]
    if indent.strip():
        return None
    if before is not None:
        return Edit(source.path, start, start, f"{text},{source.newline}{indent}")
    comma = source.text[end:].lstrip()[:1] == ","
    end = source.text.index(",", end) + 1 if comma else end
    lead = "" if comma else ","
    return Edit(source.path, end, end, f"{lead}{source.newline}{indent}{text},")
