"""The topics, services and actions that connect nodes: types and QoS."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import TYPE_CHECKING, Any

from scaffold.generate.questions.names import resolve
from scaffold.generate.questions.questions import Given
from scaffold.generate.templates.template import Question, Role, Template
from scaffold.record import NamedTuple

if TYPE_CHECKING:
    from scaffold.source import Location

_TYPED = {"service_name": "service", "action_name": "action", "topic": "message"}
"""The types of questions for names, and those of the questions for the types of these names."""


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
    direction: str = ""
    """Of a topic: ``published`` or ``subscribed``; empty if that is not known."""
    reliability: str = ""
    """Of a topic: ``reliable``, ``best_effort``; empty if that is not known."""
    durability: str = ""
    """Of a topic: ``volatile``, ``transient_local``; empty if that is not known."""

    @property
    def qos(self) -> str:
        """The quality of service as a user would write it for the other side."""
        if self.durability == "transient_local":
            return "latched" if self.reliability == "reliable" else "best_effort,transient_local"
        return "sensor_data" if self.reliability == "best_effort" else "10"

    def __str__(self) -> str:
        at = f", {self.location.path}:{self.location.line}" if self.location else ""
        return f"{self.type} in {self.node}{at}"


class Mismatch(NamedTuple):
    """A topic whose subscription requests more than its publisher offers."""

    publisher: Use
    subscription: Use

    def __str__(self) -> str:
        offered, requested = _differing(self.publisher, self.subscription)
        return (
            f"the topic {self.publisher.name} is published {offered} by {_place(self.publisher)}, "
            f"but the subscription of {_place(self.subscription)} is {requested}: they do not "
            "connect; use the same quality of service for both"
        )


def _place(use: Use) -> str:
    return f"{use.node}, {use.location.path}:{use.location.line}" if use.location else use.node


def _differing(publisher: Use, subscription: Use) -> tuple[str, str]:
    """Return the offered and the requested setting that differ; empty if they connect."""
    if (publisher.reliability, subscription.reliability) == ("best_effort", "reliable"):
        return "best effort", "reliable"
    if (publisher.durability, subscription.durability) == ("volatile", "transient_local"):
        return "volatile", "transient local"
    return "", ""


class Clash(NamedTuple):
    """A name that two nodes use with different types: they would not connect."""

    first: Use
    other: Use

    def __str__(self) -> str:
        return (
            f"the {self.first.kind} {self.first.name} is {self.first}, but {self.other}: "
            "they do not connect; use the same type for both, or different names"
        )


def clashes(used: Iterable[Use]) -> Iterator[Clash]:
    """Yield the uses of a name with another type than the first use of it has."""
    seen: dict[tuple[str, str], Use] = {}
    for use in used:
        first = seen.setdefault((use.kind, use.name), use)
        if first.type != use.type:
            yield Clash(first, use)


def mismatches(used: Iterable[Use]) -> Iterator[Mismatch]:
    """Yield publishers and subscriptions of one topic and type that do not connect."""
    uses = list(used)
    for publisher in uses:
        for subscription in uses:
            is_pair = (publisher.direction, subscription.direction) == ("published", "subscribed")
            is_same = (publisher.name, publisher.type) == (subscription.name, subscription.type)
            if is_pair and is_same and any(_differing(publisher, subscription)):
                yield Mismatch(publisher, subscription)


def conflicts(nodes: Iterable[Mapping[str, Any]], templates: Mapping[str, Template]) -> list[str]:
    """Return why nodes would not connect, according to their answers."""
    used = list(uses(nodes, templates))
    return [str(conflict) for conflict in (*clashes(used), *mismatches(used))]


def uses(nodes: Iterable[Mapping[str, Any]], templates: Mapping[str, Template]) -> Iterator[Use]:
    """Yield the topics, services and actions of nodes, according to their answers."""
    for node in nodes:
        yield from _uses_of(templates[node["kind"]], node, node["name"])


def _uses_of(template: Template, answers: Mapping[str, Any], node: str) -> Iterator[Use]:
    for question, typed in pairs(template.questions):
        kind, name = question.type.partition("_")[0], resolve(answers[question.name], node)
        asked = qos_question(question, template.questions)
        qos = answers[asked.name] if asked is not None else None
        yield Use(
            kind,
            name,
            answers[typed.name].type,
            node,
            direction=question.direction,
            reliability=qos.reliability if qos is not None else "",
            durability=qos.durability if qos is not None else "",
        )


class Open(NamedTuple):
    """A part with answers that may still be derived from other parts."""

    template: Template
    answers: Mapping[str, Any]
    explicit: frozenset[str]
    """The questions that the user has answered."""

    @property
    def node(self) -> str:
        """The name of the node."""
        return str(self.answers[self.template.name_question])

    @property
    def uses(self) -> list[Use]:
        """What it uses, if it is a node."""
        if self.template.role is not Role.NODE:
            return []
        return list(_uses_of(self.template, self.answers, self.node))


def agreed_types(part: Open, others: Iterable[Open], uses: Iterable[Use]) -> dict[str, Given]:
    """Return the types that a part takes from other parts with the same topic, service or action.

    Args:
        part: The part; types that the user has given are kept.
        others: The other parts of the package.
        uses: What the existing nodes use.
    """
    theirs = [(use.kind, use.name, use.type) for use in uses]
    for other in others:
        for (_, typed), use in zip(pairs(other.template.questions), other.uses, strict=False):
            if typed.name in other.explicit:
                theirs.append((use.kind, use.name, use.type))
    result: dict[str, Given] = {}
    for (question, typed), use in zip(pairs(part.template.questions), part.uses, strict=False):
        types = [type_ for kind, name, type_ in theirs if (kind, name) == (use.kind, use.name)]
        is_open = question.name in part.explicit and typed.name not in part.explicit
        choices = typed.choices or types
        if is_open and use.type not in types and types and types[0] in choices:
            result[typed.name] = Given(types[0], "default")
    return result


def agreed_qos(part: Open, others: Iterable[Open], uses: Iterable[Use]) -> dict[str, Given]:
    """Return the QoS answers that a part takes from others, to connect with them."""
    theirs = [use for other in others for use in other.uses] + list(uses)
    result: dict[str, Given] = {}
    for (question, _), use in zip(pairs(part.template.questions), part.uses, strict=False):
        asked = qos_question(question, part.template.questions)
        for other in theirs if asked is not None and asked.name not in part.explicit else ():
            if asked is not None and any(True for _ in mismatches([use, other])):
                result[asked.name] = Given(other.qos, "default")
    return result


def qos_question(topic: Question, questions: Iterable[Question]) -> Question | None:
    """Return the question for the QoS of a topic: ``input_qos`` of ``input_topic``."""
    if topic.type != "topic":
        return None
    asked = {question.name: question for question in questions if question.type == "qos"}
    return asked.get(topic.name.replace("topic", "qos"), asked.get("qos"))


def pairs(questions: Iterable[Question]) -> Iterator[tuple[Question, Question]]:
    """Yield the questions for names, each with the question for its type."""
    questions = list(questions)
    for question in questions:
        typed = _type_question(question, questions)
        if typed is not None:
            yield question, typed


def _type_question(question: Question, others: Iterable[Question]) -> Question | None:
    """Return the question for the type of a name: ``input_type`` of ``input_topic``."""
    wanted = _TYPED.get(question.type)
    result = [item for item in others if wanted is not None and item.type == wanted]
    if len(result) > 1:
        stem = question.name.removesuffix("topic")
        result = [item for item in result if item.name in {f"{stem}type", f"{stem}message_type"}]
    return result[0] if len(result) == 1 else None
