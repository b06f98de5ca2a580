"""The values of module-level names, for other modules of the package."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING

from scaffold.model.facts import fact
from scaffold.model.python.evaluation.evaluator import Evaluator
from scaffold.model.python.evaluation.values import is_known

if TYPE_CHECKING:
    from scaffold.model.package import Package
    from scaffold.model.python.module import PythonModule

_MAKING = frozenset({"__init__", "__new__", "__post_init__", "__getattribute__"})
"""Methods that may override the class attributes of an object."""


@fact
def constants_of(package: Package, path: str) -> Mapping[str, object]:
    """Return the constants of a Python file, and the values in its classes; raises ViewError.

    Constants are in capitals: other names may be changed by any code. A value in a class,
    such as the default of a dataclass, is prefixed with the class: ``Topics.image``.
    """
    return dict(_constants(package.module(path)))


def _constants(module: PythonModule) -> Iterator[tuple[str, object]]:
    evaluator = Evaluator(module)
    scopes: list[tuple[str, ast.AST]] = [("", module.tree)]
    scopes += [
        (f"{name}.", class_.node)
        for name, class_ in module.classes.items()
        if _MAKING.isdisjoint(module.index.bindings(class_.node))
    ]
    for prefix, scope in scopes:
        for name, bindings in module.index.bindings(scope).items():
            given = [binding for binding in bindings if binding.kind != "annotation"]
            if len(given) != 1 or given[0].kind != "assignment" or not (prefix or name.isupper()):
                continue
            value = evaluator.evaluate(given[0].value)
            if _is_plain(value):
                yield prefix + name, value


def _is_plain(value: object) -> bool:
    if isinstance(value, list | tuple):
        return all(map(_is_plain, value))
    if isinstance(value, dict):
        return all(_is_plain(part) for pair in value.items() for part in pair)
    return value is None or (type(value) in {bool, int, float, str} and is_known(value))
