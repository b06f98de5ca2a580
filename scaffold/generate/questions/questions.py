"""Collects answers from flags, an answers file and the user's configuration.

The flags are the questions of all templates. The first source with an answer is used: flag, answers
file, configuration, default of the template, user (git, login).
"""

from __future__ import annotations

import argparse
import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from difflib import get_close_matches
from typing import Any

from scaffold.errors import InputError
from scaffold.generate import yaml_file
from scaffold.generate.questions.answer_types import TYPES
from scaffold.generate.questions.qos import NAMES
from scaffold.generate.templates.template import Question, Template
from scaffold.record import NamedTuple

SEVERAL = "several"
"""The type of a question with a choice of several items."""
INTERFACES: Mapping[str, str] = {"message": "msg", "service": "srv", "action": "action"}
"""The kinds of interfaces by the types of questions for them."""


class Given(NamedTuple):
    """An answer of the user, and its source."""

    value: Any
    origin: str
    """For messages: ``--rate``, or a file and a key."""


def unique(templates: Iterable[Template]) -> list[Question]:
    """Return the questions of templates without duplicate names, in their order."""
    result: dict[str, Question] = {}
    for template in templates:
        for question in template.questions:
            result.setdefault(question.name, question)
    return list(result.values())


def shared(templates: Iterable[Template]) -> list[Question]:
    """Return the questions with the merged help of all their templates.

    A default that differs between templates is omitted.
    """
    result: dict[str, Question] = {}
    for template in templates:
        for question in template.questions:
            first = result.setdefault(question.name, question)
            helps = dict.fromkeys([*first.help.split("; "), question.help])
            default = first.default if first.default == question.default else None
            result[question.name] = first._replace(help="; ".join(helps), default=default)
    return list(result.values())


def add_flags(
    parser: argparse.ArgumentParser | argparse._ArgumentGroup,
    questions: Iterable[Question],
    kinds: Mapping[str, Sequence[Question]] | None = None,
) -> None:
    """Define a flag, or a positional argument, for each question.

    Values are validated later, with a one-line error instead of argparse's usage text.

    Args:
        parser: The parser of the verb, or a group of its flags.
        questions: Each becomes a flag.
        kinds: The kinds of parts and their questions, for tab completion.
    """
    for question in questions:
        options: dict[str, Any] = {"help": _help(question), "metavar": _metavar(question)}
        if question.type in {"dependencies", "fields", SEVERAL}:
            options |= {"nargs": "+", "action": "extend"}
        elif question.type in {"parts", "distributions"}:
            options |= {"action": "append"}
        if question.is_positional:
            parser.add_argument(question.name, nargs="?", **options)
            continue
        action = parser.add_argument(flag(question.name), **options)
        is_part = question.type == "parts"
        offer = _part_completer(kinds or {}) if is_part else completer(question)
        action.completer = offer  # type: ignore[attr-defined]  # argcomplete


def flag(name: str) -> str:
    """Return the flag of a question."""
    return "--" + name.replace("_", "-")


def _help(question: Question) -> str:
    """Return the help, with the choices where the flag itself does not show them."""
    details: list[str] = []
    if question.choices and question.metavar:
        details.append(", ".join(question.choices))
    if question.default not in (None, []) and "{" not in str(question.default):
        default = question.default
        shown = _listed(question, default) if isinstance(default, list) else default
        details.append(f"default: {shown}")
    text = f"{question.help} ({'; '.join(details)})" if details else question.help
    return text.replace("%", "%%")


def _listed(question: Question, default: Sequence[object]) -> str:
    """Return several answers as written after the flag; fields have spaces and need quotes."""
    if question.type == "fields":
        return " ".join(f"'{item}'" for item in default)
    return ", ".join(map(str, default))


def _metavar(question: Question) -> str:
    if question.choices and not question.metavar:
        return "{" + ",".join(question.choices) + "}"
    return question.metavar or question.name.rpartition("_")[2].upper()


