"""Values assigned to names in the code of a node that equal parameters."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Mapping

from scaffold.api import Package, fact
from scaffold.api.formats import Scalar, YamlNode
from scaffold.api.parameters import number_of, scalar_type

_TRUE = frozenset({"y", "yes", "true", "on"})
"""The words, in lower case, that rcl reads as true."""


def comparable_in_file(node: YamlNode) -> str:
    """Return the same for a value in a parameter file."""
    if not isinstance(node, Scalar):
        return ""
    match scalar_type(node):
        case "bool":
            return comparable(node.text.lower() in _TRUE)
        case "string":
            return comparable(node.text)
    return comparable(number_of(node))


@fact
def own_texts(package: Package, path: str) -> frozenset[str]:
    """Return the texts that are written in a file, see `comparable`; raises ViewError."""
    constants = package.module(path).walk(ast.Constant)
    return frozenset(comparable(item.value) for item in constants if isinstance(item.value, str))


@fact
def own_values(package: Package, path: str) -> Mapping[str, frozenset[str]]:
    """Return the values of variables, attributes, arguments and keys in a file; see `comparable`.

    The names are in lower case and without underscores at the ends; raises ViewError.
    """
    result: dict[str, set[str]] = {}
    for name, value in _named(package.module(path).tree):
        try:
            text = comparable(ast.literal_eval(value))
        except (ValueError, TypeError, SyntaxError, MemoryError, RecursionError):
            continue
        result.setdefault(plain_name(name), set()).add(text)
    return {name: frozenset(texts) for name, texts in result.items()}


def _named(tree: ast.AST) -> Iterator[tuple[str, ast.expr]]:
    for node in ast.walk(tree):
        match node:
            case ast.Assign(targets=[ast.Name(id=name) | ast.Attribute(attr=name)], value=value):
                yield name, value
            case ast.AnnAssign(target=ast.Name(id=name) | ast.Attribute(attr=name)) if node.value:
                yield name, node.value
            case ast.keyword(arg=str(name), value=value):
                yield name, value
            case ast.Dict(keys=keys, values=values):
                for key, value in zip(keys, values, strict=True):
                    if isinstance(key, ast.Constant) and isinstance(key.value, str):
                        yield key.value, value
            case ast.arguments(args=args, defaults=defaults):
                with_defaults = args[len(args) - len(defaults) :]
                yield from (
                    (item.arg, value) for item, value in zip(with_defaults, defaults, strict=True)
                )


def comparable(value: object) -> str:
    """Return a text that is the same for equal values, such as 1 and 1.0; empty for a list."""
    if isinstance(value, int | float) and not isinstance(value, bool):
        return repr(float(value))
    return repr(value) if isinstance(value, bool | str) else ""


def plain_name(name: str) -> str:
    """Return the last part of a name in lower case, without outer underscores."""
    return name.rpartition(".")[2].lower().strip("_")
