"""The parameters that a file declares, and their defaults."""

from __future__ import annotations

import ast
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import cached_property
from typing import TYPE_CHECKING

from scaffold.model.python.evaluation.values import UNKNOWN, Unknown, is_known
from scaffold.record import NamedTuple

if TYPE_CHECKING:
    from scaffold.model.python.evaluation.evaluator import Element
    from scaffold.model.python.module import PythonModule
    from scaffold.model.rclpy.evaluation.evaluator import NodeEvaluator

    _Declaration = tuple[object, ast.expr | None]

SIGNATURES = {
    "declare_parameter": ("name", "value", "descriptor", "ignore_override"),
    "declare_parameters": ("namespace", "parameters", "ignore_override"),
}
_CHANGING = ("clear", "pop", "popitem", "setdefault", "update")
"""The methods that change which keys a dictionary has."""


class Declaration(NamedTuple):
    """The declaration of one parameter."""

    prefix: str | Unknown
    """The namespace of ``declare_parameters``."""
    name: ast.expr | None
    value: ast.expr | None
    descriptor: ast.expr | None


class Declarations:
    """The parameters that a file declares.

    Args:
        module: The file.
        evaluator: Evaluates its expressions; needs the declarations for parameters that are read.
        owner_of: Returns the node that an expression refers to.
        method_of: Returns the called method.
    """

    def __init__(
        self,
        module: PythonModule,
        evaluator: NodeEvaluator,
        owner_of: Callable[[ast.expr], object],
        method_of: Callable[[ast.Call], ast.Attribute | None],
    ) -> None:
        self._module = module
        self._evaluator = evaluator
        self._owner_of = owner_of
        self._method_of = method_of
        self._is_indexing = False

    def declarations_in(self, call: ast.Call, method: str) -> Iterator[Declaration]:
        """Yield the parameters that a call declares."""
        given = dict(zip(SIGNATURES[method], call.args, strict=False))
        given.update({word.arg: word.value for word in call.keywords if word.arg})
        if method == "declare_parameter":
            nodes = [given.get(word) for word in ("name", "value", "descriptor")]
            for row in self._rows(nodes[0]):
                yield Declaration("", *(_in_row(node, row) for node in nodes))
            return
        prefix = self._evaluator.text(given["namespace"]) if "namespace" in given else ""
        listed = given.get("parameters")
        if isinstance(listed, ast.ListComp) and isinstance(listed.elt, ast.Tuple):
            row_parts: list[ast.expr | None] = [*listed.elt.elts[:3], None, None]
            for row in self._rows(row_parts[0]):
                yield Declaration(prefix, *(_in_row(node, row) for node in row_parts[:3]))
            return
        value = self._evaluator.single_value(listed) if listed else None
        listed = value if isinstance(value, ast.Tuple) else listed  # which cannot be changed
        items, is_complete = self._evaluator.elements(listed) if listed else ((), True)
        if not is_complete:
            yield Declaration(UNKNOWN, None, None, None)
        for item in items:
            parts = _parts_of(item)
            if parts:
                value, descriptor = (parts[at] if len(parts) > at else None for at in (1, 2))
                yield Declaration(prefix, parts[0], value, descriptor)
            else:
                yield Declaration(UNKNOWN, None, None, None)

    def _rows(self, node: ast.expr | None) -> Sequence[Mapping[str, ast.expr]]:
        """Return the values of the variables of a loop per iteration, if a name is one of them.

        Such as ``name`` and ``default`` in ``for name, default in [('rate', 1.0), ...]:``.

        Returns:
            One iteration without variables if it is not a loop over a literal list.
        """
        index = self._module.index
        target = index.only_node(node)
        loop = index.parent(target) if target is not None else None
        if isinstance(loop, ast.Tuple):
            target, loop = loop, index.parent(loop)
        if not isinstance(loop, ast.For | ast.comprehension) or loop.target is not target:
            return [{}]
        turns = self._loop_items(loop.iter)
        if isinstance(target, ast.Name):
            return [{target.id: turn} for turn in turns] or [{}]
        rows: list[Mapping[str, ast.expr]] = []
        for turn in turns:
            names = target.elts if isinstance(target, ast.Tuple) else []
            parts = turn.elts if isinstance(turn, ast.Tuple | ast.List) else []
            if len(names) != len(parts):
                return [{}]
            pairs = zip(names, parts, strict=True)
            rows.append({name.id: part for name, part in pairs if isinstance(name, ast.Name)})
        return rows or [{}]

    def _loop_items(self, node: ast.expr) -> Sequence[ast.expr]:
        """Return the items of a list, or the pairs of a dictionary; empty if there may be more."""
        match node:
            case ast.Call(func=ast.Attribute(attr="items", value=dictionary), args=[]):
                pairs = self._pairs(dictionary)
                return [
                    ast.copy_location(ast.Tuple(elts=[key, value], ctx=ast.Load()), key)
                    for key, value in pairs
                ]
        if isinstance(node, ast.Name | ast.Attribute) and self._pairs(node):
            return [key for key, _ in self._pairs(node)]
        items, is_complete = self._evaluator.elements(node)
        parent = self._module.index.parent
        is_written = all(isinstance(parent(item.node), ast.List | ast.Tuple) for item in items)
        is_written = is_written and len({id(item.node) for item in items}) == len(items)
        if is_written or not is_complete:
            return [item.node for item in items] if is_complete else ()
        names = [item.value for item in items if isinstance(item.value, str)]
        if len(names) != len(items):
            return ()
        return [ast.copy_location(ast.Constant(name), node) for name in names]

    def _pairs(self, node: ast.expr) -> Sequence[tuple[ast.expr, ast.expr]]:
        """Return the entries of a dictionary, also of a constant; empty if there may be more."""
        pairs = self._evaluator.single_value(node)
        if pairs is node:
            return self._imported_pairs(node)
        if not isinstance(pairs, ast.Dict) or None in pairs.keys:
            return ()
        return (
            ()
            if self._is_changed(node)
            else [*zip(filter(None, pairs.keys), pairs.values, strict=True)]
        )

    def _imported_pairs(self, node: ast.expr) -> Sequence[tuple[ast.expr, ast.expr]]:
        """Return the entries of a dictionary literal, or of a constant of another module."""
        if isinstance(node, ast.Dict):
            is_whole = None not in node.keys
            return [*zip(filter(None, node.keys), node.values, strict=True)] if is_whole else ()
        value = self._evaluator.evaluate(node)
        if not isinstance(value, dict) or self._is_changed(node):
            return ()
        constants = [(ast.Constant(key), ast.Constant(item)) for key, item in value.items()]
        for pair in constants:
            for constant in pair:
                ast.copy_location(constant, node)
        return constants

    def _is_changed(self, dictionary: ast.expr) -> bool:
        """Return whether entries are added to a dictionary, or removed."""
        module = self._module
        text = module.text(dictionary)
        return module.mentions(*(f"{text}.{name}(" for name in _CHANGING)) or any(
            not isinstance(entry.ctx, ast.Load) and module.text(entry.value) == text
            for entry in module.walk(ast.Subscript)
        )

    def full_name(self, prefix: str | Unknown, name: ast.expr | None) -> str | Unknown:
        """Return a parameter's name with its namespace."""
        text = self._evaluator.text(name)
        if text is UNKNOWN or prefix is UNKNOWN:
            return UNKNOWN
        return f"{prefix}.{text}" if prefix else text

    def values_of(self, owner: object, name: str) -> Sequence[ast.expr | None]:
        """Return the defaults of a parameter that a node, or an unknown one, declares.

        Args:
            owner: The node; ``None`` if unknown.
            name: The parameter.
        """
        return [
            value
            for declarer, value in self._declarations.get(name, ())
            if declarer is owner or owner is None or declarer is None
        ]

    @property
    def _declarations(self) -> Mapping[str, Sequence[_Declaration]]:
        """Owner and default of the declared parameters with known names."""
        if self._is_indexing:
            self._evaluator.cut()
            return {}
        return self._index

    @cached_property
    def _index(self) -> Mapping[str, Sequence[_Declaration]]:
        self._is_indexing = True
        result: dict[str, list[_Declaration]] = {}
        for call in self._module.walk(ast.Call):
            func = self._method_of(call)
            if func is not None and func.attr in SIGNATURES:
                owner = self._owner_of(func.value)
                for item in self.declarations_in(call, func.attr):
                    text = self.full_name(item.prefix, item.name)
                    if isinstance(text, str):
                        result.setdefault(text, []).append((owner, item.value))
        self._is_indexing = False
        return result


def _parts_of(item: Element) -> Sequence[ast.expr]:
    """Return the parts of a row of a table, also of a constant of another module."""
    if isinstance(item.node, ast.Tuple | ast.List):
        return item.node.elts
    if not isinstance(item.value, list | tuple) or not is_known(item.value):
        return ()
    return [ast.copy_location(ast.Constant(part), item.node) for part in item.value]


def _in_row(node: ast.expr | None, row: Mapping[str, ast.expr]) -> ast.expr | None:
    """Return the value of an expression in an iteration."""
    return row.get(node.id, node) if isinstance(node, ast.Name) else node
