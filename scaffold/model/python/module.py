"""A Python file as data: syntax tree, imports, top-level names, locations."""

from __future__ import annotations

import ast
from collections.abc import Mapping, Sequence
from functools import cached_property

from scaffold.model.python.imports import Import, is_main_test, read_imports
from scaffold.model.python.scopes import FunctionNode
from scaffold.model.python.syntax_tree import SyntaxTree
from scaffold.record import NamedTuple
from scaffold.source import Location

_LEAVING: tuple[type[ast.stmt], ...] = (ast.Return, ast.Raise, ast.Continue, ast.Break)
MODULE_ATTRIBUTES = frozenset(
    {"__name__", "__file__", "__doc__", "__package__", "__spec__", "__loader__", "__builtins__"}
    | {"__dict__", "__cached__"}
)


class Function(NamedTuple):
    """A function at the top of a module; its location is its name."""

    name: str
    node: FunctionNode
    location: Location


class Class(NamedTuple):
    """A class at the top of a module; its location is its name."""

    name: str
    node: ast.ClassDef
    location: Location


_TEST_TOOLS = ("pytest", "unittest", "launch_testing")
"""Words in tests run by pytest or unittest."""


def is_in_tests(path: str) -> bool:
    """Return whether a file is a test, by its name or directory."""
    *directories, name = path.split("/")
    return (
        not {"test", "tests"}.isdisjoint(directories)
        or name == "conftest.py"
        or (name.endswith(".py") and name.startswith("test_"))
        or name.endswith(("_test.py", ".test.py"))
    )


def is_collected(name: str) -> bool:
    """Return whether pytest collects a file, by its name."""
    return name.startswith("test_") or name.endswith("_test.py")


class PythonModule(SyntaxTree):
    """A Python file; it is never imported or run."""

    @cached_property
    def shebang(self) -> tuple[str, Location] | None:
        """The first line if it starts with ``#!``, without its ending."""
        start = 1 if self.has_bom else 0
        if not self.source.text.startswith("#!", start):
            return None
        line = self.source.lines[0][start:]
        return line, self.source.location(start, start + len(line))

    @property
    def is_script(self) -> bool:
        """Whether the file has a shebang."""
        return self.shebang is not None

    @cached_property
    def docstring(self) -> str | None:
        """The module's docstring as its value."""
        return ast.get_docstring(self.tree, clean=False)

    @cached_property
    def in_tests(self) -> bool:
        """Whether the file is a test, by its name or directory."""
        return is_in_tests(self.path) and not self._is_program()

    def _is_program(self) -> bool:
        """Return whether a file is named like a test but is a program."""
        *directories, name = self.path.split("/")
        if name == "conftest.py" or not {"test", "tests"}.isdisjoint(directories):
            return False
        plain = [item.name for item in self.classes.values() if not item.node.bases]
        is_collected = any(name.startswith(("test", "Test")) for name in (*self.functions, *plain))
        return "main" in self.functions and not is_collected and not self.mentions(*_TEST_TOOLS)

    @cached_property
    def main_guard(self) -> Location | None:
        """The place of ``if __name__ == '__main__'``."""
        node = self.main_guard_node
        return self.location(node.test) if node else None

    @property
    def has_main_guard(self) -> bool:
        """Whether there is an ``if __name__ == '__main__'``."""
        return self.main_guard is not None

    @cached_property
    def main_guard_node(self) -> ast.If | None:
        """The statement ``if __name__ == '__main__'``."""
        for statement in self.tree.body:
            if isinstance(statement, ast.If) and is_main_test(statement.test):
                return statement
        return None

    @cached_property
    def passed_over(self) -> frozenset[ast.AST]:
        """The statements after one that leaves their block, such as a ``return``."""
        first: dict[tuple[ast.AST, str], int] = {}
        for kind in _LEAVING:
            for node in self.walk(kind):
                parent = self.parent(node)
                field, number = self.index.place(node)
                if parent is not None and field in {"body", "orelse"}:
                    first[parent, field] = min(number, first.get((parent, field), number))
        return frozenset(
            statement
            for (parent, field), number in first.items()
            for statement in getattr(parent, field)[number + 1 :]
        )

    # -- names

    @cached_property
    def functions(self) -> Mapping[str, Function]:
        """The functions defined at the top, the last of a name."""
        result = {}
        for name, bindings in self.index.bindings(self.tree).items():
            for binding in bindings:
                if isinstance(binding.node, ast.FunctionDef | ast.AsyncFunctionDef):
                    result[name] = Function(name, binding.node, self.name_location(binding.node))
        return result

    @cached_property
    def classes(self) -> Mapping[str, Class]:
        """The classes defined at the top, the last of a name."""
        result = {}
        for name, bindings in self.index.bindings(self.tree).items():
            for binding in bindings:
                if isinstance(binding.node, ast.ClassDef):
                    result[name] = Class(name, binding.node, self.name_location(binding.node))
        return result

    def defines(self, name: str) -> bool | None:
        """Return whether the module has an attribute of this name.

        ``None`` if unknown: a star import, a module ``__getattr__``, ``globals()``.
        """
        bindings = self.index.bindings(self.tree)
        kinds = {binding.kind for binding in bindings.get(name, ())} - {"annotation"}
        if kinds - {"deletion"} or name in MODULE_ATTRIBUTES:
            return None if "deletion" in kinds else True
        if "*" in bindings or "__getattr__" in bindings or self._writes_globals:
            return None
        return False

    @cached_property
    def _writes_globals(self) -> bool:
        return any(
            isinstance(call.func, ast.Name)
            and call.func.id in {"globals", "exec", "vars", "setattr", "__import__"}
            for call in self.walk(ast.Call)
        )

    # -- import statements

    @cached_property
    def imports(self) -> Sequence[Import]:
        """All imports, in the order of the text."""
        return read_imports(self, in_tests=self.in_tests)

    @cached_property
    def imports_by_root(self) -> Mapping[str, Sequence[Import]]:
        """The absolute imports by top-level package."""
        result: dict[str, list[Import]] = {}
        for import_ in self.imports:
            if import_.root:
                result.setdefault(import_.root, []).append(import_)
        return result
