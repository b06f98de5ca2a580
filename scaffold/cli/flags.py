"""Flags that several verbs share."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import argparse
    from typing import TypeAlias

    Parser: TypeAlias = argparse.ArgumentParser | argparse._ArgumentGroup  # noqa: SLF001  it has no other name

ANSWERED_BY_FILE = "; their questions are answered with --answers"
"""The flags of a verb are laid out before ``--content`` is read."""


def add_looking(parser: Parser) -> None:
    """Define the flags of verbs that write, for users who want a preview."""
    parser.add_argument(
        "--dry-run", action="store_true", help="show what would be written, and write nothing"
    )
    parser.add_argument(
        "--diff", action="store_true", help="show the changes as a diff, and write nothing"
    )


def add_content(parser: Parser, note: str = "") -> None:
    """Define the flag for templates of a team; a note says what else the verb's users must know."""
    parser.add_argument(
        "--content",
        action="append",
        default=[],
        metavar="DIR",
        help=f"a directory with templates/ of your own{note}",
    )


def add_answers(parser: Parser) -> None:
    """Define the flag for an answers file."""
    parser.add_argument(
        "--answers", metavar="FILE", help="a YAML file with answers; flags take precedence"
    )


def offer_rules(prefix: str, **_: object) -> list[str]:
    """Offer the codes and names of rules to who presses tab, also after a comma."""
    from scaffold.ament.codes import CODES
    from scaffold.check import registry
    from scaffold.check.session import all_rules
    from scaffold.configuration import content

    before, comma, word = prefix.rpartition(",")
    rules = all_rules(registry.load(content.roots("rules")))
    words = [text for rule in rules for text in (rule.code, rule.name)]
    words += [text for code, style in CODES.items() for text in (code, style.name)]
    matches = [text for text in dict.fromkeys(words) if text.startswith((word, word.upper()))]
    return [f"{before}{comma}{text}" for text in matches]
