"""``ros2-scaffold config [PATH]``."""

from __future__ import annotations

import argparse
import os
from typing import TYPE_CHECKING, Any

from scaffold.cli import terminal

if TYPE_CHECKING:
    from scaffold.configuration.config import Config

DEFAULT = "default"
"""The origin of values that no file sets."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Define the flags of the verb."""
    parser.add_argument(
        "path",
        nargs="?",
        default=os.curdir,
        metavar="PATH",
        help="show what `check PATH` would use (default: the current directory)",
    )
    parser.add_argument("--format", choices=("text", "json"), default="text", help="output format")


def run(options: argparse.Namespace) -> int:
    """Show every value."""
    from scaffold.check.rules import registry
    from scaffold.cli.choices import Choices
    from scaffold.cli.exit_codes import CLEAN
    from scaffold.cli.settings import validate_answers, warn
    from scaffold.configuration import config, content
    from scaffold.errors import InputError

    path = options.path
    if not os.path.exists(path):
        raise InputError(f"{path}: no such file or directory")
    directory = path if os.path.isdir(path) else os.path.dirname(path) or os.curdir
    settings = config.load(directory)
    warn(settings.warnings)
    validate_answers(settings)
    choices = Choices(settings, registry.load(content.roots("rules", settings.content)))
    choices.selection()  # rejects words that match no rule
    choices.adjustments()
    rows = _rows(settings)
    if options.format == "json":
        terminal.show_json(
            [{"key": key, "value": value, "origin": origin} for key, value, origin in rows]
        )
    else:
        shown = [(f"{key} = {_toml(value)}", origin or DEFAULT) for key, value, origin in rows]
        width = max(len(text) for text, _ in shown if len(text) <= _MAX_WIDTH)
        terminal.show("\n".join(f"{text:<{width}}  # {origin}" for text, origin in shown))
    return CLEAN


_MAX_WIDTH = 60


def _rows(settings: Config) -> list[tuple[str, Any, str | None]]:
    """Return keys, values and the files that they come from."""
    from scaffold.configuration import keys

    rows: list[tuple[str, Any, str | None]] = []
    for key in keys.KEYS:
        if key.path == "content":
            origins = dict.fromkeys(value.origin for value in settings.directories)
            rows += [
                (
                    "content",
                    [value.value for value in settings.directories if value.origin == at],
                    at,
                )
                for at in origins
            ] or [("content", [], None)]
        else:
            given = settings.values.get(key.path)
            rows.append((key.path, settings.value(key.path), given and given.origin))
    answers = {name: value for name, value in settings.values.items() if name.startswith(_ANSWERS)}
    return rows + [(name, value.value, value.origin) for name, value in sorted(answers.items())]


_ANSWERS = "new."


def _toml(value: object) -> str:
    """Format a value as TOML."""
    import json

    if isinstance(value, dict):
        pairs = (f"{json.dumps(key)} = {_toml(inner)}" for key, inner in value.items())
        return f"{{ {', '.join(pairs)} }}" if value else "{}"
    if isinstance(value, list):
        return f"[{', '.join(map(_toml, value))}]"
    if isinstance(value, str | bool | int | float):
        return json.dumps(value, ensure_ascii=False)
    return str(value)
