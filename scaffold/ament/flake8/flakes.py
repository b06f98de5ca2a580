"""F codes: pyflakes itself, with the fixes of ruff for the same findings.

pyflakes walks the syntax tree that has been parsed already, which takes a twentieth of a cold
check.
"""

from __future__ import annotations

import ast
from collections.abc import Collection, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING

from scaffold import distributions
from scaffold.ament import linters
from scaffold.ament.finding import Finding
from scaffold.ament.python_text.text import PythonText
from scaffold.ament.ruff import RuffDiagnostic

if TYPE_CHECKING:
    from pyflakes.messages import Message

CODES: Mapping[str, str] = {
    "UnusedImport": "F401",
    "ImportShadowedByLoopVar": "F402",
    "ImportStarUsed": "F403",
    "LateFutureImport": "F404",
    "ImportStarUsage": "F405",
    "ImportStarNotPermitted": "F406",
    "FutureFeatureNotDefined": "F407",
    "PercentFormatInvalidFormat": "F501",
    "PercentFormatExpectedMapping": "F502",
    "PercentFormatExpectedSequence": "F503",
    "PercentFormatExtraNamedArguments": "F504",
    "PercentFormatMissingArgument": "F505",
    "PercentFormatMixedPositionalAndNamed": "F506",
    "PercentFormatPositionalCountMismatch": "F507",
    "PercentFormatStarRequiresSequence": "F508",
    "PercentFormatUnsupportedFormatCharacter": "F509",
    "StringDotFormatInvalidFormat": "F521",
    "StringDotFormatExtraNamedArguments": "F522",
    "StringDotFormatExtraPositionalArguments": "F523",
    "StringDotFormatMissingArgument": "F524",
    "StringDotFormatMixingAutomatic": "F525",
    "FStringMissingPlaceholders": "F541",
    "MultiValueRepeatedKeyLiteral": "F601",
    "MultiValueRepeatedKeyVariable": "F602",
    "TooManyExpressionsInStarredAssignment": "F621",
    "TwoStarredExpressions": "F622",
    "AssertTuple": "F631",
    "IsLiteral": "F632",
    "InvalidPrintSyntax": "F633",
    "IfTuple": "F634",
    "BreakOutsideLoop": "F701",
    "ContinueOutsideLoop": "F702",
    "YieldOutsideFunction": "F704",
    "ReturnOutsideFunction": "F706",
    "DefaultExceptNotLast": "F707",
    "ForwardAnnotationSyntaxError": "F722",
    "RedefinedWhileUnused": "F811",
    "UndefinedName": "F821",
    "UndefinedExport": "F822",
    "UndefinedLocal": "F823",
    "DuplicateArgument": "F831",
    "UnusedVariable": "F841",
    "UnusedAnnotation": "F842",
    "RaiseNotImplemented": "F901",
}
"""The flake8 codes of pyflakes messages; F824 is checked by ``indirect_names``."""
_STUBS = frozenset({"stubs", "typings"})
_NAMESPACES = ("dir", "globals", "locals", "vars")
"""Functions that return the names of a module or a function."""
_GIVEN = {"conf.py": frozenset({"tags"})}
"""Names that Sphinx defines for its configuration."""


def check(
    text: PythonText, builtins: Collection[str], diagnostics: Sequence[RuffDiagnostic]
) -> Iterator[Finding]:
    """Yield the findings of pyflakes.

    Args:
        text: The file; nothing is reported without a syntax tree.
        builtins: The additional builtins in its configuration.
        diagnostics: The diagnostics of ruff, used for the ends of expressions.
    """
    from scaffold.ament.flake8.quick_pyflakes import messages

    if text.index is None:
        return
    is_before_3 = not linters.of_target().since("pyflakes", 3)
    # From Python 3.14 on, annotations are evaluated lazily, which ruff handles for the target.
    is_deferred = distributions.target().python >= (3, 14)
    ends = {(item.code, item.line, item.column): item for item in diagnostics}
    for message in messages(text.index, text.path, builtins, splits_match=not is_before_3):
        code = CODES.get(type(message).__name__, "")
        if not code or (is_before_3 and _is_of_3(text, code, message.message_args)):
            continue
        column = text.column(message.lineno, message.col)
        end = ends.get((code, message.lineno, column))
        if is_deferred and code == "F821" and not _is_undefined(message, diagnostics):
            continue
        yield Finding(
            code,
            message.lineno,
            column,
            message.message % message.message_args,
            end.end_line if end else 0,
            end.end_column if end else 0,
            is_doubtful=_is_made_when_run(text, code, message.message_args),
        )


