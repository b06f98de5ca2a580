"""What connects the nodes of a package: each topic, service and action has one type."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import Any

from scaffold.generate.template import Question, Template
from scaffold.record import NamedTuple

_TYPED = {"service_name": "service", "action_name": "action", "topic": "message"}
"""The types of questions for names, and of those for what goes by such a name."""


class Clash(NamedTuple):
    """A name that two nodes use with different types: they would not connect."""

    asked: str
    """The type of the question for the name."""
    name: str
    types: tuple[str, str]
    nodes: tuple[str, str]

    def __str__(self) -> str:
        what = self.asked.partition("_")[0]
        (one, other), (node, neighbour) = self.types, self.nodes
        return (
            f"the {what} {self.name} is {one} in {node}, but {other} in {neighbour}: "
            "they do not connect; give both the same type, or another name to one"
        )


def clashes(
    nodes: Iterable[Mapping[str, Any]], templates: Mapping[str, Template]
) -> Iterator[Clash]:
    """Yield the names in the nodes of a package that stand for two types."""
    seen: dict[tuple[str, str], tuple[str, str]] = {}
    for node in nodes:
        for question, typed in pairs(templates[node["kind"]].questions):
            name, type_ = node[f"{question.name}_name"], node[typed.name].type
            first, neighbour = seen.setdefault((question.type, name), (type_, node["name"]))
            if first != type_:
                yield Clash(question.type, name, (first, type_), (neighbour, node["name"]))


def pairs(asked: Iterable[Question]) -> Iterator[tuple[Question, Question]]:
    """Yield the questions for names, each with the one for the type that goes by the name."""
    asked = list(asked)
    for question in asked:
        typed = _type_question(question, asked)
        if typed is not None:
            yield question, typed


def _type_question(question: Question, asked: Iterable[Question]) -> Question | None:
    """Return what asks for the type that belongs to a name: ``input_type`` to ``input_topic``."""
    wanted = _TYPED.get(question.type)
    found = [one for one in asked if wanted is not None and one.type == wanted]
    if len(found) > 1:
        stem = question.name.removesuffix("topic")
        found = [one for one in found if one.name in {f"{stem}type", f"{stem}message_type"}]
    return found[0] if len(found) == 1 else None
