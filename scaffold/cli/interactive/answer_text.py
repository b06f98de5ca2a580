"""Conversion of answers to text: for editing, and as command-line flags."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any

from scaffold.generate import parts
from scaffold.generate.questions import questions
from scaffold.generate.templates.template import Question, Template

_TOGETHER = {"fields": ";", "dependencies": " "}
"""The separator of several values in one line, by answer type."""


def shown(question: Question, default: object) -> str:
    """Return the default as text to edit; empty if it is derived from other answers."""
    if isinstance(default, bool):
        return "yes" if default else "no"
    if isinstance(default, list | tuple):
        return f"{_TOGETHER.get(question.type, ' ')} ".join(map(str, default)).replace("  ", " ")
    return "" if default is None or "{" in str(default) else str(default)


def is_default(question: Question, value: object) -> bool:
    """Return whether an answer is the same as the default."""
    usual = split(question, shown(question, question.default))
    return value in ("", [], question.default, usual)


def split(question: Question, answer: str) -> Any:  # noqa: ANN401  a text or several
    """Parse the value or values typed on one line."""
    separator = _TOGETHER.get(question.type)
    if separator is None:
        return answer
    words = [word.strip() for word in answer.split(separator) if word.strip()]
    return words[0] if len(words) == 1 else words


def command(
    answers: Mapping[str, Any], base: Mapping[str, Question], templates: Mapping[str, Template]
) -> list[str]:
    """Return the command with all answers that differ from the defaults."""
    words = ["ros2-scaffold", "new", str(answers["package"])]
    for name, value in answers.items():
        if name == parts.ADD:
            for entry in value:
                part = entry if isinstance(entry, str) else _part_argument(entry, templates)
                words += ["--add", part]
        elif name != "package" and not (name in base and is_default(base[name], value)):
            words += _flag(name, value)
    return words


def _flag(name: str, value: object) -> list[str]:
    flag = questions.flag(name)
    if isinstance(value, list):
        return [flag, *map(str, value)]
    # A leading dash would look like a flag.
    return [f"{flag}={value}"] if str(value).startswith("-") else [flag, str(value)]


def _part_argument(entry: Mapping[str, Any], templates: Mapping[str, Template]) -> str:
    """Return a part as an argument of ``--add``."""
    kind = str(entry[parts.KIND])
    asked = templates[kind].name_question
    words = [f"{kind}:{entry[asked]}"]
    for name, value in entry.items():
        if name not in {parts.KIND, asked}:
            words += [f"{name}={item}" for item in (value if isinstance(value, list) else [value])]
    return " ".join(_quoted_inside(word) for word in words)


def _quoted_inside(word: str) -> str:
    """Quote a word for `shlex.split`, preferably such that no outer quotes are needed."""
    if not re.search(r"[\s'\"\\]", word):
        return word
    return quoted(word) if re.search(r'["\\]', word) else f'"{word}"'


def quoted(word: str) -> str:
    """Quote a word for bash, zsh and fish.

    In single quotes all characters are literal, except the backslash in fish and the quote itself.
    """
    if re.fullmatch(r"[\w@+=:,./-]+", word, re.ASCII) and word[0] != "=":
        return word
    pieces = re.findall(r"[\\']|[^\\']+", word)
    return "".join(f"\\{piece}" if piece in "\\'" else f"'{piece}'" for piece in pieces) or "''"
