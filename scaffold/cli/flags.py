"""Flags that several verbs share."""

from __future__ import annotations

import argparse

ANSWERED_BY_FILE = "; their questions are answered with --answers"
"""The flags of a verb are laid out before ``--content`` is read."""


def add_looking(parser: argparse.ArgumentParser) -> None:
    """Define the flags of verbs that write, for users who want to look first."""
    parser.add_argument(
        "--dry-run", action="store_true", help="show what would be written, and write nothing"
    )
    parser.add_argument(
        "--diff", action="store_true", help="show the changes as a diff, and write nothing"
    )


def add_content(parser: argparse.ArgumentParser, note: str = "") -> None:
    """Define the flag for templates of a team; a note says what else the verb's users must know."""
    parser.add_argument(
        "--content",
        action="append",
        default=[],
        metavar="DIR",
        help=f"a directory with templates/ of your own{note}",
    )


def add_answers(parser: argparse.ArgumentParser) -> None:
    """Define the flag for an answers file."""
    parser.add_argument(
        "--answers", metavar="FILE", help="a YAML file with answers; flags take precedence"
    )
