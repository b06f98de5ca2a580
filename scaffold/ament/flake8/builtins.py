"""A001 to A006: names that shadow a builtin or a module of the standard library.

The findings are those of flake8-builtins; since 2.5 it has separate codes for imports, modules and
the arguments of lambdas.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator, Sequence
from functools import lru_cache

from scaffold.ament import linters, standard_library
from scaffold.ament.finding import Finding
from scaffold.ament.flake8.options import AMENT, Options
from scaffold.ament.python_text.text import PythonText

_NAMES = """
    ArithmeticError AssertionError AttributeError BaseException BaseExceptionGroup
    BlockingIOError BrokenPipeError BufferError BytesWarning ChildProcessError
    ConnectionAbortedError ConnectionError ConnectionRefusedError ConnectionResetError
    DeprecationWarning EOFError Ellipsis EncodingWarning EnvironmentError Exception
    ExceptionGroup FileExistsError FileNotFoundError FloatingPointError FutureWarning
    GeneratorExit IOError ImportError ImportWarning IndentationError IndexError InterruptedError
    IsADirectoryError KeyError KeyboardInterrupt LookupError MemoryError ModuleNotFoundError
    NameError NotADirectoryError NotImplemented NotImplementedError OSError OverflowError
    PendingDeprecationWarning PermissionError ProcessLookupError RecursionError ReferenceError
    ResourceWarning RuntimeError RuntimeWarning StopAsyncIteration StopIteration SyntaxError
    SyntaxWarning SystemError SystemExit TabError TimeoutError TypeError UnboundLocalError
    UnicodeDecodeError UnicodeEncodeError UnicodeError UnicodeTranslateError UnicodeWarning
    UserWarning ValueError Warning ZeroDivisionError __build_class__ __import__ __loader__
    __package__ __spec__ abs aiter all anext any ascii bin bool breakpoint bytearray bytes
    callable chr classmethod compile complex copyright delattr dict dir divmod enumerate eval
    exec exit filter float format frozenset getattr globals hasattr hash help hex id input int
    isinstance issubclass iter len license list locals map max memoryview min next object oct
    open ord pow print property quit range repr reversed round set setattr slice sorted
    staticmethod str sum super tuple type vars zip
