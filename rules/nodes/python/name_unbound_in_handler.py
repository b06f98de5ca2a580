"""ND103: exception handlers use names that are assigned."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, PythonRule
from scaffold.api.python import PythonModule

_REFUSED = {
    "int": frozenset({"ValueError", "TypeError"}),
    "float": frozenset({"ValueError", "TypeError"}),
    "open": frozenset({"OSError", "IOError", "FileNotFoundError", "PermissionError"}),
}
"""Exceptions for wrong arguments, by function."""
_CODE = (
    "def parse(text):\n    try:\n        value = {}\n{}        return value\n"
    "    except {}:\n        print({})\n"
)


class NameUnboundInHandler(PythonRule):
    """An exception handler uses a name that the failing statement would have assigned.

    **Why.** When the statement fails, the name is not assigned: the handler raises
    ``UnboundLocalError``.

    **Fix.** Use the argument of the failing call, or assign the name before the ``try``.

    **Source.** Python documentation, "Naming and binding".
    """

    code = "ND103"
    name = "name-unbound-in-handler"
    examples = (
        Example("the argument", {"a.py": _CODE.format("int(text)", "", "ValueError", "text")}),
        Example(
            "the failing statement assigns the name",
            {"a.py": _CODE.format("int(text)", "        print(1)\n", "ValueError", "value")},
            "7:15: 'value' is not assigned when the first statement of `try` fails: "
            "UnboundLocalError",
        ),
        Example(
            "a later statement may fail",
            {
                "a.py": _CODE.format(
                    "start(text)", "        value.wait(1)\n", "TimeoutError", "value"
                )
            },
        ),
        Example(
            "assigned before",
            {
                "a.py": _CODE.format("int(text)", "", "ValueError", "value").replace(
                    "    try", "    value = None\n    try"
                )
            },
        ),
    )

    def check_file(self, module: PythonModule) -> Iterator[Diagnostic]:
        for try_ in module.walk(ast.Try):
            first = try_.body[0]
            function = module.enclosing_function(try_)
            match first:
                case ast.Assign(targets=[ast.Name(id=name)], value=ast.Call() as call):
                    pass
                case _:
                    continue
            if function is None or not _is_assigned_there_alone(module, try_, name):
                continue
            for handler in try_.handlers:
                if _comes_from(module, call, handler, is_alone=len(try_.body) == 1):
                    yield from self._uses(module, handler, name)

    def _uses(
        self, module: PythonModule, handler: ast.ExceptHandler, name: str
    ) -> Iterator[Diagnostic]:
        for use in module.below(handler, ast.Name):
            is_read = use.id == name and isinstance(use.ctx, ast.Load)
            if is_read and module.enclosing_function(use) is module.enclosing_function(handler):
                message = f"{name!r} is not assigned when the first statement of `try` fails"
                yield self.report(module.location(use), f"{message}: UnboundLocalError")
                return


def _is_assigned_there_alone(module: PythonModule, try_: ast.Try, name: str) -> bool:
    """Return whether a local name is only assigned in the body of a ``try``.

    In a loop, an earlier iteration may have assigned it.
    """
    lookup = module.index.lookup(name, try_.body[0])
    if lookup is None or module.mentions("locals()") or not _is_function(lookup[0]):
        return False
    for parent in module.parents(try_):
        if parent is lookup[0]:
            break
        if isinstance(parent, ast.For | ast.While | ast.AsyncFor):
            return False
    return all(
        binding.kind == "assignment"
        and any(module.is_inside(binding.node, statement) for statement in try_.body)
        for binding in lookup[1]
    )


def _is_function(node: ast.AST) -> bool:
    return isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef)


def _comes_from(
    module: PythonModule, call: ast.Call, handler: ast.ExceptHandler, *, is_alone: bool
) -> bool:
    """Return whether a handler only catches the exceptions of a call."""
    if is_alone:
        return True
    types = handler.type.elts if isinstance(handler.type, ast.Tuple) else [handler.type]
    names = {type_.id for type_ in types if isinstance(type_, ast.Name)}
    match call.func:
        case ast.Name(id=function) if module.index.lookup(function, call) is None:
            return not names.isdisjoint(_REFUSED.get(function, ()))
    return False
