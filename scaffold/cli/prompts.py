"""Questions on a terminal: a line of text, one of some choices, several of them.

Everything is shown in ASCII and broken between words, for terminals of any width. Where the
terminal cannot move its cursor (``TERM=dumb``) the choices are listed and answered by name.
"""

from __future__ import annotations

import os
import sys
import textwrap
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from io import TextIOWrapper
from typing import NamedTuple

from prompt_toolkit import PromptSession, print_formatted_text
from prompt_toolkit.application import Application, create_app_session, get_app_session
from prompt_toolkit.completion import WordCompleter
from prompt_toolkit.data_structures import Size
from prompt_toolkit.formatted_text import FormattedText
from prompt_toolkit.key_binding import KeyBindings, KeyPressEvent
from prompt_toolkit.keys import Keys
from prompt_toolkit.layout import FormattedTextControl, HSplit, Layout, Window
from prompt_toolkit.output import ColorDepth
from prompt_toolkit.output.vt100 import Vt100_Output
from prompt_toolkit.styles import Style

_STYLE = Style.from_dict({"question": "bold", "pointed": "bold", "chosen": "ansicyan"})
_NAME_WIDTH = 20
"""Columns for the names of choices, so that their summaries stand below each other."""
_LEAST_INPUT = 24
"""Columns that a line of text gets beside its question; else it starts a line of its own."""
_MOST_FOOT = 3
"""Lines for the summary of a choice that is cut off in the list."""


class Choice(NamedTuple):
    """Something to choose."""

    name: str
    summary: str = ""
    is_last: bool = False
    """Whether it is found by nothing but its own name, such as "nothing more"."""


@contextmanager
def terminal() -> Iterator[None]:
    """Ask on the terminal of this process while the context lasts.

    The terminal is not asked where its cursor is: not all answer, and some answer late. What its
    encoding cannot show is spelled out, now and afterwards.
    """
    if isinstance(sys.stdout, TextIOWrapper):
        sys.stdout.reconfigure(errors="backslashreplace")
    output = Vt100_Output(
        sys.stdout,
        _size,
        term=os.environ.get("TERM"),
        default_color_depth=ColorDepth.DEPTH_1_BIT if os.environ.get("NO_COLOR") else None,
        enable_cpr=False,
    )
    with create_app_session(output=output):
        yield


def _size() -> Size:
    """Return the size of the terminal, whatever the environment says; some have none."""
    columns, rows = os.get_terminal_size(sys.stdout.fileno())
    return Size(rows=rows or 24, columns=columns or 80)


def line(
    question: str,
    default: str = "",
    judge: Callable[[str], str | None] = lambda _: None,
    *,
    hint: str = "",
    completions: Sequence[str] = (),
) -> str:
    """Ask for a line until it is acceptable.

    Args:
        question: What is wanted.
        default: What is there to be edited or taken.
        judge: Says what is wrong with an answer.
        hint: What happens without an answer.
        completions: Words that are offered while somebody types.

    Raises:
        KeyboardInterrupt: the user wants no more questions.
        EOFError: nobody is there to answer.
    """
    start = default
    while True:
        answer = _read(question + (f" ({hint})" if hint else ""), start, completions)
        wrong = judge(answer)
        if wrong is None:
            return answer
        say(wrong)
        start = default if _is_dumb() else answer


def one(question: str, choices: Sequence[Choice], default: str | None = None) -> str:
    """Ask for the name of one choice; see `line`."""
    if _is_dumb():
        return _by_name(question, choices, default)
    found = _List(question, choices, default, takes_several=False).run()
    _echo(question, found)
    return found[0]


def several(question: str, choices: Sequence[Choice]) -> list[str]:
    """Ask for the names of any number of choices; see `line`."""
    if _is_dumb():
        return _by_names(question, choices)
    found = _List(question, choices, None, takes_several=True).run()
    _echo(question, found)
    return found


def say(text: str) -> None:
    """Write a text below a question."""
    indent = "  "
    for part in textwrap.wrap(
        text, max(_columns() - 1, 2 * len(indent)), initial_indent=indent, subsequent_indent=indent
    ):
        print_formatted_text(part)


def _ended(question: str) -> str:
    return question if question.endswith("?") else f"{question}:"


def _columns() -> int:
    return get_app_session().output.get_size().columns


