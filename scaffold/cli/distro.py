"""Which distributions a verb works for: the flag, the configuration, the record, the default."""

from __future__ import annotations

import json
import os
from typing import TYPE_CHECKING

from scaffold import distributions
from scaffold.writing.transaction import RECORD

if TYPE_CHECKING:
    import argparse
    from collections.abc import Sequence

    from scaffold.configuration.config import Config
    from scaffold.distributions import Distribution
    from scaffold.files.disk import Disk
    from scaffold.generate.questions.questions import Given

KEY = "check.distribution"
VARIABLE = distributions.VARIABLE
FLAG = "--distro"
ANSWER = "distro"
"""The question of `new` that the record in a package keeps the answer to."""


def add_argument(parser: argparse.ArgumentParser) -> None:
    """Define the flag."""
    parser.add_argument(
        FLAG,
        metavar="NAMES",
        help="the distributions of ROS 2 to check for, separated by commas "
        f"(default: {KEY} of the configuration, else what `new --distro` made the package for, "
        f"else {distributions.DEFAULT})",
    )


def wanted(flag: str | None, settings: Config) -> list[Distribution] | None:
    """Return the distributions that the user names, oldest first; ``None`` if that is none.

    Args:
        flag: The value of the flag.
        settings: The configuration.

    Raises:
        InputError: there is no distribution of a name.
    """
    if flag is not None:
        return distributions.several(flag, FLAG)
    if KEY not in settings.values:
        return None
    value = settings.value(KEY)
    return distributions.several(value if isinstance(value, str) else ",".join(value), KEY)


def chosen(flag: str | None, settings: Config) -> list[Distribution]:
    """Return the distributions for packages without a record; see `wanted`."""
    return wanted(flag, settings) or [distributions.named(distributions.DEFAULT)]


def recorded(directory: str, disk: Disk | None = None) -> list[Distribution] | None:
    """Return what the record in a package says that it is for; ``None`` without a record.

    A record of a version that did not ask is of a package for the default, a damaged one is left to
    the verbs that need the rest of it.

    Args:
        directory: Of the package.
        disk: Records what was accessed.

    Raises:
        InputError: it names a distribution that is not known.
    """
    from scaffold.files.disk import Disk

    disk = disk or Disk()
    path = os.path.join(directory, RECORD)
    if not disk.is_file(path):
        return None
    try:
        names = json.loads(disk.read(path))["answers"].get(ANSWER, distributions.DEFAULT)
        text = names if isinstance(names, str) else ",".join(names)
    except (OSError, ValueError, KeyError, TypeError, AttributeError, RecursionError):
        return None
    return distributions.several(text, path)


def usual(settings: Config) -> dict[str, Given]:
    """Return the answer for new packages: of the configuration, else of the shell, if there is one.

    Raises:
        InputError: there is no distribution of a name in the configuration.
    """
    from scaffold.generate.questions.questions import Given

    named = wanted(None, settings)
    if named is not None:
        return {ANSWER: Given([item.name for item in named], KEY)}
    name = os.environ.get(VARIABLE, "")
    return {ANSWER: Given([name], VARIABLE)} if name in distributions.NAMES else {}


def note(targets: Sequence[Distribution]) -> tuple[str, ...]:
    """Return the line about a shell that is set up for another distribution, if it is."""
    name = os.environ.get(VARIABLE, "")
    if not name or name in [target.name for target in targets]:
        return ()
    checked = f"checked for {distributions.titles(targets)}, although {VARIABLE} is {name!r}"
    is_known = name in distributions.NAMES
    return (f"{checked}: {FLAG} {name} checks for that",) if is_known else (checked,)
