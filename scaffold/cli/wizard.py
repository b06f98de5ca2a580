"""``ros2-scaffold new`` on a terminal, without a name: asks the few questions that matter."""

from __future__ import annotations

import shlex
from collections.abc import Callable, Iterator, Mapping
from typing import TYPE_CHECKING, Any, NamedTuple

import questionary

from scaffold.errors import InputError
from scaffold.generate import parts, questions
from scaffold.generate.defaults import LOGIN, User
from scaffold.generate.questions import INTERFACES, SEVERAL, Given
from scaffold.generate.template import BASE, Question, Template

if TYPE_CHECKING:
    from scaffold.model.interfaces import Definitions

ORIGIN = "your answer"
_DONE = "nothing more"
_TOGETHER = {"fields": ";", "dependencies": " "}
"""What separates several values in one line, by the type of the answer."""


class Asked(NamedTuple):
    """What the user answered."""

    given: dict[str, Given]
    command: str
    """The command that does the same without questions."""


def ask(templates: Mapping[str, Template], given: Mapping[str, Given], user: User) -> Asked:
    """Ask what is not given yet.

    Args:
        templates: All templates.
        given: What flags, an answers file and the configuration say.
        user: Knows the maintainer.

    Raises:
        KeyboardInterrupt: the user wants no more questions.
    """
    base = {question.name: question for question in templates[BASE].questions}
    answers: dict[str, Any] = {}

    def settle(name: str, default: object = None) -> None:
        if name in base and name not in given:
            value = _ask(base[name], templates, default)
            if value not in (None, "", []):
                answers[name] = value

    settle("package")
    settle("build_type")
    build_type = str(answers.get("build_type") or given["build_type"].value)
    if not given.keys() & {parts.ADD, "node_kind", "node_name"}:
        answers[parts.ADD] = list(_parts(templates, build_type))
    settle("extras")
    settle("description")
    settle("license")
    for name in ("maintainer_name", "maintainer_email"):
        known = user.answer(name)
        if known is None or known.origin == LOGIN:
            settle(name, known.value if known else None)
    found = {name: Given(value, f"{ORIGIN}: {name}") for name, value in answers.items()}
    return Asked({**given, **found}, _command(answers, base, templates))


def _parts(templates: Mapping[str, Template], build_type: str) -> Iterator[dict[str, Any]]:
    """Ask for one part after the other, with the questions of its kind."""
    definitions = _definitions()
    taken: set[str] = set()
    while True:
        choices = [
            questionary.Choice(f"{name:20} {templates[name].summary}", value=name)
            for name in parts.kinds(templates)
            if not templates[name].build_types or build_type in templates[name].build_types
        ]
        if taken:
            choices.insert(0, questionary.Choice(_DONE, value=""))
        kind = _select(
            "What else is in the package?" if taken else "What is in the package?", choices
        )
        if not kind:
            return
        template, entry = templates[kind], {parts.KIND: kind}
        for question in template.questions:
            refused = taken if question.name == template.name_question else set()
            value = _ask(question, templates, None, definitions, refused)
            if question.name == template.name_question:
                entry[question.name] = value or question.default
                taken.add(entry[question.name])
            elif not _is_default(question, value):
                entry[question.name] = value
        yield entry


def _ask(
    question: Question,
    templates: Mapping[str, Template],
    default: object = None,
    definitions: Definitions | None = None,
    refused: set[str] = frozenset(),  # type: ignore[assignment]  # an empty one is never changed
) -> Any:  # noqa: ANN401  as the question wants
    """Ask one question until the answer is acceptable; an empty one takes the default."""
    text = f"{question.help[0].upper()}{question.help[1:].partition(' (')[0]}:"
    known = question.default if default is None else default
    if question.type == SEVERAL:
        return _several(text, question, templates)
    if question.choices:
        return _select(text, [_choice(name, templates) for name in question.choices], known)
    if question.type == "flag":
        return questionary.confirm(text, default=bool(known)).unsafe_ask()
    shown = _shown(question, known)
    check = _validator(question, refused)
    if definitions is not None and question.type in INTERFACES:
        middle = f"/{INTERFACES[question.type]}/"
        names = [name for name in definitions.all_names() if middle in name]
        return questionary.autocomplete(
            text, choices=names, default=shown, validate=check, match_middle=True
        ).unsafe_ask()
    answer = questionary.text(text, default=shown, validate=check).unsafe_ask()
    return _split(question, answer)


def _select(text: str, choices: list[questionary.Choice], default: object = None) -> str:
    """Ask for one of some choices; typing leaves those that hold what is typed."""
    chosen: str = questionary.select(
        text,
        choices=choices,
        default=next((one for one in choices if one.value == default), None),
        use_search_filter=True,
        use_jk_keys=False,
        instruction="(arrow keys, or type to search)",
    ).unsafe_ask()
    return chosen


def _several(text: str, question: Question, templates: Mapping[str, Template]) -> list[str]:
    if not question.choices:
        return []
    choices = [_choice(name, templates) for name in question.choices]
    chosen: list[str] = questionary.checkbox(text, choices=choices).unsafe_ask()
    return chosen


def _choice(name: str, templates: Mapping[str, Template]) -> questionary.Choice:
    summary = templates[name].summary if name in templates else ""
    return questionary.Choice(f"{name:20} {summary}".rstrip(), value=name)


def _shown(question: Question, known: object) -> str:
    """Return the default as text to edit; one that is made of other answers is not shown."""
    if isinstance(known, list | tuple):
        return f"{_TOGETHER.get(question.type, ' ')} ".join(map(str, known)).replace("  ", " ")
    return "" if known is None or "{" in str(known) else str(known)


def _is_default(question: Question, value: object) -> bool:
    return value in ("", [], question.default, _split(question, _shown(question, question.default)))


def _split(question: Question, answer: str) -> Any:  # noqa: ANN401  a text or several
    separator = _TOGETHER.get(question.type)
    if separator is None:
        return answer
    return [word.strip() for word in answer.split(separator) if word.strip()]


def _validator(question: Question, refused: set[str]) -> Callable[[str], bool | str]:
    """Return what judges an answer while it is typed."""

    def judge(answer: str) -> bool | str:
        if not answer and question.default is not None:
            return True
        if answer in refused:
            return f"the package has {answer} already"
        try:
            questions.parse(question, Given(_split(question, answer), ""))
        except InputError as error:
            return str(error).removeprefix(": ")
        return True

    return judge


def _definitions() -> Definitions:
    from scaffold.generate import payload

    return payload.definitions()


def _command(
    answers: Mapping[str, Any], base: Mapping[str, Question], templates: Mapping[str, Template]
) -> str:
    """Return the command with what differs from the defaults."""
    words = ["ros2-scaffold", "new", str(answers.get("package", ""))]
    for name, value in answers.items():
        if name == parts.ADD:
            for entry in value:
                words += ["--add", _written(entry, templates)]
        elif name != "package" and not _is_default(base[name], value):
            listed = value if isinstance(value, list) else [value]
            words += [questions.flag(name), *map(str, listed)]
    return shlex.join(word for word in words if word)


def _written(entry: Mapping[str, Any], templates: Mapping[str, Template]) -> str:
    """Return a part as ``--add`` takes it."""
    kind = str(entry[parts.KIND])
    asked = templates[kind].name_question
    words = [f"{kind}:{entry[asked]}"]
    for name, value in entry.items():
        if name not in {parts.KIND, asked}:
            words += [f"{name}={one}" for one in (value if isinstance(value, list) else [value])]
    return shlex.join(words)