def _is_dumb() -> bool:
    return os.environ.get("TERM", "").lower() in {"", "dumb", "unknown"}


def _read(question: str, default: str, completions: Sequence[str]) -> str:
    """Read a line that starts as the default; around it blanks do not count."""
    lines = textwrap.wrap(f"? {_ended(question)}", max(_columns() - 1, 2))
    if len(lines) > 1 or len(lines[0]) + _LEAST_INPUT > _columns():
        lines.append(">")
    if _is_dumb():
        shown = f" [{default}]" if default else ""
        return _read_plainly("\n".join(lines) + f"{shown} ") or default
    session: PromptSession[str] = PromptSession(
        FormattedText([("class:question", "\n".join(lines)), ("", " ")]),
        style=_STYLE,
        key_bindings=_on_one_line(),
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
        print()  # what is said next has a line of its own
        raise


def _on_one_line() -> KeyBindings:
    """Return bindings that put pasted lines behind each other: an answer is one line.

    Escape does nothing; it would take the next letter with it.
    """
    bindings = KeyBindings()
    bindings.add("escape", eager=True)(lambda _: None)

    @bindings.add(Keys.BracketedPaste)
    def paste(event: KeyPressEvent) -> None:
        event.current_buffer.insert_text(" ".join(event.data.splitlines()))

    return bindings


def _echo(question: str, answers: Sequence[str]) -> None:
    text = f"? {_ended(question)} {', '.join(answers) or 'nothing'}"
    for part in textwrap.wrap(text, max(_columns() - 1, 2), subsequent_indent="  "):
        print_formatted_text(part)


def _by_name(question: str, choices: Sequence[Choice], default: str | None) -> str:
    _list(choices)
    names = [choice.name for choice in choices]
    start = default if default in names else ""
    return line(question, start or "", lambda word: _not_among([word], names))


def _by_names(question: str, choices: Sequence[Choice]) -> list[str]:
    _list(choices)
    names = [choice.name for choice in choices]
    hint = "names with blanks between them, or nothing"
    answer = line(question, "", lambda words: _not_among(words.split(), names), hint=hint)
    return [name for name in names if name in answer.split()]


def _list(choices: Sequence[Choice]) -> None:
    for choice in choices:
        say(f"{choice.name:{_NAME_WIDTH}} {choice.summary}")


def _not_among(words: Sequence[str], names: Sequence[str]) -> str | None:
    wrong = [word for word in words if word not in names]
    return f"{wrong[0]!r} is no name in the list above" if wrong else None


class _List:
    """A list of choices: arrow keys move in it, what is typed leaves those that match."""

    def __init__(
        self, question: str, choices: Sequence[Choice], default: str | None, *, takes_several: bool
    ) -> None:
        self._question = question
        self._choices = choices
        self._takes_several = takes_several
        self._typed = ""
        self._at = next((i for i, one in enumerate(choices) if one.name == default), 0)
        self._chosen: set[str] = set()

    def run(self) -> list[str]:
        """Return the names that were chosen, in the order of the list."""
        head = Window(FormattedTextControl(self._head), wrap_lines=True, dont_extend_height=True)
        rows = FormattedTextControl(self._rows, focusable=True, show_cursor=False)
        foot = FormattedTextControl(self._foot)
        layout = Layout(
            HSplit(
                [
                    head,
                    Window(rows, dont_extend_height=True, height=self._height),
                    Window(foot, dont_extend_height=True),
                ]
            )
        )
        application: Application[list[str]] = Application(
            layout, key_bindings=self._keys(), style=_STYLE, erase_when_done=True
        )
        return application.run()

    def _height(self) -> int:
        """Return how many rows there is room for."""
        lines = get_app_session().output.get_size().rows
        around = len(self._lines_of_head()) + len(self._foot_lines()) + 1
        return max(2, min(len(self._found()) or 1, lines - around))

    def _found(self) -> list[Choice]:
        """Return the choices that match: the named one first, then names, then summaries."""
        word = self._typed.strip().lower()
        if not word:
            return list(self._choices)
        grades: tuple[list[Choice], ...] = ([], [], [], [])
        for choice in self._choices:
            name = choice.name.lower()
            if name.startswith(word):
                grades[0 if name == word else 1].append(choice)
            elif not choice.is_last and word in name:
                grades[2].append(choice)
            elif not choice.is_last and word in choice.summary.lower():
                grades[3].append(choice)
        return [choice for grade in grades for choice in grade]

    def _lines_of_head(self) -> list[str]:
        how = "space chooses, enter ends" if self._takes_several else "enter chooses"
        how = f"arrow keys move, {how}, typing searches"
        text = f"? {_ended(self._question)} ({how}) {self._typed}"
        return textwrap.wrap(text, max(_columns() - 1, 2))

    def _head(self) -> FormattedText:
        return FormattedText([("class:question", "\n".join(self._lines_of_head()))])

    def _row(self, choice: Choice) -> str:
        box = ("[x] " if choice.name in self._chosen else "[ ] ") if self._takes_several else ""
        return f"{box}{choice.name:{_NAME_WIDTH}} {choice.summary}".rstrip()

    def _rows(self) -> FormattedText:
        found = self._found()
        if not found:
            return FormattedText([("", f"  nothing has {self._typed.strip()!r} in it")])
        tokens: list[tuple[str, str]] = []
        for number, choice in enumerate(found):
            is_pointed = number == self._at
            text = _cut(self._row(choice), _columns() - 3)
            if is_pointed:
                tokens.append(("[SetCursorPosition]", ""))
            chosen = "class:chosen" if choice.name in self._chosen else ""
            tokens.append(("class:pointed", f"> {text}") if is_pointed else (chosen, f"  {text}"))
            tokens.append(("", "\n"))
        return FormattedText(tokens[:-1])

    def _foot_lines(self) -> list[str]:
        """Return the whole summary of the choice that is pointed at, where the row is cut."""
        if all(len(self._row(choice)) <= _columns() - 3 for choice in self._choices):
            return []
        found = self._found()
        text = found[self._at].summary if found else ""
        return textwrap.wrap(text, max(_columns() - 1, 2), max_lines=_MOST_FOOT, placeholder="...")

    def _foot(self) -> FormattedText:
        return FormattedText([("", "\n".join(self._foot_lines()))])

    def _keys(self) -> KeyBindings:
        keys = KeyBindings()
        self._bind_moves(keys)
        self._bind_search(keys)
        self._bind_ends(keys)
        return keys

    def _bind_moves(self, keys: KeyBindings) -> None:
        def move(steps: int) -> Callable[[KeyPressEvent], None]:
            def by(_: KeyPressEvent) -> None:
                self._at = (self._at + steps) % max(len(self._found()), 1)

            return by

        for key, steps in (("down", 1), ("c-n", 1), ("up", -1), ("c-p", -1)):
            keys.add(key)(move(steps))

    def _bind_search(self, keys: KeyBindings) -> None:
        @keys.add("backspace")
        def back(_: KeyPressEvent) -> None:
            self._search(self._typed[:-1])

        @keys.add("c-u")
        @keys.add("escape", eager=True)
        def clear(_: KeyPressEvent) -> None:
            self._search("")

        @keys.add(Keys.BracketedPaste)
        def paste(event: KeyPressEvent) -> None:
            self._search(self._typed + " ".join(event.data.split()))

        @keys.add(Keys.Any)
        def typed(event: KeyPressEvent) -> None:
            if event.data == " " and self._takes_several:
                self._toggle()
            elif event.data.isprintable():
                self._search(self._typed + event.data)

    def _bind_ends(self, keys: KeyBindings) -> None:
        @keys.add("enter")
        def end(event: KeyPressEvent) -> None:
            found = self._found()
            if self._takes_several:
                names = [one.name for one in self._choices if one.name in self._chosen]
                event.app.exit(result=names)
            elif found:
                event.app.exit(result=[found[self._at].name])

        @keys.add("c-c")
        @keys.add("<sigint>")
        def interrupt(event: KeyPressEvent) -> None:
            event.app.exit(exception=KeyboardInterrupt())

        @keys.add("c-d")
        def close(event: KeyPressEvent) -> None:
            event.app.exit(exception=EOFError())

    def _search(self, text: str) -> None:
        self._typed, self._at = text, 0

    def _toggle(self) -> None:
        found = self._found()
        if found:
            self._chosen ^= {found[self._at].name}


def _cut(text: str, width: int) -> str:
    return text if len(text) <= width else text[: max(width - 3, 1)].rstrip() + "..."
