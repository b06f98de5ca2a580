"""Which distributions a verb works for: the flag, the configuration, else the default."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

from scaffold import distributions

if TYPE_CHECKING:
    import argparse
    from collections.abc import Sequence

    from scaffold.configuration.config import Config
    from scaffold.distributions import Distribution

KEY = "check.distribution"
VARIABLE = "ROS_DISTRO"


def add_argument(parser: argparse.ArgumentParser) -> None:
    """Define the flag."""
    parser.add_argument(
        "--distro",
        metavar="NAMES",
        help="the distributions of ROS 2 to check for, separated by commas "
        f"(default: {KEY} of the configuration, else {distributions.DEFAULT})",
    )


def chosen(flag: str | None, settings: Config) -> list[Distribution]:
    """Return the distributions, oldest first.

    Args:
        flag: The value of the flag.
        settings: The configuration.

    Raises:
        InputError: there is no distribution of a name.
    """
    if flag is not None:
        return distributions.several(flag)
    value = settings.value(KEY)
    names = [value] if isinstance(value, str) else value
    return distributions.several(",".join(names), KEY)


def note(targets: Sequence[Distribution]) -> tuple[str, ...]:
    """Return the line about a shell that is set up for another distribution, if it is."""
    name = os.environ.get(VARIABLE, "")
    if not name or name in [target.name for target in targets]:
        return ()
    checked = f"checked for {distributions.titles(targets)}, although {VARIABLE} is {name!r}"
    return (f"{checked}: --distro {name} checks for that",) if _is_known(name) else (checked,)


def _is_known(name: str) -> bool:
    return name in distributions.NAMES
