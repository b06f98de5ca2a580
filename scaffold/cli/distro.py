"""The target distributions of a verb: flag, configuration, record or default."""

from __future__ import annotations

import json
import os
from typing import TYPE_CHECKING

from scaffold import distributions
from scaffold.errors import InputError
from scaffold.files.disk import Disk
from scaffold.writing.transaction import RECORD

if TYPE_CHECKING:
    import argparse
    from collections.abc import Mapping, Sequence

    from scaffold.configuration.config import Config
    from scaffold.distributions import Distribution
    from scaffold.generate.questions.questions import Given

KEY = "check.distribution"
VARIABLE = distributions.VARIABLE
FLAG = "--distro"
ANSWER = "distro"
"""The question of `new` whose answer is in the record of a package."""


def add_argument(parser: argparse.ArgumentParser) -> None:
    """Define the flag."""
    parser.add_argument(
        FLAG,
        action="append",
        metavar="NAMES",
        help="the ROS 2 distributions to check for, separated by commas "
        f"(default: {KEY} of the configuration, else what `new --distro` created the package for, "
        f"else {distributions.DEFAULT})",
    )


def wanted(flag: Sequence[str] | None, settings: Config) -> list[Distribution] | None:
    """Return the distributions given by the user, oldest first; ``None`` if there are none.

    Args:
        flag: The values of the flag, which may be repeated.
        settings: The configuration.

    Raises:
        InputError: a distribution is unknown.
    """
    if flag is not None:
        return distributions.several(",".join(flag), FLAG)
    if KEY not in settings.values:
        return None
    value = settings.value(KEY)
    return distributions.several(value if isinstance(value, str) else ",".join(value), KEY)


def chosen(flag: Sequence[str] | None, settings: Config) -> list[Distribution]:
    """Return the distributions for packages without a record; see `wanted`."""
    return wanted(flag, settings) or [distributions.named(distributions.DEFAULT)]


def recorded(
    directory: str, disk: Disk | None = None, *, is_needed: bool = False
) -> list[Distribution] | None:
    """Return the distributions recorded in a package; ``None`` without a record.

    Args:
        directory: The directory of the package.
        disk: Records what was accessed.
        is_needed: Whether a damaged record has to be reported here.

    Raises:
        InputError: it names an unknown or no longer supported distribution, or it is
            damaged.
    """
    names = recorded_names(directory, disk)
    path = os.path.join(directory, RECORD)
    if names is None:
        if is_needed and (disk or Disk()).is_file(path):
            raise InputError(
                f"{path}: damaged, so the distribution of the package is unknown: restore the "
                f"file, or use {FLAG}"
            )
        return None
    for name in names:
        if name in distributions.ENDED:
            raise InputError(
                f"{path}: {name!r} {distributions.ending(name)}; migrate the package with "
                f"`ros2-scaffold migrate {directory} --to NAME --fix`"
            )
    return distributions.several(",".join(names), path)


def recorded_names(directory: str, disk: Disk | None = None) -> list[str] | None:
    """Return the names in the record of a package, known or not; ``None`` without a record.

    A record of an early version means the default distribution; a damaged one is left to
    the verbs that need the rest of it.

    Args:
        directory: The directory of the package.
        disk: Records what was accessed.
    """
    disk = disk or Disk()
    path = os.path.join(directory, RECORD)
    if not disk.is_file(path):
        return None
    try:
        names = json.loads(disk.read(path))["answers"].get(ANSWER, distributions.DEFAULT)
        text = names if isinstance(names, str) else ",".join(names)
    except (OSError, ValueError, KeyError, TypeError, AttributeError, RecursionError):
        return None
    return [word.strip() for word in text.split(",") if word.strip()]


def usual(settings: Config) -> dict[str, Given]:
    """Return the answer for new packages: from the configuration, or else from the shell.

    Raises:
        InputError: a distribution in the configuration is unknown.
    """
    from scaffold.generate.questions.questions import Given

    named = wanted(None, settings)
    if named is not None:
        return {ANSWER: Given([item.name for item in named], KEY)}
    name = os.environ.get(VARIABLE, "")
    return {ANSWER: Given([name], VARIABLE)} if name in distributions.NAMES else {}


def note(targets: Sequence[Distribution]) -> tuple[str, ...]:
    """Return a note if the shell is set up for another distribution."""
    name = os.environ.get(VARIABLE, "")
    if not name or name in [target.name for target in targets]:
        return ()
    checked = f"checked for {distributions.titles(targets)}, although {_of_shell(name)}"
    is_known = name in distributions.NAMES
    return (f"{checked}; use {FLAG} {name} to check for that",) if is_known else (checked,)


def note_of_new(given: Mapping[str, Given]) -> tuple[str, ...]:
    """Return a note on the distribution of a new package if only ROS_DISTRO names one.

    Args:
        given: The answers, including that of `usual`.
    """
    name = os.environ.get(VARIABLE, "")
    answer = given.get(ANSWER)
    others = f"use {FLAG} NAMES for others"
    if name and answer is None:
        title = distributions.target().title
        return (f"created for {title}, although {_of_shell(name)}; {others}",)
    if answer is not None and answer.origin == VARIABLE and name != distributions.DEFAULT:
        return (f"created for {distributions.named(name).title}, as {_of_shell(name)}; {others}",)
    return ()


def note_of_smoke(observed: str) -> tuple[str, ...]:
    """Return a note if the shell is set up for another distribution than the observed one."""
    name = os.environ.get(VARIABLE, "")
    if name in {"", observed}:
        return ()
    return (f"observed on {observed.capitalize()}, although {_of_shell(name)}",)


def _of_shell(name: str) -> str:
    """Describe the value of ROS_DISTRO, and why it is not supported, if so."""
    is_known = name in distributions.NAMES
    return f"{VARIABLE} is {name!r}" + ("" if is_known else f", which {distributions.ending(name)}")
