"""A list for choosing one or several names on a terminal."""

from __future__ import annotations

import textwrap
from collections.abc import Callable, Sequence
from typing import NamedTuple

from prompt_toolkit.application import Application, get_app_session
from prompt_toolkit.formatted_text import FormattedText
from prompt_toolkit.key_binding import KeyBindings, KeyPressEvent
from prompt_toolkit.keys import Keys
from prompt_toolkit.layout import FormattedTextControl, HSplit, Layout, Window

from scaffold.cli.interactive.history import BACK, BackError
from scaffold.cli.interactive.screen import STYLE, columns, ended

NAME_WIDTH = 22
"""The width of the name column."""
_MAX_FOOT = 3
"""The maximum number of lines for the full summary of the current choice."""


class Choice(NamedTuple):
    """An entry of the list."""

    name: str
    summary: str = ""
    is_last: bool = False
    """Whether only its own name matches it, such as "nothing more"."""
    group: str = ""
    """The heading that it is listed below."""


class ChoiceList:
    """A list of choices: arrow keys move the cursor, typing filters the entries."""

    def __init__(
        self,
        question: str,
        choices: Sequence[Choice],
        default: str | Sequence[str] | None,
        *,
        takes_several: bool,
    ) -> None:
        self._question = question
        self._choices = choices
        self._takes_several = takes_several
        self._typed = ""
        self._at = next((i for i, item in enumerate(choices) if item.name == default), 0)
        self._chosen = {*(default or ())} if takes_several else set[str]()

    def run(self) -> list[str]:
        """Return the chosen names, in the order of the list."""
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
            layout, key_bindings=self._keys(), style=STYLE, erase_when_done=True
        )
        return application.run()

    def _height(self) -> int:
        """Return the number of rows that fit."""
        lines = get_app_session().output.get_size().rows
        around = len(self._lines_of_head()) + len(self._foot_lines()) + 1
        rows = len(self._matches()) + len(self._headings())
        return max(2, min(rows or 1, lines - around))

    def _headings(self) -> dict[int, str]:
        """Return the headings by the position of their first choice; none during a search."""
        if self._typed.strip():
            return {}
        groups = [choice.group for choice in self._choices]
        before = ["", *groups]
        pairs = zip(groups, before, strict=False)
        return {at: group for at, (group, last) in enumerate(pairs) if group != last}

    def _matches(self) -> list[Choice]:
        """Return the matching choices: the exact match first, then names, then summaries."""
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
        how = "space selects, enter confirms" if self._takes_several else "enter chooses"
        how = f"arrow keys move, {how}, typing filters, {BACK} goes back"
        text = f"? {ended(self._question)} ({how}) {self._typed}"
        return textwrap.wrap(text, max(columns() - 1, 2))

    def _head(self) -> FormattedText:
        return FormattedText([("class:question", "\n".join(self._lines_of_head()))])

    def _row(self, choice: Choice) -> str:
        box = ("[x] " if choice.name in self._chosen else "[ ] ") if self._takes_several else ""
        return f"{box}{choice.name:{NAME_WIDTH}} {choice.summary}".rstrip()

    def _rows(self) -> FormattedText:
        matches = self._matches()
        if not matches:
            return FormattedText([("", f"  no match for {self._typed.strip()!r}")])
        tokens: list[tuple[str, str]] = []
        headings = self._headings()
        for number, choice in enumerate(matches):
            if number in headings:
                tokens.append(("class:heading", f"{_truncated(headings[number], columns() - 1)}\n"))
            is_pointed = number == self._at
            text = _truncated(self._row(choice), columns() - 3)
            if is_pointed:
                tokens.append(("[SetCursorPosition]", ""))
            chosen = "class:chosen" if choice.name in self._chosen else ""
            tokens.append(("class:pointed", f"> {text}") if is_pointed else (chosen, f"  {text}"))
            tokens.append(("", "\n"))
        return FormattedText(tokens[:-1])

    def _foot_lines(self) -> list[str]:
        """Return the full summary of the current choice if its row is cut."""
        if all(len(self._row(choice)) <= columns() - 3 for choice in self._choices):
            return []
        matches = self._matches()
        text = matches[self._at].summary if matches else ""
        return textwrap.wrap(text, max(columns() - 1, 2), max_lines=_MAX_FOOT, placeholder="...")

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
                self._at = (self._at + steps) % max(len(self._matches()), 1)

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
            if event.data == BACK:
                event.app.exit(exception=BackError())
            elif event.data == " " and self._takes_several:
                self._toggle()
            elif event.data.isprintable():
                self._search(self._typed + event.data)

    def _bind_ends(self, keys: KeyBindings) -> None:
        @keys.add("enter")
        def end(event: KeyPressEvent) -> None:
            matches = self._matches()
            if self._takes_several:
                names = [choice.name for choice in self._choices if choice.name in self._chosen]
                event.app.exit(result=names)
            elif matches:
                event.app.exit(result=[matches[self._at].name])

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
        matches = self._matches()
        if matches:
            self._chosen ^= {matches[self._at].name}


def _truncated(text: str, width: int) -> str:
    return text if len(text) <= width else text[: max(width - 3, 1)].rstrip() + "..."
