"""Write the stubs of rclpy and ament_index_python below scaffold/data/jazzy/stubs.

Usage:

    python -m venv jazzy
    jazzy/bin/pip install ros-jazzy-rclpy==7.1.6
    python scripts/make_stubs.py jazzy/lib/python3.*/site-packages

where the second python has this checkout installed. A stub holds what a type checker must know to
judge a call: names, parameters, annotations. Bodies, comments and docstrings, which are their
authors' texts, are not taken. A file in scripts/stub_overlay/jazzy of the same path has the last
word: its functions and attributes replace those of the source, its classes are merged by member,
and `del name` removes what a stub must not promise. The stubs of libraries that have no wheel are
written by hand and lie next to the generated ones.
"""

from __future__ import annotations

import ast
import os
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Sequence
from pathlib import Path

PACKAGES = ("ament_index_python", "rclpy")
ROOT = Path(__file__).parent.parent
TARGET = ROOT / "scaffold" / "data" / "jazzy" / "stubs"
OVERLAY = Path(__file__).parent / "stub_overlay" / "jazzy"
HEAD = "# Made by scripts/make_stubs.py from {package} {version} of ROS 2 Jazzy; do not edit.\n"
VERSIONS = {"ament_index_python": "1.8.1", "rclpy": "7.1.6"}

_KEPT_DECORATORS = {
    "abstractmethod",
    "asynccontextmanager",
    "classmethod",
    "contextmanager",
    "overload",
    "property",
    "setter",
    "staticmethod",
}
_NATIVE = {"_rclpy", "rclpy_implementation", "import_c_library"}
"""The name of the extension module in the sources, whose types are undeclared."""
_TYPE_MAKERS = ("TypeVar(", "TypedDict(", "NamedTuple(", "namedtuple(")
_LITERALS = {bool: "bool", int: "int", float: "float", str: "str", bytes: "bytes"}
_SPECIAL = {"__eq__": "bool", "__ne__": "bool", "__repr__": "str", "__str__": "str"}
"""The return types of special methods."""
_GENERIC = {
    "Callable": "..., Any",
    "Dict": "Any, Any",
    "OrderedDict": "Any, Any",
    "dict": "Any, Any",
    "set": "Any",
}
"""Type arguments missing in the sources."""
Statement = ast.stmt
Function = ast.FunctionDef | ast.AsyncFunctionDef


def stubs(source: Path) -> dict[str, str]:
    """Return the stubs of all packages, by path relative to the target."""
    files: dict[str, str] = {}
    for package in PACKAGES:
        for path in sorted((source / package).rglob("*.py")):
            relative = path.relative_to(source).with_suffix(".pyi")
            if any(part.startswith("_") and part != "__init__.pyi" for part in relative.parts):
                continue
            text = stub(path.read_text(), _overlay(relative))
            head = HEAD.format(package=package, version=VERSIONS[package])
            files[relative.as_posix()] = head + text
    for path in OVERLAY.rglob("*.pyi"):
        relative = path.relative_to(OVERLAY)
        if relative.as_posix() not in files:
            files[relative.as_posix()] = ast.unparse(ast.parse(path.read_text()))
    return formatted(files)


def _overlay(path: Path) -> str:
    file = OVERLAY / path
    return file.read_text() if file.is_file() else ""


def formatted(files: dict[str, str]) -> dict[str, str]:
    """Return stubs as `ruff format` writes them."""
    with tempfile.TemporaryDirectory() as directory:
        for path, text in files.items():
            target = Path(directory, path)
            target.parent.mkdir(parents=True, exist_ok=True)
            target.write_text(text)
        configuration = f"--config={ROOT / 'pyproject.toml'}"
        ruff = [sys.executable, "-m", "ruff", "format", "--no-cache", "--quiet", configuration]
        subprocess.run([*ruff, directory], check=True)
        return {path: Path(directory, path).read_text() for path in sorted(files)}


def stub(source: str, overlay: str) -> str:
    """Return the stub of a module.

    Args:
        source: The module.
        overlay: The overlay that replaces and completes it, as a stub.
    """
    body = list(_Module().statements(ast.parse(source).body))
    body = merged(body, ast.parse(overlay).body)
    return ast.unparse(ast.fix_missing_locations(ast.Module(_with_needed_imports(body), [])))


