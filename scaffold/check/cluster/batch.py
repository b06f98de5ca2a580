"""Checks a batch of packages on a worker of a cluster."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from scaffold import distributions
from scaffold.check.adjustments import Adjustments
from scaffold.check.rules import registry
from scaffold.check.selection import Selection
from scaffold.check.session import Session
from scaffold.cluster import mirror
from scaffold.configuration import content
from scaffold.diagnostic import Diagnostic
from scaffold.files.disk import Disk
from scaffold.model.discovery import targets as discovery
from scaffold.model.discovery.foreign import Foreign
from scaffold.model.discovery.targets import Target
from scaffold.model.workspace.policy import Policy

Key = tuple[str, tuple[str, ...] | None]
"""The directory of a target, and the files that it is limited to."""


@dataclass(frozen=True)
class Settings:
    """The settings of a session, and the origins of its packages."""

    selection: Selection
    adjustments: Adjustments
    has_types: bool
    is_reference: bool
    line_length: int | None
    paths: tuple[str, ...]
    whole_packages: bool
    policy: Policy


@dataclass(frozen=True)
class Batch:
    """Targets to check, and inputs of the check other than files."""

    targets: frozenset[Key]
    settings: Settings
    current: str
    """The current directory of the client."""
    target: str
    """The distribution."""
    kept: tuple[str, ...]
    """The kept distributions."""
    variables: Mapping[str, str]
    """The environment variables, with paths in the mirror."""


@dataclass(frozen=True)
class Checked:
    """The findings in a target."""

    key: Key
    files: int
    diagnostics: Sequence[Diagnostic]
    foreign: tuple[str, ...]


@dataclass(frozen=True)
class Answer:
    """The result of a batch."""

    checked: Sequence[Checked]
    types_failure: str


def key_of(target: Target, top: str = "") -> Key:
    """Return the key of a target, the same on all machines.

    Args:
        target: The target.
        top: The directory of the mirror.
    """
    only = None if target.only is None else tuple(sorted(target.only))
    return target.package.directory.removeprefix(top), only


def check(batch: Batch, files: mirror.Mirror) -> Answer:
    """Check a batch; it changes the current directory and the environment of this process.

    Args:
        batch: The batch.
        files: The packages and their surroundings.
    """
    with tempfile.TemporaryDirectory(prefix="ros2-scaffold-") as scratch:
        top = os.path.realpath(scratch)
        mirror.unpack(files, top)
        os.chdir(top + batch.current)
        for name, value in batch.variables.items():
            paths = value.split(os.pathsep)
            os.environ[name] = os.pathsep.join(top + path for path in paths)
        kept = [distributions.named(name) for name in batch.kept]
        try:
            with distributions.targeting(distributions.named(batch.target), kept=kept):
                return _check_batch(batch, top)
        finally:
            os.chdir(os.sep)


def _check_batch(batch: Batch, top: str) -> Answer:
    settings = batch.settings
    adjustments = settings.adjustments
    exclusion = adjustments.exclusion
    if exclusion.origin:
        exclusion = exclusion._replace(origin=top + exclusion.origin)
    foreign = Foreign(tuple(adjustments.foreign.kinds) if adjustments.foreign else ())
    selection = settings.selection
    if selection.origin:
        selection = selection._replace(origin=top + selection.origin)
    session = Session(
        registry.load(content.roots("rules", ())),
        selection,
        adjustments._replace(exclusion=exclusion, foreign=foreign),
        has_types=settings.has_types,
        is_reference=settings.is_reference,
        line_length=settings.line_length,
    )
    targets = discovery.find(
        [top + path if os.path.isabs(path) else path for path in settings.paths],
        Disk(),
        whole_packages=settings.whole_packages,
        exclusion=exclusion,
        foreign=foreign,
        policy=settings.policy,
    )
    own = [target for target in targets if key_of(target, top) in batch.targets]
    return Answer([*_results(session, own, top)], session.types_failure)


def _results(session: Session, targets: Sequence[Target], top: str) -> Iterator[Checked]:
    for target, result in zip(targets, session.run_batch(targets), strict=True):
        diagnostics = [
            item._replace(message=item.message.replace(top, "")) for item in result.diagnostics
        ]
        yield Checked(key_of(target, top), result.files, diagnostics, result.foreign)