def completer(question: Question) -> Callable[..., Sequence[str]] | None:
    """Return the tab completer of a question; ``None`` for file names."""
    if question.choices:
        return lambda **_: question.choices
    if question.type in INTERFACES:
        return lambda prefix, **_: _interfaces(INTERFACES[question.type], prefix)
    if question.type == "qos":
        return lambda **_: NAMES
    return None if question.type in {"text", "person", "address"} else lambda **_: ()


def _part_completer(kinds: Mapping[str, Sequence[Question]]) -> Callable[..., Sequence[str]]:
    """Return the completer of ``--add``: kinds, and after a name questions and answers."""

    def offer(prefix: str, **_: object) -> list[str]:
        before, space, word = prefix.rpartition(" ")
        asked = kinds.get(before.partition(":")[0], ())
        name, equals, answer = word.partition("=")
        if not space:
            return [f"{kind}:" for kind in kinds]
        if not equals:
            return [f"{before} {item.name}=" for item in asked if not item.name.endswith("_name")]
        offers = [completer(item) for item in asked if item.name == name]
        values = [value for item in offers if item is not None for value in item(prefix=answer)]
        return [f"{before} {name}={value}" for value in values]

    return offer


def _interfaces(kind: str, prefix: str) -> list[str]:
    """Return the full types of a kind, or only their names if the prefix is capitalized."""
    from scaffold.generate import payload

    names = [name for name in payload.definitions().all_names() if f"/{kind}/" in name]
    if prefix[:1].isupper():
        return sorted({name.rpartition("/")[2] for name in names})
    return names


def from_flags(options: argparse.Namespace, questions: Iterable[Question]) -> dict[str, Given]:
    """Return the answers on the command line."""
    return {
        question.name: Given(
            getattr(options, question.name),
            question.name.upper() if question.is_positional else flag(question.name),
        )
        for question in questions
        if getattr(options, question.name, None) is not None
    }


def from_file(path: str, questions: Iterable[Question]) -> dict[str, Given]:
    """Return the answers in a YAML file.

    Raises:
        InputError: it cannot be read, is not a mapping, or answers a question that does not exist.
    """
    entries = yaml_file.read(path)
    if not isinstance(entries, dict):
        raise InputError(f"{path}: must be a mapping of questions to answers, such as 'rate: 2.0'")
    return from_table({key: Given(value, path) for key, value in entries.items()}, questions)


def from_table(entries: Mapping[str, Given], questions: Iterable[Question]) -> dict[str, Given]:
    """Return the entries of a table by question; keys are written with ``_`` or ``-``.

    Raises:
        InputError: a key is not a question.
    """
    names = {question.name for question in questions}
    result: dict[str, Given] = {}
    for key, given in entries.items():
        name = key.replace("-", "_")
        if name not in names:
            closest = get_close_matches(name, names, n=1)
            hint = f"did you mean {closest[0]}?" if closest else "see `ros2-scaffold new --help`"
            raise InputError(f"{given.origin}: {key!r} is not a question of the templates; {hint}")
        if given.value is not None:
            result[name] = Given(given.value, f"{given.origin}: {key}")
    return result


class Answers(NamedTuple):
    """The answers to some questions by name."""

    values: dict[str, Any]
    written: dict[str, Any]
    """The answers in the form of an answers file."""


