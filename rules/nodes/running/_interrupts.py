"""The statements that run after a spin that Ctrl-C or a callback has ended."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api.rclpy import RclpyCall, RclpyFile


def run_after_interrupt(file: RclpyFile, spin: RclpyCall) -> Iterator[ast.stmt]:
    """Yield the statements that run once Ctrl-C has ended a call that spins."""
    handler: ast.ExceptHandler | None = None
    goes_on = False
    child: ast.AST = spin.call
    for parent in file.module.parents(spin.call):
        if isinstance(parent, ast.FunctionDef | ast.AsyncFunctionDef | ast.Module):
            return
        if isinstance(parent, ast.For | ast.While):
            goes_on = goes_on and handler is not None and _breaks(handler)
        if isinstance(parent, ast.Try):
            block = file.module.index.place(child)[0]
            if handler is None and block == "body":
                handler = next((x for x in parent.handlers if _catches_interrupt(file, x)), None)
                goes_on = handler is not None and not any(map(leaves, ast.walk(handler)))
                yield from handler.body if handler is not None else ()
            yield from parent.finalbody if block != "finalbody" else ()
        if goes_on and isinstance(parent, ast.stmt):
            yield from following(file, parent)
        child = parent


def run_after_return(file: RclpyFile, spin: RclpyCall) -> Iterator[ast.stmt]:
    """Yield the statements that run once a callback has ended a spin by shutting down rclpy."""
    is_endless = spin.name.rpartition(".")[2] == "spin"
    for parent in file.module.parents(spin.call):
        if isinstance(parent, ast.FunctionDef | ast.AsyncFunctionDef | ast.Module | ast.For):
            return
        if isinstance(parent, ast.While):
            is_endless = "ok()" in ast.unparse(parent.test)
        if isinstance(parent, ast.Try) and is_endless:
            yield from (*parent.orelse, *parent.finalbody)
        if isinstance(parent, ast.stmt) and is_endless:
            yield from following(file, parent)


def following(file: RclpyFile, statement: ast.stmt) -> list[ast.stmt]:
    """Return the statements after another one in its block."""
    block, number = file.module.index.place(statement)
    holder = file.module.parent(statement)
    return [] if holder is None else getattr(holder, block)[number + 1 :]


def _breaks(handler: ast.ExceptHandler) -> bool:
    return any(isinstance(statement, ast.Break) for statement in handler.body)


def _catches_interrupt(file: RclpyFile, handler: ast.ExceptHandler) -> bool:
    if handler.type is None:
        return True
    caught = file.evaluator.single_value(handler.type)
    types = caught.elts if isinstance(caught, ast.Tuple) else [caught]
    names = {name for type_ in types for name in file.module.qualified_names(type_)}
    return not names.isdisjoint({"KeyboardInterrupt", "BaseException"})


def leaves(node: ast.AST) -> bool:
    """Return whether a node leaves its function, or ends the program."""
    match node:
        case ast.Return() | ast.Raise() | ast.Name(id="exit" | "quit"):
            return True
        case ast.Attribute(attr="exit" | "_exit"):
            return True
    return False
