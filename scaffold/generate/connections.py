"""What connects the nodes of a package: each topic, service and action has one type."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import TYPE_CHECKING, Any

from scaffold.generate.templates.template import Question, Template
from scaffold.record import NamedTuple

if TYPE_CHECKING:
    from scaffold.source import Location

_TYPED = {"service_name": "service", "action_name": "action", "topic": "message"}
"""The types of questions for names, and of those for the type behind such a name."""


class Use(NamedTuple):
    """A node that uses a topic, a service or an action."""

    kind: str
    """``topic``, ``service`` or ``action``."""
    name: str
    """In full."""
    type: str
    node: str
    location: Location | None = None
    """Where it is in code."""
    is_fixed: bool = False
    """No parameter changes the name."""

    def __str__(self) -> str:
        at = f", {self.location.path}:{self.location.line}" if self.location else ""
        return f"{self.type} in {self.node}{at}"


class Clash(NamedTuple):
    """A name that two nodes use with different types: they would not connect."""

    first: Use
    other: Use

    def __str__(self) -> str:
        return (
            f"the {self.first.kind} {self.first.name} is {self.first}, but {self.other}: "
            "they do not connect; give both the same type, or another name to one"
        )


def clashes(used: Iterable[Use]) -> Iterator[Clash]:
    """Yield the uses of a name with another type than the first use of it has."""
    seen: dict[tuple[str, str], Use] = {}
    for use in used:
        first = seen.setdefault((use.kind, use.name), use)
        if first.type != use.type:
            yield Clash(first, use)


def uses(nodes: Iterable[Mapping[str, Any]], templates: Mapping[str, Template]) -> Iterator[Use]:
    """Yield what nodes use according to the answers they are made with."""
    for node in nodes:
        for question, typed in pairs(templates[node["kind"]].questions):
            kind, name = question.type.partition("_")[0], node[f"{question.name}_name"]
            yield Use(kind, name, node[typed.name].type, node["name"])


def pairs(questions: Iterable[Question]) -> Iterator[tuple[Question, Question]]:
    """Yield the questions for names, each with the one for the type behind the name."""
    questions = list(questions)
    for question in questions:
        typed = _type_question(question, questions)
        if typed is not None:
            yield question, typed


def _type_question(question: Question, others: Iterable[Question]) -> Question | None:
    """Return what asks for the type that belongs to a name: ``input_type`` to ``input_topic``."""
    wanted = _TYPED.get(question.type)
    result = [item for item in others if wanted is not None and item.type == wanted]
    if len(result) > 1:
        stem = question.name.removesuffix("topic")
        result = [item for item in result if item.name in {f"{stem}type", f"{stem}message_type"}]
    return result[0] if len(result) == 1 else None
