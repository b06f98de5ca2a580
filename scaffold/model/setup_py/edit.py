"""Edits of setup.py that keep comments, formatting and everything else."""

from __future__ import annotations

import ast
import sys
from collections.abc import Sequence
from typing import TYPE_CHECKING

from scaffold.edits import Edit
from scaffold.model.python.module import PythonModule
from scaffold.model.setup_py.setup_py import SetupPy
from scaffold.record import NamedTuple

if TYPE_CHECKING:
    from scaffold.model.setup_py.keywords import Keyword


MAX_LINE = 99
"""The maximum line length of ament_flake8."""

_STEP = "    "


def add_console_script(setup: SetupPy, name: str, target: str) -> Edit | None:
    """Return the edit that adds ``name = target`` to the console scripts.

    ``None`` if an executable of that name exists already, or if no place is safe: an unknown
    entry point, keywords from elsewhere.
    """
    if setup.call is None or not setup.entry_points_complete:
        return None
    if any(point.name == name for point in setup.console_scripts):
        return None
    quote = quote_of(setup)
    texts = [point.text for point in setup.console_scripts if "=" in point.text]
    equals = "=" if texts and not any(" = " in text for text in texts) else " = "
    entry = Text(quote, f"{name}{equals}", target)
    group = Block(f"{quote}console_scripts{quote}: [", "]", (entry,))
    word = setup.keyword("entry_points")
    if word is None:
        return _add_keyword(setup, "entry_points", Block("{", "}", (group,)))
    points = _resolved(setup.module, word.node)
    return _add_to_group(setup, points, entry, group) if isinstance(points, ast.Dict) else None


def _add_to_group(setup: SetupPy, points: ast.Dict, entry: Text, group: Block) -> Edit | None:
    for key, value in zip(points.keys, points.values, strict=True):
        if setup.evaluator.evaluate(key) == "console_scripts":
            scripts = _list_to_extend(setup.module, value)
            return append_item(setup.module, scripts, scripts.elts, entry) if scripts else None
    return None if None in points.keys else append_item(setup.module, points, points.values, group)


def add_data_files(setup: SetupPy, destination: str, sources: str) -> Edit | None:
    """Return the edit that adds ``(destination, sources)`` to data_files.

    Both are Python expressions: ``"'share/' + package_name"`` and ``"['package.xml']"``. What
    they use must be imported; see ``add_import``. ``None`` if no place is safe.
    """
    if setup.call is None:
        return None
    entry = f"({destination}, {sources})"
    word = setup.keyword("data_files")
    if word is None:
        return (
            None
            if setup.has_unknown_keywords
            else _add_keyword(setup, "data_files", Block("[", "]", (entry,)))
        )
    files = _list_to_extend(setup.module, word.node)
    return append_item(setup.module, files, files.elts, entry) if files else None


def package_expression(setup: SetupPy, name: str) -> str | None:
    """Return the variable of setup.py with the package name: ``package_name``."""
    for variable, bindings in setup.module.index.bindings(setup.module.tree).items():
        values = [setup.evaluator.evaluate(binding.value) for binding in bindings]
        if values == [name]:
            return variable
    return None


def add_import(module: PythonModule, statement: str) -> Edit | None:
    """Return the edit that adds an import of the standard library; ``None`` if it exists.

    The place follows ament_flake8: the standard library first, by module name.
    """
    added = ast.parse(statement).body[0]
    key = _import_key(added)
    first: ast.Import | ast.ImportFrom | None = None
    before: ast.Import | ast.ImportFrom | None = None
    for node in module.tree.body:
        if not isinstance(node, ast.Import | ast.ImportFrom):
            continue
        if ast.dump(node) == ast.dump(added):
            return None
        first = first or node
        if _is_standard(node) and _import_key(node) < key:
            before = node
    newline = module.source.newline
    if before is not None:
        end = _line_end(module, module.span(before)[1])
        return Edit(module.path, end, end, f"{newline}{statement}")
    if first is not None:
        start = module.span(first)[0]
        gap = newline if _is_standard(first) else newline * 2
        return Edit(module.path, start, start, f"{statement}{gap}")
    at = _after_docstring(module)
    return Edit(module.path, at, at, f"{statement}{newline * 2}")


# -- inserted text