# -- from source to stub


class _Module:
    """Turns the statements of a module into those of its stub."""

    def statements(self, body: Sequence[Statement]) -> Iterator[Statement]:
        for node in body:
            match node:
                case ast.Import() | ast.ImportFrom():
                    yield from self._imported(node)
                case ast.Try():
                    yield from self.statements(node.body)
                case ast.If() if "TYPE_CHECKING" in ast.unparse(node.test):
                    yield from self.statements(node.body)
                case ast.ClassDef():
                    yield self._class(node)
                case ast.FunctionDef() | ast.AsyncFunctionDef():
                    if not node.name.startswith("_"):
                        yield _signature(node)
                case ast.Assign() | ast.AnnAssign():
                    yield from self._assigned(node, in_class=False)

    def _imported(self, node: ast.Import | ast.ImportFrom) -> Iterator[Statement]:
        if any(alias.name in _NATIVE or alias.asname in _NATIVE for alias in node.names):
            return
        if isinstance(node, ast.ImportFrom):
            node.names = [alias for alias in node.names if not alias.name.startswith("_")]
        if isinstance(node, ast.ImportFrom) and self._is_exported(node):
            for alias in node.names:
                if alias.name != "*":
                    alias.asname = alias.asname or alias.name
        yield node

    def _is_exported(self, node: ast.ImportFrom) -> bool:
        root = (node.module or "").partition(".")[0]
        return node.level > 0 or root not in sys.stdlib_module_names

    def _class(self, node: ast.ClassDef) -> ast.ClassDef:
        bases = [base for base in node.bases if not _is_native(base)]
        is_enum = any(ast.unparse(base).endswith(("Enum", "Flag")) for base in bases)
        if node.bases and not bases:
            bases = [ast.Name("Exception")]
        members: dict[str, list[Statement]] = {}
        for item in node.body:
            if isinstance(item, Function):
                members.setdefault(item.name, []).extend(_method(item))
            elif is_enum and isinstance(item, ast.Assign):
                members[_target(item)] = [_enum_member(item)]
            elif isinstance(item, ast.Assign | ast.AnnAssign):
                for line in self._assigned(item, in_class=True):
                    members.setdefault(_target(line), [line])
            elif isinstance(item, ast.ClassDef):
                members[item.name] = [self._class(item)]
        for name, annotation in _attributes(node):
            members.setdefault(name, [_annotated(name, annotation)])
        lines = [line for group in members.values() for line in group]
        return ast.ClassDef(node.name, bases, node.keywords, lines or [_dots()], [])

    def _assigned(self, node: ast.Assign | ast.AnnAssign, *, in_class: bool) -> Iterator[Statement]:
        if isinstance(node, ast.AnnAssign):
            if isinstance(node.target, ast.Name):
                annotation = _annotation(node.annotation)
                is_alias = ast.unparse(annotation) == "TypeAlias"
                value = node.value if is_alias else None
                yield ast.AnnAssign(ast.Name(node.target.id), annotation, value, 1)
            return
        name = _target(node)
        if not name or name in {"__slots__", "__all__"}:
            return
        value = node.value
        is_name = isinstance(value, ast.Name | ast.Attribute | ast.Subscript)
        is_alias = is_name and not in_class and not _is_native(value)
        if is_alias or ast.unparse(value).startswith(_TYPE_MAKERS):
            yield ast.Assign([ast.Name(name)], value, lineno=0)
        else:
            yield _annotated(name, _type_of(value, {}))


def _enum_member(node: ast.Assign) -> Statement:
    value = node.value if isinstance(node.value, ast.Constant) else ast.Constant(...)
    return ast.Assign([ast.Name(_target(node))], value, lineno=0)


def _is_native(node: ast.AST) -> bool:
    return any(isinstance(item, ast.Name) and item.id in _NATIVE for item in ast.walk(node))


def _target(node: Statement) -> str:
    match node:
        case ast.Assign(targets=[ast.Name(id=name)]) | ast.AnnAssign(target=ast.Name(id=name)):
            return name
    return ""


def _dots() -> Statement:
    return ast.Expr(ast.Constant(...))


