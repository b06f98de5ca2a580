"""``ros2-scaffold new`` without a name on a terminal: asks for the essentials."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from itertools import chain, count
from typing import TYPE_CHECKING, Any, NamedTuple

from scaffold.cli.interactive import answer_text, prompts, question_prompt
from scaffold.cli.interactive.choice_list import Choice
from scaffold.cli.interactive.history import BACK, BackError, History
from scaffold.cli.interactive.question_prompt import Usual
from scaffold.cli.interactive.screen import say, show, terminal
from scaffold.errors import ScaffoldError
from scaffold.generate import connections, parts
from scaffold.generate.questions import names, questions
from scaffold.generate.questions.defaults import LOGIN, User
from scaffold.generate.questions.questions import INTERFACES, Given
from scaffold.generate.templates.template import BASE, PARTS, Question, Role, Template

if TYPE_CHECKING:
    from scaffold.model.interfaces.definitions import Definitions

ORIGIN = "your answer"
_DONE = "nothing more"
_WRITE, _CHANGE, _STOP = "write", "change", "stop"
_NEVER_WITH = {Role.NODE: Role.INTERFACE, Role.INTERFACE: Role.NODE}
"""Roles that cannot be in one package: interfaces have their own."""
_ANYBODY = {
    "package": Given("package_to_be", ORIGIN),
    "maintainer_name": Given("Ada", ORIGIN),
    "maintainer_email": Given("ada@example.com", ORIGIN),
}
"""Placeholder answers to validate others with."""


class Asked(NamedTuple):
    """The answers of the user."""

    given: dict[str, Given]
    command: str
    """The equivalent command without questions."""


class Trial(NamedTuple):
    """Validates answers; raises a `ScaffoldError` if they cannot be used."""

    name: Callable[[str], None]
    """Validates the name of the package."""
    package: Callable[[Mapping[str, Given]], Mapping[str, Any]]
    """Validates the answers so far; returns all, including derived ones."""
    preview: Callable[[Mapping[str, Given]], str]
    """Validates all answers; returns the tree of files to be written."""


def ask(
    templates: Mapping[str, Template],
    given: Mapping[str, Given],
    user: User,
    trial: Trial,
    options: list[str],
) -> Asked:
    """Ask the questions without a given answer.

    Args:
        templates: All templates.
        given: The answers in flags, an answers file and the configuration.
        user: Supplies the maintainer and the directory of the package.
        trial: Validates answers together.
        options: The other options on the command line.

    Raises:
        KeyboardInterrupt: the user interrupts.
    """
    try:
        with terminal():
            say(f"{BACK} returns to the previous question; Ctrl+C aborts, and nothing is written")
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
    """Asks the questions in order."""

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
        self._history = History()

    def answers(self) -> dict[str, Any]:
        """Ask the questions without a given answer; return the answers other than defaults."""
        while True:
            self._answers = {}
            try:
                self._ask_all()
                self._confirm()
            except BackError:
                self._history.back()
            else:
                return self._answers

    def _ask_all(self) -> None:
        self._ask_once("package")
        self._ask_once("build_type")
        if not self._given.keys() & {parts.ADD, "node_kind", "node_name"}:
            self._ask_parts()
        self._ask_once("extras")
        self._ask_once("description", hint=self._description())
        self._ask_once("license")
        for name in ("maintainer_name", "maintainer_email"):
            default = self._user.answer(name)
            if default is None or default.origin == LOGIN or self._is_invalid(name, default):
                self._ask_once(name, default.value if default else None)

    def _ask_once(self, name: str, default: object = None, hint: str = "") -> None:
        if name in self._base and name not in self._given:
            question = self._base[name]
            summaries = {
                choice: self._templates[choice].summary
                for choice in question.choices
                if choice in self._templates
            }
            value = self._ask(question, Usual(default, hint, summaries))
            if value not in (None, "", []):
                self._answers[name] = value

    def _confirm(self) -> None:
        """Show a preview, and ask for confirmation."""
        if not self._history.is_repeated:
            try:
                show(self._trial.preview(self._answers_so_far()))
            except ScaffoldError as error:
                self._print_once(f"{str(error).removeprefix(f'{ORIGIN}: ')}; try again")
                raise BackError from None
        choices = [
            Choice(_WRITE, "write these files"),
            Choice(_CHANGE, "return to the last question"),
            Choice(_STOP, "abort, and write nothing"),
        ]
        decision = prompts.choose("Write the package?", choices, _WRITE)
        if decision == _CHANGE:
            raise BackError
        if decision == _STOP:
            raise KeyboardInterrupt

    def _print_once(self, text: str) -> None:
        """Print a text once, and not again when the interview starts over."""
        if not self._history.is_repeated:
            say(text)

    def _description(self) -> str:
        """Return the hint for an empty description."""
        if self._history.is_repeated:
            return ""
        try:
            usual = self._trial.package(self._answers_so_far())["description"]
        except (KeyError, ScaffoldError):
            return ""
        return f"default: {usual}"

    def _is_invalid(self, name: str, default: Given) -> bool:
        """Return whether the name or email of the user in git is invalid in a package."""
        return name in self._base and self._error_in(self._base[name], default.value) is not None

    @property
    def _build_type(self) -> str:
        return str(self._answers.get("build_type") or self._given["build_type"].value)

    def _ask_parts(self) -> None:
        """Ask for one part after the other until the user stops."""
        entries: list[dict[str, Any]] = []
        definitions = _definitions(self._user.directory)
        while True:
            position = self._history.position
            kind = self._kind([item[parts.KIND] for item in entries])
            if kind == _DONE:
                break
            entry = self._ask_part(kind, entries, definitions)
            fault = self._contradiction([*entries, entry])
            if fault is None:
                entries.append(entry)
            else:
                say(f"{fault}; try again")
                self._history.forget(position)
        self._answers[parts.ADD] = entries

    def _kind(self, taken: Sequence[str]) -> str:
        """Ask for the kind of the next part, among those compatible with the others."""
        refused = {_NEVER_WITH.get(self._templates[kind].role) for kind in taken}
        choices = [
            Choice(template.name, template.summary, group=section)
            for section, kinds in parts.sections(self._templates).items()
            for template in map(self._templates.__getitem__, kinds)
            if template.role in PARTS
            and template.role not in refused
            and (not template.build_types or self._build_type in template.build_types)
        ]
        question, usual = "What is in the package?", ""
        if taken:
            choices.insert(0, Choice(_DONE, is_last=True))
            question, usual = "What else is in the package?", _DONE
        elif "node_kind" in self._base:
            usual = str(self._base["node_kind"].default)
        return self._history.ask(lambda before: prompts.choose(question, choices, before or usual))

    def _contradiction(self, entries: list[dict[str, Any]]) -> str | None:
        if self._history.is_repeated:
            return None
        try:
            self._trial.package({**self._answers_so_far(), parts.ADD: Given(entries, ORIGIN)})
        except ScaffoldError as error:
            return str(error).removeprefix(f"{ORIGIN}: ")
        return None

    def _answers_so_far(self) -> dict[str, Given]:
        """Return all answers so far, with placeholders for later questions."""
        answered = {name: Given(value, ORIGIN) for name, value in self._answers.items()}
        return {**_ANYBODY, **self._given, **answered}

    def _ask_part(
        self, kind: str, entries: list[dict[str, Any]], definitions: Definitions
    ) -> dict[str, Any]:
        """Ask the questions of a kind of part."""
        template, entry = self._templates[kind], {parts.KIND: kind}
        taken = [str(item[self._templates[item[parts.KIND]].name_question]) for item in entries]
        for question in template.questions:
            if question.name == template.name_question:
                free = _free(str(question.default), taken)
                entry[question.name] = self._ask(question, Usual(free, refused=taken))
                continue
            usual = self._type_so_far(template, question, entry, entries)
            words = _types(definitions, question)
            value = self._ask(question, Usual(usual, completions=words))
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

    def _ask(self, question: Question, usual: Usual = Usual()) -> Any:  # noqa: ANN401, B008  as the question wants
        """Ask one question until the answer is acceptable; an empty one takes the default."""
        return self._history.ask(
            lambda before: question_prompt.ask(
                question,
                usual._replace(before=before),
                lambda value: self._error_in(question, value),
            )
        )

    def _error_in(self, question: Question, value: object) -> str | None:
        """Return the error in an answer."""
        try:
            questions.parse(question, Given(value, ""), self._user.directory)
            if question.name == "package":
                self._trial.name(str(value))
        except ScaffoldError as error:
            return str(error).removeprefix(": ")
        return None


def _full_name(question: Question, entry: Mapping[str, Any], template: Template) -> str:
    """Return the topic or service of a part; empty if it follows from its type."""
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


def _types(definitions: Definitions, question: Question) -> Sequence[str]:
    """Return the possible types for completion."""
    if question.type not in INTERFACES:
        return ()
    middle = f"/{INTERFACES[question.type]}/"
    return [name for name in definitions.all_names() if middle in name]
