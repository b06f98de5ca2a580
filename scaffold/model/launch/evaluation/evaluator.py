"""Static evaluation of expressions in launch files: share paths, substitutions."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from typing import TYPE_CHECKING

from scaffold.model.launch.calls import launch_call
from scaffold.model.python.evaluation.evaluator import Evaluator
from scaffold.model.python.evaluation.given_arguments import given_once
from scaffold.model.python.evaluation.values import UNKNOWN, PathValue, Unknown, join_paths

if TYPE_CHECKING:
    from scaffold.model.python.module import PythonModule

SHARE = "/<share>/"
"""The prefix of a package name that stands for its share directory in values."""


class LaunchEvaluator(Evaluator):
    """An evaluator that knows share directories and constant substitutions."""

    module: PythonModule

    def __init__(self, module: PythonModule, package_name: str) -> None:
        super().__init__(module)
        self._package_name = package_name

    @contextmanager
    def bound(self, values: Mapping[tuple[ast.AST, str], object]) -> Iterator[None]:
        """Bind variables of functions and loops to values temporarily."""
        outer = self._local
        self._local = {**outer, **values}
        try:
            yield
        finally:
            self._local = outer

    def argument(self, node: ast.arg) -> object:
        """Return the argument for a parameter in the only call of a function of the file."""
        given = given_once(self.module, node)
        return UNKNOWN if given is None else self.evaluate(given)

    def call(self, node: ast.Call) -> object:
        """Return the value of a call of launch, for a substitution its text."""
        launch = launch_call(self.module, node)
        if launch is None:
            return self._found_package(node)
        value: object = UNKNOWN
        match launch.kind:
            case "get_package_share_directory" | "FindPackageShare":
                value = self._share(next(iter(launch.given.values()), None))
            case "get_package_share_path":
                share = self._share(next(iter(launch.given.values()), None))
                value = PathValue(share) if isinstance(share, str) else UNKNOWN
            case "PathJoinSubstitution":
                value = self._join(launch.given.get("substitutions"))
            case "TextSubstitution":
                value = self.text(launch.given.get("text"))
            case "FindExecutable":  # a path that ends in the name, and is used like it
                value = self.joined_text(launch.given.get("name"))
            case "ThisLaunchFileDir":
                directory = self.module.path.rpartition("/")[0]
                value = f"{SHARE}{self._package_name}/{directory}".rstrip("/")
        return value

    def joined_text(self, node: ast.expr | None) -> str | Unknown:
        """Return the text of a substitution, or of a list of them, which launch joins."""
        return joined_value(self.evaluate(node))

    def _share(self, node: ast.expr | None) -> str | Unknown:
        name = self.joined_text(node)
        return f"{SHARE}{name}" if isinstance(name, str) and "/" not in name else UNKNOWN

    def _join(self, node: ast.expr | None) -> str | Unknown:
        value = self.evaluate(node)
        if not isinstance(value, list | tuple) or not value:
            return UNKNOWN
        parts = [joined_value(part) for part in value]
        texts = [part for part in parts if isinstance(part, str)]
        return join_paths(texts) if len(texts) == len(parts) else UNKNOWN

    def _found_package(self, node: ast.Call) -> str | Unknown:
        """Return the value of ``FindPackageShare(...).find('name')``."""
        match node.func:
            case ast.Attribute(value=ast.Call() as holder, attr="find") if node.args:
                finder = launch_call(self.module, holder)
                if finder is not None and finder.kind == "FindPackageShare":
                    return self._share(node.args[0])
        return UNKNOWN


def share_path(value: object) -> tuple[str, str] | None:
    """Split a value into the package and the path below its share directory."""
    text = value.text if isinstance(value, PathValue) else value
    if not isinstance(text, str) or not text.startswith(SHARE):
        return None
    package, _, rest = text.removeprefix(SHARE).partition("/")
    parts: list[str] = []
    for part in rest.split("/"):
        if part == ".." and not parts:
            return None
        if part == "..":
            parts.pop()
        elif part not in {"", "."}:
            parts.append(part)
    return (package, "/".join(parts)) if parts else None


def joined_value(value: object) -> str | Unknown:
    """Return the text of a value: substitutions in a list are joined without a separator."""
    if isinstance(value, PathValue):
        return value.text
    if isinstance(value, list | tuple):
        parts = [joined_value(part) for part in value]
        texts = [part for part in parts if isinstance(part, str)]
        return "".join(texts) if len(texts) == len(parts) else UNKNOWN
    return value if isinstance(value, str) else UNKNOWN