def _annotated(name: str, annotation: ast.expr) -> Statement:
    return ast.AnnAssign(ast.Name(name), annotation, None, 1)


def _annotation(node: ast.expr) -> ast.expr:
    """Return an annotation without quotes; ``Any`` if it uses undeclared names."""
    if isinstance(node, ast.Constant) and isinstance(node.value, str):
        node = ast.parse(node.value, mode="eval").body
    return _Completion().visit(node)  # type: ignore[no-any-return]  # an expression as well


class _Completion(ast.NodeTransformer):
    """Replaces types of the extension module, and gives generic types their arguments."""

    def visit_Attribute(self, node: ast.Attribute) -> ast.expr:
        return ast.Name("Any") if _is_native(node) else node

    def visit_Subscript(self, node: ast.Subscript) -> ast.expr:
        node.slice = self.visit(node.slice)
        return node

    def visit_Name(self, node: ast.Name) -> ast.expr:
        if node.id in _GENERIC:
            return ast.parse(f"{node.id}[{_GENERIC[node.id]}]", mode="eval").body
        return ast.Name("Any") if node.id in _NATIVE else node


def _method(node: Function) -> list[Statement]:
    """Return a method; a private one becomes an attribute of type ``Any``."""
    is_special = node.name.startswith("__") and node.name.endswith("__")
    if node.name.startswith("_") and not is_special:
        return [_annotated(node.name, ast.Name("Any"))]
    if node.name == "__del__":
        return []
    return [_signature(node)]


def _signature(node: Function) -> Function:
    arguments = node.args
    for argument in [*arguments.posonlyargs, *arguments.args, *arguments.kwonlyargs]:
        if argument.annotation is not None:
            argument.annotation = _annotation(argument.annotation)
    for extra in (arguments.vararg, arguments.kwarg):
        if extra is not None and extra.annotation is not None:
            extra.annotation = _annotation(extra.annotation)
    arguments.defaults = [_default(value) for value in arguments.defaults]
    arguments.kw_defaults = [
        None if value is None else _default(value) for value in arguments.kw_defaults
    ]
    _annotate(node)
    if node.returns is not None:
        returns = _annotation(node.returns)
    elif _returns_value(node):
        returns = ast.Name(_SPECIAL.get(node.name, "Any"))
    else:
        returns = ast.Constant(None)
    decorators = [item for item in node.decorator_list if _decorator(item) in _KEPT_DECORATORS]
    kind = type(node)
    return kind(node.name, arguments, [_dots()], decorators, returns, lineno=0)


def _annotate(node: Function) -> None:
    """Annotate parameters without an annotation with ``Any``, for strict type checkers."""
    arguments = node.args
    extra = [item for item in (arguments.vararg, arguments.kwarg) if item is not None]
    for argument in [*arguments.posonlyargs, *arguments.args, *arguments.kwonlyargs, *extra]:
        if argument.annotation is None and argument.arg not in {"self", "cls"}:
            argument.annotation = ast.Name("Any")


def _decorator(node: ast.expr) -> str:
    return node.attr if isinstance(node, ast.Attribute) else ast.unparse(node)


def _default(node: ast.expr) -> ast.expr:
    is_plain = isinstance(node, ast.Constant | ast.Name | ast.Attribute) and not _is_native(node)
    is_number = isinstance(node, ast.UnaryOp) and isinstance(node.operand, ast.Constant)
    return node if is_plain or is_number else ast.Constant(...)


def _returns_value(node: Function) -> bool:
    pending: list[ast.AST] = list(node.body)
    is_abstract = any(isinstance(item, ast.Raise) for item in node.body)
    while pending:
        item = pending.pop()
        if isinstance(item, ast.Return) and item.value is not None:
            return True
        if isinstance(item, ast.Yield | ast.YieldFrom):
            return True
        if not isinstance(item, ast.FunctionDef | ast.Lambda | ast.ClassDef):
            pending.extend(ast.iter_child_nodes(item))
    return is_abstract


