"""``ros2-scaffold new`` on a terminal, without a name: asks the few questions that matter."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from itertools import chain, count
from typing import TYPE_CHECKING, Any, NamedTuple

from scaffold.cli.interactive import answer_text, prompts
from scaffold.cli.interactive.choice_list import Choice
from scaffold.cli.interactive.screen import say, terminal
from scaffold.errors import ScaffoldError
from scaffold.generate import connections, parts
from scaffold.generate.questions import names, questions
from scaffold.generate.questions.defaults import LOGIN, User
from scaffold.generate.questions.questions import INTERFACES, SEVERAL, Given
from scaffold.generate.templates.template import BASE, Question, Role, Template

if TYPE_CHECKING:
    from scaffold.model.interfaces.definitions import Definitions

ORIGIN = "your answer"
_DONE = "nothing more"
_NEVER_WITH = {Role.NODE: Role.INTERFACE, Role.INTERFACE: Role.NODE}
"""What no package holds together: interfaces have a package of their own."""
_ANYBODY = {
    "package": Given("package_to_be", ORIGIN),
    "maintainer_name": Given("Ada", ORIGIN),
    "maintainer_email": Given("ada@example.com", ORIGIN),
}
"""Answers to try others with, before they are asked."""


class Asked(NamedTuple):
    """What the user answered."""

    given: dict[str, Given]
    command: str
    """The command that does the same without questions."""


class Trial(NamedTuple):
    """Whether answers can be used; each raises a `ScaffoldError` if not."""

    name: Callable[[str], None]
    """For the name of the package alone."""
    package: Callable[[Mapping[str, Given]], None]
    """For all answers that there are."""


def ask(
    templates: Mapping[str, Template],
    given: Mapping[str, Given],
    user: User,
    trial: Trial,
    options: list[str],
) -> Asked:
    """Ask what is not given yet.

    Args:
        templates: All templates.
        given: What flags, an answers file and the configuration say.
        user: Knows the maintainer, and where the package is to be.
        trial: Judges answers together.
        options: What the command line says besides answers.

    Raises:
        KeyboardInterrupt: the user wants no more questions.
    """
    try:
        with terminal():
            answers = _Interview(templates, given, user, trial).answers()
    except EOFError:
        raise KeyboardInterrupt from None
    answered = {name: Given(value, f"{ORIGIN}: {name}") for name, value in answers.items()}
    base = {question.name: question for question in templates[BASE].questions}
    flags = {name: item.value for name, item in given.items() if item.origin.startswith("--")}
    words = answer_text.command({**flags, **answers}, base, templates)
    return Asked(
        {**given, **answered}, " ".join(answer_text.quoted(word) for word in [*words, *options])
    )


class _Interview:
    """One question after the other."""

    def __init__(
        self,
        templates: Mapping[str, Template],
        given: Mapping[str, Given],
        user: User,
        trial: Trial,
    ) -> None:
        self._templates = templates
        self._given = given
        self._user = user
        self._trial = trial
        self._base = {question.name: question for question in templates[BASE].questions}
        self._answers: dict[str, Any] = {}

    def answers(self) -> dict[str, Any]:
        """Ask what is not given; return the answers that are not defaults."""
        self._settle("package")
        self._settle("build_type")
        if not self._given.keys() & {parts.ADD, "node_kind", "node_name"}:
            self._ask_parts()
        for name in ("extras", "description", "license"):
            self._settle(name)
        for name in ("maintainer_name", "maintainer_email"):
            default = self._user.answer(name)
            if default is None or default.origin == LOGIN or self._wrong(name, default):
                self._settle(name, default.value if default else None)
        return self._answers

    def _settle(self, name: str, default: object = None) -> None:
        if name in self._base and name not in self._given:
            value = self._ask(self._base[name], default)
            if value not in (None, "", []):
                self._answers[name] = value

    def _wrong(self, name: str, default: Given) -> bool:
        """Tell whether git's name and email of the user are unusable in a package."""
        return name in self._base and self._fault(self._base[name], default.value) is not None

    @property
    def _build_type(self) -> str:
        return str(self._answers.get("build_type") or self._given["build_type"].value)

    def _ask_parts(self) -> None:
        """Ask for one part after the other, until they are all."""
        entries: list[dict[str, Any]] = []
        definitions = _definitions(self._user.directory)
        while (kind := self._kind([item[parts.KIND] for item in entries])) != _DONE:
            entry = self._part(kind, entries, definitions)
            fault = self._contradiction([*entries, entry])
            if fault is None:
                entries.append(entry)
            else:
                say(f"{fault}; answer again")
        self._answers[parts.ADD] = entries

    def _kind(self, taken: Sequence[str]) -> str:
        """Ask for the kind of the next part; what cannot be with the others is not offered."""
        refused = {_NEVER_WITH.get(self._templates[kind].role) for kind in taken}
        choices = [
            Choice(template.name, template.summary)
            for template in map(self._templates.__getitem__, parts.kinds(self._templates))
            if template.role not in refused
            and (not template.build_types or self._build_type in template.build_types)
        ]
        if not taken:
            usual = self._base["node_kind"].default if "node_kind" in self._base else None
            return prompts.choose("What is in the package?", choices, usual)
        choices.insert(0, Choice(_DONE, is_last=True))
        return prompts.choose("What else is in the package?", choices, _DONE)

    def _contradiction(self, entries: list[dict[str, Any]]) -> str | None:
        answered = {name: Given(value, ORIGIN) for name, value in self._answers.items()}
        together = {**_ANYBODY, **self._given, **answered, parts.ADD: Given(entries, ORIGIN)}
        try:
            self._trial.package(together)
        except ScaffoldError as error:
            return str(error).removeprefix(f"{ORIGIN}: ")
        return None

    def _part(
        self, kind: str, entries: list[dict[str, Any]], definitions: Definitions
    ) -> dict[str, Any]:
        """Ask the questions of a kind of part."""
        template, entry = self._templates[kind], {parts.KIND: kind}
        taken = [str(item[self._templates[item[parts.KIND]].name_question]) for item in entries]
        for question in template.questions:
            if question.name == template.name_question:
                free = _free(str(question.default), taken)
                entry[question.name] = self._ask(question, free, refused=taken)
                continue
            usual = self._type_so_far(template, question, entry, entries)
            value = self._ask(question, usual, definitions=definitions)
            if not answer_text.is_default(question, value):
                entry[question.name] = value
        return entry

    def _type_so_far(
        self,
        template: Template,
        question: Question,
        entry: Mapping[str, Any],
        entries: Iterable[Mapping[str, Any]],
    ) -> str | None:
        """Return the type that another part has for the topic or service of this one."""
        mine = {
            (name.type, _full_name(name, entry, template))
            for name, typed in connections.pairs(template.questions)
            if typed is question
        }
        for other in entries:
            theirs = self._templates[other[parts.KIND]]
            for name, typed in connections.pairs(theirs.questions):
                type_ = other.get(typed.name, typed.default)
                is_known = isinstance(type_, str) and not questions.is_derived(type_)
                full_name = _full_name(name, other, theirs)
                if is_known and full_name and (name.type, full_name) in mine:
                    return str(type_)
        return None

    def _ask(
        self,
        question: Question,
        default: object = None,
        *,
        definitions: Definitions | None = None,
        refused: Iterable[str] = (),
    ) -> Any:  # noqa: ANN401  as the question wants
        """Ask one question until the answer is acceptable; an empty one takes the default."""
        text, _, more = question.help.partition(" (")
        text = text[0].upper() + text[1:]
        preset = question.default if default is None else default
        if question.type == SEVERAL:
            choices = [self._choice(name) for name in question.choices]
            return prompts.several(text, choices) if choices else []
        if question.choices:
            return prompts.choose(
                text, [self._choice(name) for name in question.choices], str(preset)
            )
        words: list[str] = []
        if definitions is not None and question.type in INTERFACES:
            middle = f"/{INTERFACES[question.type]}/"
            words = [name for name in definitions.all_names() if middle in name]
        usual = answer_text.shown(question, preset)

        def judge(answer: str) -> str | None:
            if not answer and preset is not None:
                return None if usual not in refused else f"the package already has {usual}"
            if answer in refused:
                return f"the package already has {answer}"
            return self._fault(question, answer_text.split(question, answer))

        made = more.rstrip(")") or "default: derived from the other answers"
        hint = made if preset is not None and not usual else ""
        answer = prompts.line(text, usual, judge, hint=hint, completions=words)
        if not answer and usual:
            say(f"using {usual}")
        return answer_text.split(question, answer or usual)

    def _fault(self, question: Question, value: object) -> str | None:
        """Return what is wrong with an answer."""
        try:
            questions.parse(question, Given(value, ""), self._user.directory)
            if question.name == "package":
                self._trial.name(str(value))
        except ScaffoldError as error:
            return str(error).removeprefix(": ")
        return None

    def _choice(self, name: str) -> Choice:
        return Choice(name, self._templates[name].summary if name in self._templates else "")


def _full_name(question: Question, entry: Mapping[str, Any], template: Template) -> str:
    """Return the topic or service that a part uses; empty if that follows from its type."""
    given = str(entry.get(question.name, question.default))
    return (
        ""
        if questions.is_derived(given)
        else names.resolve(given, str(entry.get(template.name_question)))
    )


def _free(name: str, taken: Iterable[str]) -> str:
    """Return a name, with a number if another part has it."""
    joint = "" if name[:1].isupper() else "_"
    numbered = (f"{name}{joint}{number}" for number in count(2))
    return next(item for item in chain([name], numbered) if item not in taken)


def _definitions(directory: str) -> Definitions:
    from scaffold.generate import payload

    return payload.definitions(directory)
