"""The distribution that each package is migrated from."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

from scaffold import distributions
from scaffold.cli import distro
from scaffold.errors import InputError
from scaffold.record import NamedTuple

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping, Sequence

    from scaffold.configuration.config import Config
    from scaffold.distributions import Distribution


class Origins(NamedTuple):
    """The distributions that packages are migrated from."""

    directories: Mapping[Distribution, Sequence[str]]
    """The directories of the packages that move, by origin, oldest first."""
    arrived: Mapping[str, Distribution]
    """The distributions of the other packages by directory: the target or an alias."""
    assumed: Sequence[str]
    """Those of the other packages whose distribution is unknown."""
    guessed: Sequence[str]
    """Those of the migrated packages whose distribution is unknown."""
    ended: Mapping[str, Distribution]
    """Unsupported distributions in records, with the assumed origin instead."""


def find(
    flag: str | None,
    settings: Config,
    target: Distribution,
    kept: Sequence[Distribution],
    directories: Iterable[str],
) -> Origins:
    """Find the origins of packages: their oldest distribution other than the target.

    Args:
        flag: The flag.
        settings: The configuration, used without the flag; then records are used.
        target: The target.
        kept: The distributions to keep; a package only for the target comes from there.
        directories: The directories of the packages.

    Raises:
        InputError: a distribution is unknown, or the packages are for the target only as
            far as is known.
    """
    named = [distributions.named(flag, "--from")] if flag else distro.wanted(None, settings)
    groups: dict[Distribution, list[str]] = {}
    arrived: dict[str, Distribution] = {}
    assumed: list[str] = []
    guessed: list[str] = []
    ended: dict[str, Distribution] = {}
    for directory in directories:
        gone = [] if named else _unsupported(directory)
        recorded = named or _recorded(directory, gone)
        if recorded == []:
            recorded = [distributions.nearest(max(gone))]
            ended[max(gone)] = recorded[0]
        candidates = recorded or [distributions.named(distributions.DEFAULT)]
        others = [item for item in candidates if item.place != target.place]
        if not others and not flag:
            others = [item for item in kept if item.place != target.place]
        if gone and not others:  # the record changes
            others = candidates
        if others:
            groups.setdefault(distributions.ordered(others)[0], []).append(directory)
            guessed += [directory] if recorded is None else []
        else:
            arrived[directory] = candidates[-1]
            assumed += [directory] if recorded is None else []
    directories_of = {item: groups[item] for item in distributions.ordered([*groups])}
    found = Origins(directories_of, arrived, assumed, guessed, ended)
    _refuse_none(found, target, is_named=bool(flag))
    return found


def _refuse_none(found: Origins, target: Distribution, *, is_named: bool) -> None:
    """Raise InputError if no package is known to move."""
    if found.directories:
        return
    if found.assumed:
        raise InputError(_assumption(found, target))
    if is_named:
        arrived = sentence([*found.arrived.values()], target)
        raise InputError(f"{arrived}; use --from with their current distribution")


def _unsupported(directory: str) -> list[str]:
    """Return the names in the record of a package that are no longer supported."""
    names = distro.recorded_names(directory) or ()
    return [name for name in names if name in distributions.ENDED_ROS2]


def _recorded(directory: str, ended: Sequence[str]) -> list[Distribution] | None:
    """Return the recorded distributions of a package that are still supported."""
    if not ended:
        return distro.recorded(directory)
    left = [name for name in distro.recorded_names(directory) or () if name not in ended]
    return distributions.several(",".join(left), directory) if left else []


def notes(origins: Origins, target: Distribution) -> Iterator[str]:
    """Yield notes on unexpected origins of packages, one line each."""
    for name, origin in origins.ended.items():
        yield _successor_hint(name, origin)
    if origins.assumed:
        yield _assumption(origins, target)
    if origins.guessed:
        default = distributions.named(distributions.DEFAULT).title
        yield f"{_unknown(origins.guessed)}: assuming {default}; use --from for another"


def _unknown(directories: Sequence[str]) -> str:
    """Return the sentence about packages whose current distribution is unknown."""
    number = len(directories)
    names = ", ".join(map(os.path.normpath, directories[:_SHOWN]))
    if number > _SHOWN:
        names += f" and {number - _SHOWN} more"
    return f"{names}: the current distribution is neither recorded nor configured"


def _assumption(origins: Origins, target: Distribution) -> str:
    """Return the sentence about packages that are assumed to be for the target already."""
    where, _, why = _unknown(origins.assumed).partition(": ")
    return f"{where}: not migrated: {why}, and the default is {target.title}; set it with --from"


def _successor_hint(name: str, origin: Distribution) -> str:
    """Return the sentence about records of a distribution that is no longer supported."""
    title = name.capitalize()
    return (
        f"packages recorded for {title}, which {distributions.ending(name)}, are migrated from "
        f"{origin.title}, the next one: the changes between the two are unknown; `check` reports "
        "what is wrong now"
    )


_SHOWN = 5


def sentence(arrived: Sequence[Distribution], target: Distribution) -> str:
    """Return the sentence about packages that are for the target already."""
    last = arrived[-1]
    text = f"the packages are for {last.title} already"
    if last.name != target.name:
        text += f", which is the same as {target.title} for Python packages"
    return text


def shares(origins: Origins) -> str:
    """Return ``3 packages from Jazzy``, ``2 packages from Humble and 1 from Jazzy``."""
    from scaffold.reporters.summary import count

    first, *others = (
        (len(directories), origin.title) for origin, directories in origins.directories.items()
    )
    parts = [f"{count(first[0], 'package')} from {first[1]}"]
    *rest, last = [*parts, *(f"{number} from {title}" for number, title in others)]
    return f"{', '.join(rest)} and {last}" if rest else last
