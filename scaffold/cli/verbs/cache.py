"""``ros2-scaffold cache``."""

from __future__ import annotations

import argparse

from scaffold.cli import terminal

ACTIONS = ("show", "clean")
_KILO = 1000


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Define the flags of the verb."""
    parser.description = (
        "Show the location and size of the cache, or clean it. The cache only saves time and can "
        "be removed at any moment."
    )
    parser.add_argument(
        "action",
        nargs="?",
        choices=ACTIONS,
        default="show",
        help="show its location and size (default), or remove everything in it",
    )


def run(options: argparse.Namespace) -> int:
    """Show the cache, or clean it."""
    from scaffold.cli.exit_codes import CLEAN
    from scaffold.errors import ConfigError
    from scaffold.files import cache, home

    place = home.cache()
    if place is None:
        raise ConfigError("no home directory for the cache; set HOME")
    if options.action == "show":
        terminal.show(f"{place}: {_size_text(*cache.size(place))}")
    else:
        before = cache.size(place)
        cache.clean(place)
        terminal.show(f"{place}: {_size_text(*before)} removed")
    return CLEAN


def _size_text(files: int, size: int) -> str:
    number = float(size)
    units = iter(("bytes", "kB", "MB"))
    unit = next(units)
    while number >= _KILO and (larger := next(units, "")):
        number, unit = number / _KILO, larger
    shown = f"{number:.1f}" if unit != "bytes" else str(size)
    return f"{files} file{'' if files == 1 else 's'}, {shown} {unit}"