def _attributes(class_: ast.ClassDef) -> Iterator[tuple[str, ast.expr]]:
    """Yield the attributes that the methods of a class set, with their types."""
    for method in class_.body:
        if not isinstance(method, Function):
            continue
        arguments = method.args
        annotated = {
            argument.arg: _annotation(argument.annotation)
            for argument in [*arguments.args, *arguments.kwonlyargs]
            if argument.annotation is not None
        }
        for node in ast.walk(method):
            match node:
                case ast.AnnAssign(target=ast.Attribute(value=ast.Name(id="self"), attr=name)):
                    yield name, _annotation(node.annotation)
                case ast.Assign(targets=[ast.Attribute(value=ast.Name(id="self"), attr=name)]):
                    yield name, _type_of(node.value, annotated, is_private=name.startswith("_"))


def _type_of(
    value: ast.expr, annotated: dict[str, ast.expr], *, is_private: bool = False
) -> ast.expr:
    if is_private:
        return ast.Name("Any")
    match value:
        case ast.Constant() if type(value.value) in _LITERALS:
            return ast.Name(_LITERALS[type(value.value)])
        case ast.Name(id=name) if name in annotated:
            return annotated[name]
        case ast.Call(func=ast.Name(id=name)) if name[0].isupper() and name not in _NATIVE:
            return _annotation(ast.Name(name))
    return ast.Name("Any")


# -- the overlay


def merged(body: Sequence[Statement], overlay: Sequence[Statement]) -> list[Statement]:
    """Return the statements of a stub with those of its overlay in their place."""
    groups: dict[str, list[Statement]] = {}
    for number, node in enumerate(body):
        groups.setdefault(_name(node) or f"#{number}", []).append(node)
    added: dict[str, list[Statement]] = {}
    for number, node in enumerate(overlay):
        if isinstance(node, ast.Delete):
            for target in node.targets:
                del groups[ast.unparse(target)]
            continue
        added.setdefault(_name(node) or f"+{number}", []).append(node)
    for name, nodes in added.items():
        match groups.get(name), nodes:
            case [ast.ClassDef() as own], [ast.ClassDef() as replacing]:
                groups[name] = [_merged_class(own, replacing)]
            case _:
                groups[name] = nodes
    result = [node for group in groups.values() for node in group]
    return sorted(result, key=lambda node: not isinstance(node, ast.Import | ast.ImportFrom))


def _merged_class(own: ast.ClassDef, overlay: ast.ClassDef) -> ast.ClassDef:
    lines = merged(own.body, [line for line in overlay.body if not _is_dots(line)])
    body = [line for line in lines if not _is_dots(line)] or [_dots()]
    return ast.ClassDef(
        own.name, overlay.bases or own.bases, overlay.keywords or own.keywords, body, []
    )


def _is_dots(node: Statement) -> bool:
    return isinstance(node, ast.Expr)


def _name(node: Statement) -> str:
    if isinstance(node, Function | ast.ClassDef):
        return node.name
    return _target(node)


# -- remaining imports


def _with_needed_imports(body: Sequence[Statement]) -> list[Statement]:
    """Return the statements of a stub with the imports that it needs or exports."""
    names = {
        item.id
        for node in body
        if not isinstance(node, ast.Import | ast.ImportFrom)
        for item in ast.walk(node)
        if isinstance(item, ast.Name)
    }
    imported = set()
    result: list[Statement] = []
    for node in body:
        if not isinstance(node, ast.Import | ast.ImportFrom):
            result.append(node)
            continue
        kept = []
        for alias in node.names:
            name = alias.asname or alias.name.split(".")[0]
            is_export = alias.name in {alias.asname, "*"}
            if name not in imported and (name in names or is_export):
                kept.append(alias)
                imported.add(name)
        if kept:
            node.names = kept
            result.append(node)
    if "Any" in names and "Any" not in imported:
        result.insert(0, ast.ImportFrom("typing", [ast.alias("Any")], 0))
    return result


def main() -> int:
    """Write the stubs."""
    if len(sys.argv) != 2:  # noqa: PLR2004  the program and one argument
        sys.stderr.write(f"usage: {os.path.basename(sys.argv[0])} SITE_PACKAGES\n")
        return 2
    for path, text in stubs(Path(sys.argv[1])).items():
        target = TARGET / path
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_text(text)
    return 0


if __name__ == "__main__":
    sys.exit(main())
