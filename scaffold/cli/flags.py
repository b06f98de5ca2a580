"""Flags that several verbs share."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import argparse
    from typing import TypeAlias

    Parser: TypeAlias = argparse.ArgumentParser | argparse._ArgumentGroup  # noqa: SLF001  it has no other name


def add_looking(parser: Parser) -> None:
    """Define the preview flags of verbs that write."""
    parser.add_argument(
        "--dry-run", action="store_true", help="show what would be written, and write nothing"
    )
    parser.add_argument(
        "--diff", action="store_true", help="show the changes as a diff, and write nothing"
    )


def content_in(parser: argparse.ArgumentParser) -> list[str]:
    """Return the content directories on a command line, before their templates define flags."""
    from argparse import ArgumentParser

    first = ArgumentParser(add_help=False, allow_abbrev=False, exit_on_error=False)
    first.add_argument("--content", action="append", nargs="?", default=[])
    options, _ = first.parse_known_args(parser.get_default("command_line"))
    return [text for text in options.content if text]


def add_content(parser: Parser) -> None:
    """Define the flag for content directories."""
    action = parser.add_argument(
        "--content",
        action="append",
        default=[],
        metavar="DIR",
        help="a directory with your own templates/, or URL@REV of a git repository that you "
        "trust with `ros2-scaffold trust URL`",
    )
    action.completer = offer_directories  # type: ignore[attr-defined]  # argcomplete


def add_answers(parser: Parser) -> None:
    """Define the flag for an answers file."""
    parser.add_argument(
        "--answers", metavar="FILE", help="a YAML file with answers; flags take precedence"
    )


def offer_directories(prefix: str, **_: object) -> list[str]:
    """Complete directories."""
    from argcomplete.completers import DirectoriesCompleter

    return [*DirectoriesCompleter()(prefix)]


def offer_rules(prefix: str, **_: object) -> list[str]:
    """Complete codes and names of rules, also after a comma."""
    from scaffold.ament.codes import CODES
    from scaffold.check import selection
    from scaffold.check.rules import registry
    from scaffold.check.session import all_rules
    from scaffold.configuration import content

    before, comma, word = prefix.rpartition(",")
    rules = registry.load(content.roots("rules"))
    words = list(selection.area_prefixes(rules))
    words += [text for rule in all_rules(rules) for text in (rule.code, rule.name)]
    words += [text for code, style in CODES.items() for text in (code, style.name)]
    matches = [text for text in dict.fromkeys(words) if text.startswith((word, word.upper()))]
    return [f"{before}{comma}{text}" for text in matches]