class Text(NamedTuple):
    """A string, split into two adjacent literals if one would be too long."""

    quote: str
    start: str
    end: str

    def render(self, indent: str, newline: str) -> str:
        """Return the text; its first line is not indented, the other by ``indent``."""
        whole = f"{self.quote}{self.start}{self.end}{self.quote}"
        if len(f"{indent}{whole},") <= MAX_LINE:
            return whole
        parts = (f"{self.quote}{part}{self.quote}" for part in (self.start, self.end))
        return f"{newline}{indent}".join(parts)


class Block(NamedTuple):
    """Text that spans several lines: items between an opening and a closing bracket."""

    opening: str
    closing: str
    items: tuple[str | Block | Text, ...]

    def render(self, indent: str, newline: str) -> str:
        """Return the text; its first line is not indented, the others by ``indent``."""
        inner = indent + _STEP
        lines = [f"{inner}{_render(item, inner, newline)}," for item in self.items]
        return newline.join([self.opening, *lines, f"{indent}{self.closing}"])


def _render(item: str | Block | Text, indent: str, newline: str) -> str:
    return item if isinstance(item, str) else item.render(indent, newline)


def quote_of(setup: SetupPy) -> str:
    """Return the quote used for the entry points, or else for other strings."""
    nodes = [point.node for point in setup.entry_points]
    nodes += [word.node for word in setup.keywords.values()]
    for node in nodes:
        text = setup.module.text(node)
        if text[:1] in {"'", '"'}:
            return text[0]
    return "'"


# -- places


def _resolved(module: PythonModule, node: ast.expr) -> ast.expr:
    """Return the only value assigned to a name, else the expression itself."""
    if isinstance(node, ast.Name):
        lookup = module.index.lookup(node.id, node)
        if lookup and len(lookup[1]) == 1 and lookup[1][0].value is not None:
            return lookup[1][0].value
    return node


def _list_to_extend(module: PythonModule, node: ast.expr) -> ast.List | None:
    """Return the list literal that an expression is or ends with."""
    node = _resolved(module, node)
    if isinstance(node, ast.BinOp) and isinstance(node.op, ast.Add):
        return _list_to_extend(module, node.right) or _list_to_extend(module, node.left)
    return node if isinstance(node, ast.List) else None


def _add_keyword(setup: SetupPy, name: str, value: Block) -> Edit | None:
    call = setup.call
    if call is None or setup.has_unknown_keywords:
        return None
    block = Block(f"{name}={value.opening}", value.closing, value.items)
    items = [*call.args, *(word.value for word in call.keywords)]
    return append_item(setup.module, call, items, block)


def append_item(
    module: PythonModule, holder: ast.expr, items: Sequence[ast.expr], item: str | Block | Text
) -> Edit:
    """Return the edit that adds an item after the last one inside brackets."""
    text, newline = module.source.text, module.source.newline
    close = module.span(holder)[1] - 1
    if not items:
        return _fill(module, holder, close, item)
    last = max(items, key=lambda node: module.span(node)[1])
    end = _past_parentheses(module, module.span(last)[1], close)
    comma = _comma(text, end, close)
    at = end if comma is None else comma + 1
    start = _first_column(module, items)
    if "\n" not in text[at:close] and start is None:
        glue = " " if comma is not None else ", "
        rendered = _render(item, _indent(text, at), newline)
        if len(_line(text, at)) + len(glue) + len(rendered.partition(newline)[0]) > MAX_LINE:
            column = min(module.span(node)[0] for node in items)
            indent = " " * (column - text.rfind("\n", 0, column) - 1)
            glue = f"{glue.rstrip()}{newline}{indent}"
        return Edit(module.path, at, at, f"{glue}{rendered}")
    indent = start if start is not None else _indent(text, close) + _STEP
    rendered = f"{newline}{indent}{_render(item, indent, newline)}"
    if "\n" not in text[at:close]:
        # The closing bracket is on the last item's line: keep it there.
        return Edit(module.path, end, close, f",{rendered}")
    line_end = _line_end(module, at)
    kept = text[at:line_end]
    return Edit(module.path, end, line_end, f",{kept}{rendered},")