def resolve(
    questions: Sequence[Question],
    given: Mapping[str, Given],
    *,
    context: Mapping[str, Any],
    render: Callable[[str, Mapping[str, Any]], str],
    fallback: Callable[[str], Given | None],
    where: str = ".",
) -> Answers:
    """Return an answer for every question.

    Defaults without Jinja come first, so that other defaults may use them.

    Args:
        questions: The questions of the chosen templates.
        given: The user's answers, each from the source that takes precedence.
        context: Variables for defaults besides the answers.
        render: Renders a Jinja text over answers.
        fallback: Returns the answer to a question without a default, by its name.
        where: The directory of the package.

    Raises:
        InputError: an answer is missing or invalid; the message names its source.
    """
    answers = Answers({}, {})

    def add(question: Question, answer: Given) -> None:
        value = answers.values[question.name] = parse(question, answer, where)
        is_list = question.type == "distributions" or (
            question.type == SEVERAL and question.choices
        )
        is_derived_rate = question.type == "rate" and answer.origin == "default"
        written = value if is_derived_rate else answer.value
        answers.written[question.name] = [*value] if is_list else written

    later = [item for item in questions if item.name not in given and is_derived(item.default)]
    for question in questions:
        if question not in later:
            add(question, given.get(question.name) or _default(question, fallback))
    while later:
        question = _independent(later)
        later.remove(question)
        text = render(question.default, {**context, **answers.values})
        add(question, Given(text, "default"))
    names = [question.name for question in questions]
    return Answers(
        {name: answers.values[name] for name in names},
        {name: answers.written[name] for name in names},
    )


def is_derived(default: object) -> bool:
    """Return whether a default depends on other answers."""
    return isinstance(default, str) and "{" in default


def _independent(later: Sequence[Question]) -> Question:
    """Return the first question whose default does not depend on another one of them."""
    names = {question.name for question in later}
    for question in later:
        if not (names - {question.name}) & {*re.findall(r"\w+", question.default)}:
            return question
    return later[0]


def _default(question: Question, fallback: Callable[[str], Given | None]) -> Given:
    if question.default is not None:
        return Given(question.default, "default")
    result = fallback(question.name)
    if result is None:
        raise InputError(f"{flag(question.name)} is required: {question.help}")
    return result


def parse(question: Question, given: Given, where: str = ".") -> Any:  # noqa: ANN401  as its type says
    """Return the value of an answer, for a package in a directory.

    Raises:
        InputError: it is not acceptable.
    """
    if question.choices and question.type == SEVERAL:
        chosen = (choose(word, question.choices, given.origin) for word in _words(given.value))
        return tuple(dict.fromkeys(chosen))
    if question.choices:
        given = given._replace(value=choose(given.value, question.choices, given.origin))
    try:
        return TYPES[question.type](given.value, where)
    except InputError as error:
        whose = f"the default of {question.name!r}" if given.origin == "default" else given.origin
        raise InputError(f"{whose}: {error}") from error


def _words(given: object) -> Iterator[object]:
    """Yield the items of an answer: a list, a comma-separated text, or both."""
    for word in given if isinstance(given, list | tuple) else [given]:
        yield from map(str.strip, word.split(",")) if isinstance(word, str) else (word,)


def choose(given: object, choices: Sequence[str], origin: str) -> str:
    """Return the given choice.

    Raises:
        InputError: it is unknown; the message names the closest ones.
    """
    word = str(given)
    if word not in choices:
        raise InputError(f"{origin}: {_no_choice(word, choices)}")
    return word


def _no_choice(word: str, choices: Sequence[str]) -> str:
    """Return a message that lists the choices and suggests the closest ones."""
    by_lower = {choice.lower(): choice for choice in choices}
    closest = get_close_matches(word.lower(), by_lower, n=3, cutoff=0.7)
    if not closest and len(word) >= _TELLING:
        closest = [choice for choice in by_lower if choice.startswith(word[:_TELLING].lower())]
    hint = f"; did you mean {' or '.join(by_lower[item] for item in closest)}?" if closest else ""
    is_short = len(choices) <= _LISTED or not hint
    listed = ", ".join(choices) if is_short else f"the {len(choices)} choices"
    return f"{word!r} is not one of {listed}{hint}"


_TELLING = 3
_LISTED = 15
"""The number of choices that are listed in addition to a suggestion."""
"""Letters at the start of a word that identify it: ``GPLv3``, ``BSD``."""
