"""B901, CNL100 and D001: small flake8 plugins that only some distributions have.

flake8-blind-except, flake8-class-newline and flake8-deprecated: Jazzy has none of them.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator

from scaffold.ament import linters
from scaffold.ament.finding import Finding
from scaffold.ament.flake8.options import AMENT, Options
from scaffold.ament.python_text.text import PythonText

_BLIND = r"^[ \t]*except(?P<named>.*\b(?:Base)?Exception\b.*)?:"
_NOQA = r"# no(?:qa|pep8)\b"
_RENAMED = {
    "assertEquals": "assertEqual",
    "assert_": "assertTrue",
    "failIf": "assertFalse",
    "failIfAlmostEqual": "assertNotAlmostEqual",
    "failIfEqual": "assertNotEqual",
    "failUnless": "assertTrue",
    "failUnlessAlmostEqual": "assertAlmostEqual",
    "failUnlessEqual": "assertEqual",
    "failUnlessRaises": "assertRaises",
}
"""Removed methods of unittest that flake8-deprecated looks for."""


def check(text: PythonText, options: Options = AMENT) -> Iterator[Finding]:
    """Yield the findings of the plugins of the target."""
    target = linters.of_target()
    if target.has("flake8-blind-except"):
        yield from _blind_excepts(text, options)
    if target.has("flake8-class-newline"):
        yield from _tight_classes(text)
    if target.has("flake8-deprecated"):
        yield from _deprecated(text)


def _blind_excepts(text: PythonText, options: Options) -> Iterator[Finding]:
    for row, line in enumerate(text.lines, start=1):
        matched = re.match(_BLIND, line) if "except" in line else None
        if matched is None or re.search(_NOQA, line, re.IGNORECASE):
            continue
        if matched["named"] is None:
            yield Finding("B901", row, 1, "bare 'except:' hides every exception")
        elif options.reports("B902"):
            yield Finding("B902", row, 1, "'except Exception' hides most exceptions")


def _tight_classes(text: PythonText) -> Iterator[Finding]:
    """Yield methods and decorators right after the line of a class."""
    after_class: set[int] = set()
    for logical in text.logical_lines:
        if logical.is_comment:
            continue
        line = logical.text
        # It treats any statement that starts with these letters as a class.
        if line.startswith("class"):
            after_class.add(logical.end_row + 1)
        if logical.end_row in after_class and line.startswith(("def ", "@")):
            message = "no blank line between the class statement and its first method"
            yield Finding("CNL100", logical.end_row, 1, message)


def _deprecated(text: PythonText) -> Iterator[Finding]:
    has_plain_names = linters.of_target().since("flake8-deprecated", 2)
    for node in text.nodes(ast.Call):
        name = ""
        if isinstance(node.func, ast.Attribute):
            name = node.func.attr
        elif isinstance(node.func, ast.Name) and has_plain_names:
            name = node.func.id
        if name in _RENAMED:
            column = text.column(node.lineno, node.col_offset)
            message = f"'{name}' is an old name of unittest; use '{_RENAMED[name]}'"
            yield Finding("D001", node.lineno, column, message)
