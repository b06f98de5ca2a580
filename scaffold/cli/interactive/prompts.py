"""Prompts: a line of text, one of several choices, any number of choices.

Output is ASCII and wrapped at word boundaries, for terminals of any width. If the terminal cannot
move its cursor (``TERM=dumb``), the choices are listed and answered by name.
"""

from __future__ import annotations

import textwrap
from collections.abc import Callable, Sequence

from prompt_toolkit import PromptSession, print_formatted_text
from prompt_toolkit.completion import WordCompleter
from prompt_toolkit.formatted_text import FormattedText
from prompt_toolkit.key_binding import KeyBindings, KeyPressEvent
from prompt_toolkit.keys import Keys

from scaffold.cli import terminal
from scaffold.cli.interactive.choice_list import NAME_WIDTH, Choice, ChoiceList
from scaffold.cli.interactive.history import BACK, BackError
from scaffold.cli.interactive.screen import STYLE, columns, ended, is_dumb, say
from scaffold.printable import printable

_MIN_INPUT = 24
"""The minimum width of the input next to its question; otherwise it is on its own line."""


def line(
    question: str,
    default: str = "",
    judge: Callable[[str], str | None] = lambda _: None,
    *,
    hint: str = "",
    completions: Sequence[str] = (),
) -> str:
    """Ask for a line until it is valid.

    Args:
        question: The text of the question.
        default: The initial text.
        judge: Returns the error in an answer.
        hint: The effect of an empty answer.
        completions: Suggestions while typing.

    Raises:
        KeyboardInterrupt: the user interrupts.
        EOFError: the input ended without an answer.
        BackError: the user wants to go back.
    """
    start = default
    while True:
        answer = _read(question + (f" ({hint})" if hint else ""), start, completions)
        if answer.endswith(BACK):
            raise BackError
        wrong = judge(answer)
        if wrong is None:
            return answer
        say(wrong)
        start = default if is_dumb() else answer


def choose(question: str, choices: Sequence[Choice], default: str | None = None) -> str:
    """Ask for the name of one choice; see `line`."""
    if is_dumb():
        return _by_name(question, choices, default)
    chosen = ChoiceList(question, choices, default, takes_several=False).run()
    _echo(question, chosen)
    return chosen[0]


def several(question: str, choices: Sequence[Choice], default: Sequence[str] = ()) -> list[str]:
    """Ask for the names of any number of choices; see `line`."""
    if is_dumb():
        return _by_names(question, choices, default)
    result = ChoiceList(question, choices, default, takes_several=True).run()
    _echo(question, result)
    return result


def _read(question: str, default: str, completions: Sequence[str]) -> str:
    """Read a line, initially the default; surrounding spaces are ignored."""
    lines = textwrap.wrap(f"? {ended(question)}", max(columns() - 1, 2))
    if len(lines) > 1 or len(lines[0]) + _MIN_INPUT > columns():
        lines.append(">")
    if is_dumb():
        shown = f" [{printable(default)}]" if default else ""
        return _read_plainly("\n".join(lines) + f"{shown} ") or default
    session: PromptSession[str] = PromptSession(
        FormattedText([("class:question", "\n".join(lines)), ("", " ")]),
        style=STYLE,
        key_bindings=_on_one_line(default),
        completer=WordCompleter(list(completions), ignore_case=True, WORD=True, match_middle=True)
        if completions
        else None,
        complete_while_typing=True,
    )
    return session.prompt(default=default).strip()


def _read_plainly(text: str) -> str:
    try:
        return input(text).strip()
    except (EOFError, KeyboardInterrupt):
        terminal.show("")  # the next output starts on its own line
        raise


def _on_one_line(default: str) -> KeyBindings:
    """Return bindings that join pasted lines: an answer is one line.

    Escape does nothing; it would swallow the next letter. `BACK` needs no enter if nothing
    else was typed.
    """
    bindings = KeyBindings()
    bindings.add("escape", eager=True)(lambda _: None)

    @bindings.add(BACK)
    def back(event: KeyPressEvent) -> None:
        if event.current_buffer.text in {"", default}:
            event.app.exit(exception=BackError())
        else:
            event.current_buffer.insert_text(BACK)

    @bindings.add(Keys.BracketedPaste)
    def paste(event: KeyPressEvent) -> None:
        event.current_buffer.insert_text(" ".join(event.data.splitlines()))

    return bindings


def _echo(question: str, answers: Sequence[str]) -> None:
    text = printable(f"? {ended(question)} {', '.join(answers) or 'nothing'}")
    for part in textwrap.wrap(text, max(columns() - 1, 2), subsequent_indent="  "):
        print_formatted_text(part)


def _by_name(question: str, choices: Sequence[Choice], default: str | None) -> str:
    _list(choices)
    names = [choice.name for choice in choices]
    start = default if default in names else ""
    return line(question, start or "", lambda word: _not_among([word], names))


def _by_names(question: str, choices: Sequence[Choice], default: Sequence[str]) -> list[str]:
    _list(choices)
    names = [choice.name for choice in choices]
    hint = "names separated by spaces; may be empty"
    start = " ".join(default)
    answer = line(question, start, lambda words: _not_among(words.split(), names), hint=hint)
    return [name for name in names if name in answer.split()]


def _list(choices: Sequence[Choice]) -> None:
    group = ""
    for choice in choices:
        if choice.group != group:
            group = choice.group
            say(f"{group}:")
        say(f"{choice.name:{NAME_WIDTH}} {choice.summary}")


def _not_among(words: Sequence[str], names: Sequence[str]) -> str | None:
    wrong = [word for word in words if word not in names]
    return f"{wrong[0]!r} is not in the list above" if wrong else None