"""

BUILTINS = frozenset(_NAMES.split())
"""The builtins of Python 3.12 without those that flake8-builtins allows."""
_NEWER = {
    (3, 11): frozenset({"BaseExceptionGroup", "ExceptionGroup"}),
    (3, 13): frozenset({"PythonFinalizationError"}),
}
"""Builtins by the Python version that added them."""
_MODULES_THAT_PASS = frozenset({"__future__", "__main__", "setup", "test"})

_Comprehension = (ast.ListComp, ast.SetComp, ast.DictComp, ast.GeneratorExp)
_Function = (ast.FunctionDef, ast.AsyncFunctionDef)
_Import = (ast.Import, ast.ImportFrom)
_BINDING = (
    ast.Assign,
    ast.AnnAssign,
    ast.NamedExpr,
    ast.For,
    ast.AsyncFor,
    ast.With,
    ast.AsyncWith,
    *_Comprehension,
    ast.ExceptHandler,
    *_Import,
    *_Function,
    ast.ClassDef,
)
Named = Iterator[tuple[str, int, int]]
"""A name with its line, and its column from 0 in bytes."""


def check(text: PythonText, options: Options = AMENT) -> Iterator[Finding]:
    """Yield the names that shadow a builtin."""
    target = linters.of_target()
    builtins = _builtins(target.python)
    if options.builtins or options.builtins_ignorelist:
        builtins = builtins.difference(options.builtins_ignorelist).union(options.builtins)
    in_class = {
        id(child)
        for node in text.nodes(ast.ClassDef)
        for child in node.body
        if isinstance(child, (ast.Assign, ast.AnnAssign, *_Function))
    }
    for node in text.nodes(*_BINDING):
        code = "A003" if id(node) in in_class else "A001"
        if isinstance(node, _Import) and _has_codes_of_imports():
            yield from _imports(text, node, builtins)
            continue
        for name, line, column in _bound_names(node):
            if name in builtins:
                kind = "attribute of a class" if code == "A003" else "variable"
                yield _finding(text, code, kind, name, line, column)
        if isinstance(node, _Function):
            for argument in _arguments(node):
                if argument.arg in builtins:
                    line, column = argument.lineno, argument.col_offset
                    yield _finding(text, "A002", "argument", argument.arg, line, column)

    if _has_codes_of_imports():
        yield from _lambdas(text, builtins)
        yield from _module(text, options)


def _has_codes_of_imports() -> bool:
    return linters.of_target().since("flake8-builtins", 2, 5)


@lru_cache
def _builtins(python: tuple[int, int]) -> frozenset[str]:
    names = BUILTINS
    for since, newer in _NEWER.items():
        names = names | newer if python >= since else names - newer
    return names


def _imports(
    text: PythonText, node: ast.Import | ast.ImportFrom, builtins: frozenset[str]
) -> Iterator[Finding]:
    for name, line, column in _located(node, [alias.asname or alias.name for alias in node.names]):
        if name in builtins:
            yield _finding(text, "A004", "import", name, line, column)


def _lambdas(text: PythonText, builtins: frozenset[str]) -> Iterator[Finding]:
    for node in text.nodes(ast.Lambda):
        for argument in _arguments(node):
            if argument.arg in builtins:
                place = argument.lineno, argument.col_offset
                yield _finding(text, "A006", "argument of a lambda", argument.arg, *place)


def hidden_module(path: str) -> str:
    """Return the standard library module with the name of a file or its package."""
    if not _has_codes_of_imports():
        return ""
    *_, directory, file = ("", *path.split("/"))
    name = directory if file == "__init__.py" else file.removesuffix(".py")
    is_hidden = name in standard_library.of_target() and name not in _MODULES_THAT_PASS
    return name if is_hidden else ""


def _module(text: PythonText, options: Options) -> Iterator[Finding]:
    name = hidden_module(text.path)
    if name and name not in options.builtins_allowed_modules:
        message = f"the module '{name}' hides that of the standard library"
        yield Finding("A005", 1, 2, message)


def _finding(text: PythonText, code: str, kind: str, name: str, line: int, column: int) -> Finding:
    at = text.column(line, column)
    return Finding(code, line, at, f"the {kind} '{name}' hides the builtin of that name")


def _bound_names(node: ast.AST) -> Named:  # noqa: C901  one branch for each kind of statement
    """Yield the names bound by a node, at the place where flake8-builtins reports them."""
    if isinstance(node, ast.Assign):
        for target in node.targets:
            yield from _unpack(target)
    elif isinstance(node, (ast.AnnAssign, ast.NamedExpr)):
        yield from _unpack(node.target)
    elif isinstance(node, (ast.For, ast.AsyncFor)):
        yield from _located(node, [name for name, _, _ in _unpack(node.target)])
    elif isinstance(node, (ast.With, ast.AsyncWith)):
        for item in node.items:
            yield from _located(node, _flat(item.optional_vars, starred=True))
    elif isinstance(node, _Comprehension):
        for generator in node.generators:
            yield from _located(node, _flat(generator.target, starred=False))
    elif isinstance(node, ast.ExceptHandler):
        yield from _located(node, [node.name or ""])
    elif isinstance(node, _Import):
        yield from _located(node, [alias.asname or "" for alias in node.names])
    elif isinstance(node, (*_Function, ast.ClassDef)):
        yield from _located(node, [node.name])


def _located(node: ast.stmt | ast.expr | ast.ExceptHandler, names: Sequence[str]) -> Named:
    for name in names:
        yield name, node.lineno, node.col_offset


def _unpack(target: ast.expr) -> Named:
    """Yield the names of an assignment's target, however deep."""
    if isinstance(target, ast.Name):
        yield target.id, target.lineno, target.col_offset
    elif isinstance(target, ast.Starred):
        yield from _unpack(target.value)
    elif isinstance(target, (ast.Tuple, ast.List)):
        for element in target.elts:
            yield from _unpack(element)


def _flat(target: ast.expr | None, *, starred: bool) -> list[str]:
    """Return the names of a target, not deeper than one level."""
    elements = target.elts if isinstance(target, (ast.Tuple, ast.List)) else [target]
    if starred:
        elements = [
            element.value if isinstance(element, ast.Starred) else element for element in elements
        ]
    return [element.id for element in elements if isinstance(element, ast.Name)]


def _arguments(node: ast.FunctionDef | ast.AsyncFunctionDef | ast.Lambda) -> list[ast.arg]:
    arguments = node.args
    return [*arguments.posonlyargs, *arguments.args, *arguments.kwonlyargs]