def _is_undefined(message: Message, diagnostics: Sequence[RuffDiagnostic]) -> bool:
    """Return whether ruff reports a name as well; in a quoted annotation, at another column."""
    name = f"`{message.message_args[0]}`"
    return any(
        item.code == "F821" and item.line == message.lineno and name in item.message
        for item in diagnostics
    )


def _is_of_3(text: PythonText, code: str, arguments: Sequence[object]) -> bool:
    """Return whether pyflakes only reports this from version 3 on.

    Such as annotations without a value, and definitions that replace assigned names.
    """
    if code != "F811":
        return code == "F842"
    definitions = (*text.imports, *text.functions, *text.nodes(ast.ClassDef))
    return arguments[-1] not in {node.lineno for node in definitions}


def placed(text: PythonText, diagnostics: Sequence[RuffDiagnostic]) -> Iterator[RuffDiagnostic]:
    """Yield the diagnostics of ruff at the lines where pyflakes reports the same."""
    imports = _import_lines(text) if any(item.code == "F401" for item in diagnostics) else {}
    handlers = _handler_lines(text) if any(item.code == "F841" for item in diagnostics) else {}
    lines = {"F401": imports, "F841": handlers}
    for item in diagnostics:
        line = lines.get(item.code, {}).get(item.line)
        yield item if line is None else item._replace(line=line)


def _import_lines(text: PythonText) -> dict[int, int]:
    """Return the line of the import statement that covers a line; the first of several."""
    result: dict[int, int] = {}
    for node in sorted(text.imports, key=lambda node: (node.lineno, node.col_offset)):
        for line in range(node.lineno, (node.end_lineno or node.lineno) + 1):
            result.setdefault(line, node.lineno)
    return result


def _handler_lines(text: PythonText) -> dict[int, int]:
    """Return the line of an ``except ... as name`` by the lines between it and its body."""
    result: dict[int, int] = {}
    for node in text.nodes(ast.ExceptHandler):
        for line in range(node.lineno, node.body[0].lineno) if node.name else ():
            result.setdefault(line, node.lineno)
    return result


def _is_made_when_run(text: PythonText, code: str, arguments: Sequence[object]) -> bool:
    """Return whether the module may have names that are not defined in its text."""
    if code == "F821":
        # A configuration such as .cmake-format.py is run by its program, which defines names.
        is_given = not _GIVEN.get(text.name, frozenset()).isdisjoint(arguments)
        return (
            text.name.startswith(".")
            or is_given
            or _executes_text(text)
            or _is_asked_for(text, *map(str, arguments))
            or _is_stub(text)
        )
    return code == "F822" and _has_getattr(text)


def _executes_text(text: PythonText) -> bool:
    """Return whether ``exec(text)`` may define names; one with a dictionary defines them there."""
    return "exec" in text.text and any(
        isinstance(node.func, ast.Name) and node.func.id == "exec" and len(node.args) == 1
        for node in text.nodes(ast.Call)
    )


def _is_asked_for(text: PythonText, *names: str) -> bool:
    """Return whether a file tests if it has a name: ``'strip' in globals()``."""
    return any(
        isinstance(node.left, ast.Constant)
        and node.left.value in names
        and isinstance(node.comparators[0], ast.Call)
        and getattr(node.comparators[0].func, "id", "") in _NAMESPACES
        for node in (text.nodes(ast.Compare) if any(map(text.text.count, _NAMESPACES)) else ())
    )


def _is_stub(text: PythonText) -> bool:
    """Return whether a file is only for type checkers: in ``stubs``, with ``...`` as bodies.

    Files for ``mypy_path`` or pyright are rarely imported, although not always ``.pyi``.
    """
    if _STUBS.isdisjoint(text.path.split("/")) or not text.functions:
        return False
    last = (function.body[-1] for function in text.functions)
    return all(
        isinstance(node, ast.Expr)
        and isinstance(node.value, ast.Constant)
        and node.value.value is Ellipsis
        for node in last
    )


def _has_getattr(text: PythonText) -> bool:
    """Return whether the module has ``__getattr__`` (PEP 562)."""
    return text.tree is not None and any(
        isinstance(node, ast.FunctionDef) and node.name == "__getattr__" for node in text.tree.body
    )
