"""F codes: ruff's findings at the lines and in the cases that pyflakes reports."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property

from scaffold.ament import linters
from scaffold.ament.finding import Finding
from scaffold.ament.flake8.pyflakes import local_names
from scaffold.ament.python_text.text import PythonText
from scaffold.ament.ruff import RuffDiagnostic


def translate(text: PythonText, diagnostics: Sequence[RuffDiagnostic]) -> Iterator[Finding]:
    """Yield what pyflakes would report, given the diagnostics of ruff."""
    stricter = _Stricter(text, diagnostics)
    imports = _import_lines(text) if any(item.code == "F401" for item in diagnostics) else {}
    codes = {item.code for item in diagnostics}
    exports = _export_lines(text) if codes & {"F405", "F822"} else {}
    handlers = _handler_lines(text) if "F841" in codes else {}
    has_star_use = any(item.code == "F405" for item in diagnostics)
    # A second import of the same names takes the place of the first.
    last_stars = {item.message: item.line for item in diagnostics if item.code == "F403"}
    has_unused_annotations = linters.of_target().since("pyflakes", 3)
    for diagnostic in diagnostics:
        if diagnostic.code == "F842" and not has_unused_annotations:
            continue
        finding = plain(diagnostic)
        if diagnostic.code == "F401":
            node = imports.get(finding.line)
            finding = finding if node is None else _moved(text, finding, node)
        elif diagnostic.code in ("F405", "F822"):
            finding = _at(text, finding, exports)
            if diagnostic.code == "F822" and text.name == "__init__.py":
                continue
        elif diagnostic.code == "F841":
            finding = _at(text, finding, handlers)
        elif diagnostic.code == "F823":
            finding = local_names.at_last_use(text, finding)
        if diagnostic.code not in OWN and not stricter.is_alone(diagnostic):
            yield finding._replace(is_doubtful=stricter.is_made_when_run(diagnostic))
        if (
            diagnostic.code == "F403"
            and not has_star_use
            and last_stars[diagnostic.message] == diagnostic.line
        ):
            unused = "nothing of the star import is used"
            yield Finding("F401", finding.line, finding.column, unused)
    yield from local_names.deleted_unused(text)


def plain(diagnostic: RuffDiagnostic) -> Finding:
    """Return a finding of ruff unchanged."""
    return Finding(
        diagnostic.code,
        diagnostic.line,
        diagnostic.column,
        worded(diagnostic.message),
        diagnostic.end_line,
        diagnostic.end_column,
        diagnostic.fix,
        diagnostic.fix_title,
        fix_is_unsafe=diagnostic.fix_is_unsafe,
    )


def worded(message: str) -> str:
    """Return a message of ruff in our form: lower case start, no period at the end."""
    message = message.rstrip(".")
    return message[:1].lower() + message[1:] if message[1:2].islower() else message


OWN = frozenset({"F541", "F601", "F602", "F811"})
"""Judged in ``literals`` and ``redefinitions``."""


_GIVEN = {"conf.py": "`tags`"}
"""What Sphinx gives its configuration."""


class _Stricter:
    """The diagnostics of ruff that pyflakes does not have, and those that may be wrong."""

    def __init__(self, text: PythonText, diagnostics: Sequence[RuffDiagnostic]) -> None:
        self._text = text
        self._codes = {(item.line, item.code) for item in diagnostics}

    def is_alone(self, diagnostic: RuffDiagnostic) -> bool:
        """Tell whether ruff reports this and pyflakes does not."""
        if diagnostic.code == "F507":
            return diagnostic.line not in self._tuple_formats
        if (
            diagnostic.code == "F821"
            and (diagnostic.line, diagnostic.column) in self._conditional_deletions
        ):
            return True
        if diagnostic.code == "F401":
            return (
                diagnostic.line,
                diagnostic.message.partition("`")[2].partition("`")[0],
            ) in self._by_alias
        if diagnostic.code == "F841":
            return (
                diagnostic.line,
                diagnostic.message.partition("`")[2].partition("`")[0],
            ) in self._rebound
        rival = {"F502": "F506", "F523": "F525"}.get(diagnostic.code)
        return (diagnostic.line, rival) in self._codes

    def is_made_when_run(self, diagnostic: RuffDiagnostic) -> bool:
        """Tell whether the module may have a name that nothing in its text defines."""
        if diagnostic.code == "F821":
            # A configuration such as .cmake-format.py is run by its program, with names from there.
            is_given = diagnostic.message.endswith(_GIVEN.get(self._text.name, " "))
            return self._executes_text or self._text.name.startswith(".") or is_given
        return diagnostic.code == "F822" and self._has_getattr

    @cached_property
    def _executes_text(self) -> bool:
        """Whether ``exec(text)`` may define names; one with a dictionary defines them there."""
        return "exec" in self._text.text and any(
            isinstance(node.func, ast.Name) and node.func.id == "exec" and len(node.args) == 1
            for node in self._text.nodes(ast.Call)
        )

    @cached_property
    def _has_getattr(self) -> bool:
        """Whether the module answers for names that it lacks (PEP 562)."""
        return self._text.tree is not None and any(
            isinstance(node, ast.FunctionDef) and node.name == "__getattr__"
            for node in self._text.tree.body
        )

    @cached_property
    def _tuple_formats(self) -> set[int]:
        return {
            node.lineno
            for node in self._text.nodes(ast.BinOp)
            if isinstance(node.op, ast.Mod) and isinstance(node.right, ast.Tuple)
        }

    @cached_property
    def _by_alias(self) -> set[tuple[int, str]]:
        return local_names.used_by_alias(self._text)

    @cached_property
    def _rebound(self) -> set[tuple[int, str]]:
        return local_names.read_after_rebinding(self._text)

    @cached_property
    def _conditional_deletions(self) -> set[tuple[int, int]]:
        """The places of ``del name`` that may not run: pyflakes does not look at them."""
        if "del " not in self._text.text:
            return set()
        return {
            (name.lineno, self._text.column(name.lineno, name.col_offset))
            for name, is_certain, _ in local_names.deletions(self._text)
            if not is_certain
        }


def _at(
    text: PythonText, finding: Finding, nodes: Mapping[int, ast.stmt | ast.ExceptHandler]
) -> Finding:
    """Move a finding to the start of the node that its line belongs to, if there is one."""
    node = nodes.get(finding.line)
    return finding if node is None else _moved(text, finding, node)


def _handler_lines(text: PythonText) -> dict[int, ast.ExceptHandler]:
    """Return each ``except ... as name`` by the lines between its first and its body."""
    result: dict[int, ast.ExceptHandler] = {}
    for node in text.nodes(ast.ExceptHandler):
        if node.name:
            for line in range(node.lineno + 1, node.body[0].lineno):
                result.setdefault(line, node)
    return result


def _import_lines(text: PythonText) -> dict[int, ast.stmt]:
    """Return the import statement that covers a line; the first of several."""
    result: dict[int, ast.stmt] = {}
    for node in sorted(text.imports, key=lambda node: (node.lineno, node.col_offset)):
        for line in range(node.lineno, (node.end_lineno or node.lineno) + 1):
            result.setdefault(line, node)
    return result


def _export_lines(text: PythonText) -> dict[int, ast.stmt]:
    """Return the last statement that sets ``__all__``, by the lines of all that do."""
    exports = [node for node in (text.tree.body if text.tree else ()) if _sets_exports(node)]
    return {
        line: exports[-1]
        for node in exports
        for line in range(node.lineno, (node.end_lineno or node.lineno) + 1)
    }


def _sets_exports(node: ast.stmt) -> bool:
    if isinstance(node, ast.Assign):
        targets = node.targets
    elif isinstance(node, (ast.AugAssign, ast.AnnAssign)):
        targets = [node.target]
    else:
        return False
    return any(isinstance(target, ast.Name) and target.id == "__all__" for target in targets)


def _moved(text: PythonText, finding: Finding, node: ast.stmt | ast.ExceptHandler) -> Finding:
    column = text.column(node.lineno, node.col_offset)
    return finding._replace(line=node.lineno, column=column, end_line=0, end_column=0)
