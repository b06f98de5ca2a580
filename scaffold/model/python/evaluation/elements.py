"""The only origin of the elements of a container, such as clients in a dictionary."""

from __future__ import annotations

import ast
from collections.abc import Callable, Iterator, Sequence
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from scaffold.model.python.scopes import Binding
    from scaffold.model.python.syntax_tree import SyntaxTree

Follow = Callable[[ast.expr], ast.expr]
"""Returns the only value of an expression."""
_PUTTING = frozenset({"append", "add", "insert", "setdefault"})
_CHANGING = frozenset({"extend", "update"})


def only_element(module: SyntaxTree, container: ast.expr, follow: Follow) -> ast.expr | None:
    """Return the expression that creates all elements of a container; ``None`` if unknown."""
    if not isinstance(container, ast.Name | ast.Attribute):
        return None
    elements = [*_written(follow(container)), *_put(module, container)]
    return elements[0] if len(elements) == 1 else None


def looped_element(module: SyntaxTree, binding: Binding, follow: Follow) -> ast.expr | None:
    """Return the expression that creates all values of a loop variable; ``None`` if unknown."""
    target, place = binding.node, -1
    parent = module.parent(target)
    if isinstance(parent, ast.Tuple) and target in parent.elts:
        target, place = parent, parent.elts.index(target)
        parent = module.parent(target)
    if not isinstance(parent, ast.For | ast.comprehension) or parent.target is not target:
        return None
    match parent.iter, place:
        case (ast.Call(func=ast.Attribute(attr="values", value=table), args=[]), -1) | (
            ast.Call(func=ast.Attribute(attr="items", value=table), args=[]),
            1,
        ):
            return only_element(module, table, follow)
        case (ast.Call(func=ast.Name(id="enumerate"), args=[items, *_]), 1) | (
            ast.Name() | ast.Attribute() as items,
            -1,
        ):
            is_list = isinstance(follow(items), ast.List | ast.ListComp | ast.Tuple)
            return only_element(module, items, follow) if is_list else None
    return None


def _written(literal: ast.expr) -> Sequence[ast.expr]:
    match literal:
        case ast.List(elts=elements) | ast.Tuple(elts=elements) | ast.Dict(values=elements):
            return elements
        case ast.ListComp(elt=element) | ast.DictComp(value=element):
            return [element]
        case ast.Call(func=ast.Name(id="list" | "dict"), args=[], keywords=[]):
            return []
    return [literal, literal]  # unknown


def _put(module: SyntaxTree, container: ast.Name | ast.Attribute) -> Iterator[ast.expr]:
    """Yield the values that statements add to a container."""
    index = module.index
    mentions: Sequence[ast.Name | ast.Attribute] = (
        index.uses_of(container)
        if isinstance(container, ast.Name)
        else index.attributes(container.attr)
    )
    for mention in mentions:
        parent = module.parent(mention)
        above = module.parent(parent) if parent is not None else None
        match parent, above:
            case ast.Subscript(value=of, ctx=ast.Store()), ast.Assign(value=value) if of is mention:
                yield value
            case ast.Attribute(attr=name), ast.Call(args=[*_, value]) if name in _PUTTING:
                yield value
            case ast.Attribute(attr=name), ast.Call() if name in _CHANGING:
                yield from (container, container)
            case ast.AugAssign(), _:
                yield from (container, container)
