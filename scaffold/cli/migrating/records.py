"""Updates the recorded distribution of packages after a migration."""

from __future__ import annotations

import json
import os
import re
from typing import TYPE_CHECKING

from scaffold import distributions, lazy_re
from scaffold.cli import distro
from scaffold.record import NamedTuple
from scaffold.writing.transaction import RECORD

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping, Sequence

    from scaffold.configuration.config import Config
    from scaffold.distributions import Distribution


class Recorded(NamedTuple):
    """The records that were updated, and those that were not."""

    before: Mapping[str, Sequence[str]]
    """The old distributions of packages with changed records, by directory."""
    has_others: bool
    """Whether there are packages without a record."""


_ANSWERS = lazy_re.compile(r'^  "answers": \{\n', re.MULTILINE)
_ANSWER = lazy_re.compile(rf'^    "{distro.ANSWER}": [^\n]*,\n', re.MULTILINE)


def plan(directory: str, targets: Sequence[Distribution]) -> tuple[bytes, bytes] | None:
    """Return the old and the new record; ``None`` if there is nothing to change.

    Args:
        directory: The directory of the package.
        targets: The new distributions of the package.
    """
    names = [target.name for target in targets]
    if distro.recorded_names(directory) in (None, names):
        return None
    with open(os.path.join(directory, RECORD), "rb") as file:
        data = file.read()
    return data, with_answer(data.decode(), names).encode()


def notes(recorded: Recorded, targets: Sequence[Distribution], settings: Config) -> Iterator[str]:
    """Yield notes on distributions no longer recorded, and on overridden records, one line each.

    Args:
        recorded: The updated records.
        targets: The new distributions of the packages.
        settings: The configuration.
    """
    titles = distributions.titles(targets)
    same: dict[tuple[str, ...], list[str]] = {}
    for directory, before in recorded.before.items():
        others = tuple(name for name in before if not _is_among(name, targets))
        same.setdefault(others, []).append(directory)
    for dropped, directories in same.items():
        subject = "a package" if len(directories) == 1 else "packages"
        no_longer = ""
        if dropped:
            no_longer = f", no longer for {distributions.enumerated(map(str.capitalize, dropped))}"
            names = ",".join(name for name in dropped if name in distributions.NAMES)
            no_longer += f" (without --keep {names})" if names else ""
        yield (
            f"{_listed(directories)}: recorded as {subject} for {titles}{no_longer}; "
            "`ros2-scaffold update` applies the changes of the templates"
        )
    named = distro.wanted(None, settings)
    usual = named or [distributions.named(distributions.DEFAULT)]
    if usual == [*targets] or not (named or recorded.has_others):
        return
    names = ",".join(target.name for target in targets)
    checks = f"`check` without --distro checks for {distributions.titles(usual)}"
    if named:
        checks += f", as set by {distro.KEY} in {settings.origin(distro.KEY)}; change it there"
    else:
        checks += f"; set {distro.KEY} in the configuration"
    yield f"{checks}, or pass --distro {names}"


def _is_among(name: str, targets: Sequence[Distribution]) -> bool:
    """Return whether a distribution is among others, possibly under an alias."""
    places = {item.place for item in targets}
    return name in distributions.NAMES and distributions.named(name).place in places


def held(directories: Iterable[str], targets: Sequence[Distribution], *, has_unread: bool) -> str:
    """Return the note on packages that are not recorded yet; empty if none has a record.

    Args:
        directories: The directories of the packages that are not ready.
        targets: The new distributions.
        has_unread: Whether some of their files could not be read.
    """
    names = [target.name for target in targets]
    waiting = [path for path in directories if distro.recorded_names(path) not in (None, names)]
    if not waiting:
        return ""
    unread = " (files that cannot be read: with `exclude` in the configuration)"
    return (
        f"{_listed(waiting)}: not recorded for {distributions.titles(targets)} until the remaining "
        f"findings are fixed or suppressed with noqa{unread if has_unread else ''}; then run this "
        "again"
    )


def _listed(directories: Sequence[str]) -> str:
    """Return some directories; the first few, and the number of the others."""
    shown = ", ".join(map(os.path.normpath, directories[:_SHOWN]))
    return f"{shown} and {len(directories) - _SHOWN} more" if directories[_SHOWN:] else shown


_SHOWN = 3


def with_answer(text: str, names: Sequence[str]) -> str:
    """Return a record with another answer and all other lines unchanged."""
    line = f"    {json.dumps(distro.ANSWER)}: {json.dumps([*names])},\n"
    old = _ANSWER.search(text)
    if old is None:  # of a version without this question
        return _ANSWERS.sub(lambda matched: matched[0] + line, text, count=1)
    return text[: old.start()] + line + _ANSWER.sub("", text[old.end() :])
