"""Bases and descendants of the classes in a file."""

from __future__ import annotations

import ast
from collections.abc import Mapping, Sequence
from functools import cached_property

from scaffold.model.python.module import PythonModule


class ClassRelations:
    """The classes of a file that inherit from each other."""

    def __init__(self, module: PythonModule) -> None:
        self._module = module

    def related(self, node: ast.ClassDef) -> Sequence[ast.ClassDef]:
        """Return a class with the bases and descendants it has in the file."""
        related = [node]
        bases = self._local_bases
        pending = [node]
        while pending:
            for base in bases.get(pending.pop(), ()):
                if base not in related:
                    related.append(base)
                    pending.append(base)
        below = [node]
        for current in below:
            for other in self._module.walk(ast.ClassDef):
                if current in bases.get(other, ()) and other not in related:
                    related.append(other)
                    below.append(other)
        return related

    @cached_property
    def _local_bases(self) -> Mapping[ast.ClassDef, Sequence[ast.ClassDef]]:
        result: dict[ast.ClassDef, list[ast.ClassDef]] = {}
        for node in self._module.walk(ast.ClassDef):
            for expression in node.bases:
                for binding in self._module.index.bindings_of(expression):
                    if isinstance(binding.node, ast.ClassDef):
                        result.setdefault(node, []).append(binding.node)
        return result
