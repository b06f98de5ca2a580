"""The terminal for prompts: its size, its capabilities, and plain output."""

from __future__ import annotations

import os
import sys
import textwrap
from collections.abc import Iterator
from contextlib import contextmanager
from io import TextIOWrapper

from prompt_toolkit import print_formatted_text
from prompt_toolkit.application import create_app_session, get_app_session
from prompt_toolkit.data_structures import Size
from prompt_toolkit.output import ColorDepth
from prompt_toolkit.output.vt100 import Vt100_Output
from prompt_toolkit.styles import Style

from scaffold.printable import printable_lines

STYLE = Style.from_dict(
    {"question": "bold", "pointed": "bold", "chosen": "ansicyan", "heading": "underline"}
)


@contextmanager
def terminal() -> Iterator[None]:
    """Use the terminal of this process for questions within the context.

    The terminal is not asked for its cursor position: not all answer, and some do so late.
    Characters that its encoding lacks are escaped, now and afterwards.
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
    """Return the size of the terminal itself, ignoring the environment; some have none."""
    width, height = os.get_terminal_size(sys.stdout.fileno())
    return Size(rows=height or 24, columns=width or 80)


def say(text: str) -> None:
    """Write a text below a question."""
    indent = "  "
    for part in textwrap.wrap(
        printable_lines(text),
        max(columns() - 1, 2 * len(indent)),
        initial_indent=indent,
        subsequent_indent=indent,
    ):
        print_formatted_text(part)


def show(text: str) -> None:
    """Write lines between questions, each cut to the width of the terminal."""
    for line in printable_lines(text).splitlines():
        print_formatted_text(line[: columns() - 1])


def ended(question: str) -> str:
    """Return a question, with a colon if it is a noun."""
    return question if question.endswith("?") else f"{question}:"


def columns() -> int:
    """Return the width of the terminal."""
    return get_app_session().output.get_size().columns


def is_dumb() -> bool:
    """Return whether the terminal cannot move its cursor."""
    return os.environ.get("TERM", "").lower() in {"", "dumb", "unknown"}