def _fill(module: PythonModule, holder: ast.expr, close: int, item: str | Block | Text) -> Edit:
    """Return the edit that adds the first item between empty brackets."""
    text, newline = module.source.text, module.source.newline
    opening = module.span(holder)[0]
    if isinstance(holder, ast.Call):
        opening = text.find("(", module.span(holder.func)[1])
    indent = _indent(text, opening)
    inner = indent + _STEP
    rendered = f"{inner}{_render(item, inner, newline)},{newline}{indent}"
    kept = text[opening + 1 : close].rstrip(" \t\r\n")
    return Edit(module.path, opening + 1, close, f"{kept}{newline}{rendered}")


def _past_parentheses(module: PythonModule, end: int, close: int) -> int:
    """Return the end of an item with the parentheses around it, which are in no node."""
    text = module.source.text
    at = end
    while at < close:
        if text[at] == ")":
            end = at + 1
        elif text[at] == "#":
            at = _line_end(module, at)
            continue
        elif not text[at].isspace():
            break
        at += 1
    return end


def _comma(text: str, start: int, close: int) -> int | None:
    """Return the offset of the comma between an item and the closing bracket."""
    at = start
    while at < close:
        if text[at] == ",":
            return at
        if text[at] == "#":
            at = text.find("\n", at)
        at += 1
    return None


def _first_column(module: PythonModule, items: Sequence[ast.expr]) -> str | None:
    """Return the indentation of the last item at the start of a line, if any."""
    text = module.source.text
    for node in sorted(items, key=lambda node: module.span(node)[0], reverse=True):
        start = _item_start(module, node)
        line = text.rfind("\n", 0, start) + 1
        if not text[line:start].strip():
            return text[line:start]
    return None


def _item_start(module: PythonModule, node: ast.expr) -> int:
    """Return the start of an item with its key or keyword and parentheses."""
    parent = module.parent(node)
    start = module.span(node)[0]
    if isinstance(parent, ast.keyword):
        start = module.span(parent)[0]
    elif isinstance(parent, ast.Dict):
        key = parent.keys[parent.values.index(node)]
        start = module.span(key)[0] if key else start
    text = module.source.text
    while text[start - 1 : start] == "(" and not isinstance(parent, ast.Call):
        start -= 1
    return start


def _indent(text: str, offset: int) -> str:
    """Return the indentation of the line with an offset."""
    start = text.rfind("\n", 0, offset) + 1
    line = text[start:offset]
    return line[: len(line) - len(line.lstrip(" \t"))]


def _line(text: str, offset: int) -> str:
    """Return the line with an offset."""
    return text[text.rfind("\n", 0, offset) + 1 :].partition("\n")[0].rstrip("\r")


def _line_end(module: PythonModule, offset: int) -> int:
    """Return the offset of the line ending after an offset."""
    text = module.source.text
    end = text.find("\n", offset)
    if end < 0:
        return len(text)
    return end - 1 if text[end - 1 : end] == "\r" and end > offset else end


# -- import statements


def _import_key(node: ast.stmt) -> str:
    if isinstance(node, ast.Import):
        return node.names[0].name.lower()
    return (node.module or "").lower() if isinstance(node, ast.ImportFrom) else ""


def _is_standard(node: ast.Import | ast.ImportFrom) -> bool:
    return _import_key(node).partition(".")[0] in sys.stdlib_module_names


def _after_docstring(module: PythonModule) -> int:
    """Return the start of the first statement after the docstring."""
    text = module.source.text
    for node in module.tree.body:
        is_docstring = node is module.tree.body[0] and isinstance(node, ast.Expr)
        if not (is_docstring and module.docstring is not None):
            return module.span(node)[0]
    return len(text)


def literal_span(setup: SetupPy, keyword: Keyword) -> tuple[int, int]:
    """Return the offsets of the literal of a keyword: through ``name=package_name``, too."""
    value = setup.module.index.only_value(keyword.node)
    return setup.module.span(value if isinstance(value, ast.Constant) else keyword.node)


def span(setup: SetupPy, name: str) -> tuple[int, int] | None:
    """Return the offsets of ``name=value`` in the call; ``None`` if it is elsewhere."""
    for word in setup.call.keywords if setup.call else ():
        if word.arg == name:
            return setup.module.span(word)
    return None


def insert(setup: SetupPy, text: str) -> Edit | None:
    """Return the edit that adds a keyword on a separate line, before ``entry_points``.

    ``None`` unless the call has one keyword per line.
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
