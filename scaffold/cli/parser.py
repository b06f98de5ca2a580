"""The argument parser of all verbs, for the shell, ros2cli and completion."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from importlib import import_module
from typing import NoReturn

from scaffold import __version__
from scaffold.cli import terminal
from scaffold.cli.exit_codes import USAGE_ERROR
from scaffold.cli.verbs import VERBS


class _Parser(argparse.ArgumentParser):
    """Reports errors in one line with a suggestion, as everywhere in this tool."""

    chosen: _Parser | None = None
    """The parser of the verb on the command line."""

    def parse_args(  # type: ignore[override]  # without a namespace of its own
        self, args: Sequence[str] | None = None, namespace: None = None
    ) -> argparse.Namespace:
        """Parse all words; print an error and exit if one is unknown."""
        words = [*(sys.argv[1:] if args is None else args)]
        if words and all(word.startswith("-") for word in words):  # no verb, which comes first
            unknown = [word for word in words if word.partition("=")[0] not in self.flags]
            if unknown:
                self.error(f"unrecognized arguments: {' '.join(unknown)}")
        options, rest = self.parse_known_args(args, namespace)
        if rest:
            verb = self.chosen or self
            unrecognized = f"unrecognized arguments: {' '.join(rest)}"
            verb.error(f"{unrecognized}{nearest(rest[0], verb.flags)}")
        return options

    @property
    def flags(self) -> list[str]:
        """The flags of the parser."""
        return [name for action in self._actions for name in action.option_strings]

    def _check_value(self, action: argparse.Action, value: object) -> None:
        """Reject a word that is not a choice, with the closest one."""
        choices = [*map(str, action.choices or ())]
        if choices and value not in choices:
            hint = nearest(str(value), choices) or f" (choose from {', '.join(choices)})"
            raise argparse.ArgumentError(action, f"invalid choice: {str(value)!r}{hint}")

    def error(self, message: str) -> NoReturn:
        """Print the line and exit."""
        separator = " See" if message.endswith("?") else "; see"
        terminal.error(f"{message}{separator} `{self.prog} --help`")
        sys.exit(USAGE_ERROR)

    def _print_message(self, message: str, file: object = None) -> None:
        """Print the help or the version; argparse itself ignores a full disk."""
        del file
        terminal.show(message.removesuffix("\n"))


def nearest(word: str, words: Sequence[str]) -> str:
    """Return the suggestion at the end of an error message, if any."""
    from difflib import get_close_matches

    closest = get_close_matches(word.partition("=")[0], words, n=1)
    return f"; did you mean {closest[0]!r}?" if closest else ""


def build_parser(
    verb: str | None = None, *, comes_first: bool = False, words: Sequence[str] = ()
) -> _Parser:
    """Return the parser.

    Args:
        verb: The only verb to define in full; the others are listed but not imported. ``None``
            defines all, as tab completion needs.
        comes_first: Whether no option that requests the list precedes the verb.
        words: The command line; templates in it have their own flags.
    """
    parser = _Parser(
        prog="ros2-scaffold",
        description="Generate, lint, fix, build and smoke-test ROS 2 Python packages.",
    )
    parser.add_argument("--version", action="version", version=f"ros2-scaffold {__version__}")
    # Without the name argparse would format the usage to find it.
    verbs = parser.add_subparsers(dest="verb", metavar="VERB", required=True, prog="ros2-scaffold")
    listed = {verb: VERBS[verb]} if comes_first and verb in VERBS else VERBS
    for name, text in listed.items():
        verb_parser = verbs.add_parser(
            name, help=text, description=text[0].upper() + text[1:] + "."
        )
        if verb == name:
            parser.chosen = verb_parser
        if verb is None or verb == name:
            verb_parser.set_defaults(command_line=words)
            import_module(f"scaffold.cli.verbs.{name}").add_arguments(verb_parser)
    return parser
