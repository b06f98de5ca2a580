"""Prompts for one question of a template, according to the type of its answer."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from types import MappingProxyType
from typing import Any, NamedTuple

from scaffold.cli.interactive import answer_text, prompts
from scaffold.cli.interactive.choice_list import Choice
from scaffold.cli.interactive.screen import say
from scaffold.generate.questions import qos
from scaffold.generate.questions.questions import SEVERAL
from scaffold.generate.templates.template import Question

_USUAL, _OTHER = "usual", "other"


class Usual(NamedTuple):
    """The suggested answers."""

    default: object = None
    """Overrides the default of the question."""
    hint: str = ""
    """The effect of an empty answer, if the question does not mention it."""
    summaries: Mapping[str, str] = MappingProxyType({})
    """The summaries of its choices."""
    completions: Sequence[str] = ()
    """Suggestions while the user types."""
    refused: Collection[str] = ()
    """Names of other parts of the package."""
    before: Any = None
    """The answer taken back by the user."""


def ask(question: Question, usual: Usual, judge: Callable[[object], str | None]) -> Any:  # noqa: ANN401  as the question wants
    """Ask until the answer is valid; an empty one means the default.

    Args:
        question: The question.
        usual: The suggested answers.
        judge: Returns the error in a value.

    Raises:
        BackError: the user wants to go back.
        KeyboardInterrupt: the user interrupts.
        EOFError: the input ended without an answer.
    """
    text, _, made = question.help.partition(" (")
    text, made = text[0].upper() + text[1:], made.rstrip(")")
    preset = question.default if usual.default is None else usual.default
    choices = [Choice(name, usual.summaries.get(name, "")) for name in question.choices]
    if question.type == SEVERAL:
        return prompts.several(text, choices, usual.before or ()) if choices else []
    if choices:
        return prompts.choose(text, choices, str(usual.before or preset))
    shown = answer_text.shown(question, preset)
    if question.type == "qos":
        by_default = shown or made.removeprefix("default: ") or "default of the template"
        return _quality(text.partition(":")[0], by_default, usual.before, judge)

    def wrong(answer: str) -> str | None:
        if (answer or shown) in usual.refused:
            return f"the package already has {answer or shown}"
        if not answer and preset is not None:
            return None
        return judge(answer_text.split(question, answer))

    hint = usual.hint or made or "default: derived from the other answers"
    answer = prompts.line(
        text,
        shown if usual.before is None else answer_text.shown(question, usual.before),
        wrong,
        hint="" if preset is None or shown else hint,
        completions=usual.completions,
    )
    if not answer and shown:
        say(f"using {shown}")
    return answer_text.split(question, answer or shown)


def _quality(
    text: str, by_default: str, before: str | None, judge: Callable[[object], str | None]
) -> str:
    """Ask for a quality of service: one of the common ones, or settings; see `ask`."""
    choices = [
        Choice(_USUAL, by_default),
        *(Choice(name, summary) for name, summary in qos.COMMON.items()),
        Choice(_OTHER, "a depth, or settings such as best_effort,depth=5"),
    ]
    at = _USUAL if not before else before if before in qos.COMMON else _OTHER
    choice = prompts.choose(text, choices, at)
    if choice != _OTHER:
        return "" if choice == _USUAL else choice
    start = (before or "") if at == _OTHER else ""
    return prompts.line("Depth, profile or settings", start, judge)
