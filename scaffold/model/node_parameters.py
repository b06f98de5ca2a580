"""Which parameters a file declares, and their defaults."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property
from typing import TYPE_CHECKING

from scaffold.model.node_owners import NodeClass
from scaffold.model.values import UNKNOWN, Unknown, same
from scaffold.record import NamedTuple

if TYPE_CHECKING:
    from scaffold.model.node_owners import NodeOwner
    from scaffold.model.nodes import NodeFacts

    _Declaration = tuple[NodeOwner | None, ast.expr | None]

SIGNATURES = {
    "declare_parameter": ("name", "value", "descriptor", "ignore_override"),
    "declare_parameters": ("namespace", "parameters", "ignore_override"),
}


class Declaration(NamedTuple):
    """What one parameter is declared with."""

    prefix: str | Unknown
    """The namespace of ``declare_parameters``."""
    name: ast.expr | None
    value: ast.expr | None
    descriptor: ast.expr | None


class Declarations:
    """The parameters that a file declares."""

    def __init__(self, facts: NodeFacts) -> None:
        self._facts = facts
        self._is_indexing = False

    def declarations_in(self, call: ast.Call, method: str) -> Iterator[Declaration]:
        """Yield the parameters that a call declares."""
        given = dict(zip(SIGNATURES[method], call.args, strict=False))
        given.update({word.arg: word.value for word in call.keywords if word.arg})
        if method == "declare_parameter":
            yield Declaration("", given.get("name"), given.get("value"), given.get("descriptor"))
            return
        prefix = self._facts.evaluator.text(given["namespace"]) if "namespace" in given else ""
        listed = given.get("parameters")
        for item in self._facts.evaluator.elements(listed).items if listed else ():
            if isinstance(item.node, ast.Tuple | ast.List) and item.node.elts:
                parts = item.node.elts
                value, descriptor = (parts[at] if len(parts) > at else None for at in (1, 2))
                yield Declaration(prefix, parts[0], value, descriptor)
            else:
                yield Declaration(UNKNOWN, None, None, None)

    def full_name(self, prefix: str | Unknown, name: ast.expr | None) -> str | Unknown:
        """Return a parameter's name with the namespace in front."""
        text = self._facts.evaluator.text(name)
        if text is UNKNOWN or prefix is UNKNOWN:
            return UNKNOWN
        return f"{prefix}.{text}" if prefix else text

    def default_of(self, receiver: ast.expr, name: str) -> object:
        """Return the default that all declarations of a parameter agree on."""
        owner = self._facts.owner_of(receiver)
        nodes = [
            value
            for declarer, value in self._declarations.get(name, ())
            if declarer is owner or owner is None or declarer is None
        ]
        if not nodes and isinstance(owner, NodeClass) and owner.base is not None:
            base = owner.base
            return UNKNOWN if base.facts is self._facts else base.facts.default_in(base, name)
        values = [self._facts.evaluator.evaluate(node) for node in nodes]
        return values[0] if values and all(same(value, values[0]) for value in values) else UNKNOWN

    @property
    def _declarations(self) -> Mapping[str, Sequence[_Declaration]]:
        """Owner and default of the declared parameters whose names are plain to see."""
        if self._is_indexing:
            self._facts.evaluator.cut()
            return {}
        return self._index

    @cached_property
    def _index(self) -> Mapping[str, Sequence[_Declaration]]:
        self._is_indexing = True
        found: dict[str, list[_Declaration]] = {}
        for call in self._facts.module.walk(ast.Call):
            func = self._facts.method_of(call)
            if func is not None and func.attr in SIGNATURES:
                owner = self._facts.owner_of(func.value)
                for one in self.declarations_in(call, func.attr):
                    text = self.full_name(one.prefix, one.name)
                    if isinstance(text, str):
                        found.setdefault(text, []).append((owner, one.value))
        self._is_indexing = False
        return found
