"""``ros2-scaffold trust [DIR]``."""

from __future__ import annotations

import argparse
import os

from scaffold.cli import terminal


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Define the flags of the verb."""
    parser.description = (
        "Trust the configuration in a directory (ros2-scaffold.toml or pyproject.toml) to load "
        "its own rules and templates. Rules are Python code that later runs in the directory "
        "execute. Trust applies to this directory, not to those below it, until you remove it."
    )
    parser.add_argument(
        "directory",
        nargs="?",
        metavar="DIR",
        help="the directory with the configuration, or the URL of a git repository for --content",
    )
    action = parser.add_mutually_exclusive_group()
    action.add_argument("--list", action="store_true", help="list the trusted directories")
    action.add_argument("--remove", action="store_true", help="stop trusting the directory")


def run(options: argparse.Namespace) -> int:
    """Change or show the list of trusted directories."""
    from scaffold.cli.exit_codes import CLEAN
    from scaffold.configuration import content, trust
    from scaffold.errors import InputError

    if options.list:
        if options.directory is not None:
            raise InputError("--list takes no DIR")
        _list()
    elif options.directory is None:
        raise InputError("DIR is required: the directory with the ros2-scaffold.toml")
    elif options.remove:
        terminal.show(f"no longer trusted: {trust.remove(options.directory)}")
    elif content.is_url(options.directory):
        trust.add_url(options.directory)
        terminal.show(f"trusted: {options.directory}")
    else:
        _add(options.directory)
    return CLEAN


def _add(directory: str) -> None:
    from scaffold.configuration import config, content, trust
    from scaffold.files.disk import Disk

    # Before anything is trusted, as the file may be broken.
    has_file = config.file_in(Disk(), os.path.realpath(directory)) is not None
    names = config.named_content(os.path.realpath(directory))
    real = trust.add(directory)
    terminal.show(f"trusted: {real}")
    for name in names:
        place = name if content.is_url(name) else os.path.normpath(name)
        terminal.show(f"    rules and templates from {place}")
    if not has_file:
        terminal.note(
            f"there is no {config.PROJECT_FILE} in {real}; trust applies to the directory that "
            "contains it, not to those below"
        )


def _list() -> None:
    from scaffold.configuration import trust
    from scaffold.files.disk import Disk

    disk = Disk()
    for directory, owner in trust.trusted(disk).items():
        note = ""
        if not disk.is_directory(directory):
            note = "  (gone)"
        elif disk.owner(directory) != owner:
            note = "  (no longer trusted: its owner has changed)"
        terminal.show(f"{directory}{note}")
    for url in trust.trusted_urls():
        terminal.show(url)
