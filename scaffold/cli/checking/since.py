"""``check --since REV``: findings in changed files, and those that the change causes elsewhere."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

from scaffold.errors import InputError
from scaffold.smoke.selection import needed_by

if TYPE_CHECKING:
    import argparse
    from collections.abc import Sequence

    from scaffold.check.result import Result
    from scaffold.check.session import Session
    from scaffold.diagnostic import Diagnostic
    from scaffold.model.discovery.targets import Target
    from scaffold.model.package import Package


def validate(options: argparse.Namespace) -> None:
    """Reject conflicting flags.

    Raises:
        InputError: they conflict.
    """
    for flag in ("fix", "diff", "reference", "stdin_filename", "write_baseline"):
        if options.since is not None and getattr(options, flag):
            raise InputError(f"--since only reports: omit --{flag.replace('_', '-')}")


class Since:
    """A check of the differences from a commit.

    Args:
        directory: Where the checked packages are.
        revision: The commit as given by the user.
        targets: The packages.

    Raises:
        InputError: there is no git, no repository, or no such commit.
    """

    def __init__(self, directory: str, revision: str, targets: Sequence[Target]) -> None:
        from scaffold.programs.git_tree import Commit

        self._commit = Commit(directory, revision)
        self._revision = revision
        self._all = targets
        self._changed = self._commit.changed()

    def targets(self) -> list[Target]:
        """Return the packages with changed files, and those that depend on them."""
        touched = [target for target in self._all if self._is_touched(target.package)]
        names = {target.package.name for target in touched} | self._old_names()
        pending = [target for target in self._all if target not in touched]
        while True:
            depending = [
                candidate
                for candidate in pending
                if not names.isdisjoint(needed_by(candidate.package))
            ]
            if not depending:
                break
            touched += depending
            names |= {target.package.name for target in depending}
            pending = [target for target in pending if target not in depending]
        return [target for target in self._all if target in touched]

    def limit(self, results: Sequence[Result], session: Session) -> tuple[list[Result], str]:
        """Return the findings touched or caused by the change, and a line about the rest.

        Args:
            results: The results of `targets`.
            session: The session that checked them; it also checks the commit if necessary.
        """
        from scaffold.check.result import Result
        from scaffold.reporters.fingerprints import Fingerprints
        from scaffold.reporters.summary import count

        elsewhere = any(
            not self._is_changed(result.package, item)
            for result in results
            for item in result.diagnostics
        )
        old = self._old_fingerprints(session, results) if elsewhere else frozenset[str]()
        fingerprints = Fingerprints(self._path)
        kept: list[Result] = []
        hidden = ignored = 0
        for result in results:
            new = []
            for item in result.diagnostics:
                is_old = fingerprints.of(result.package, item) in old
                if is_old and not self._is_changed(result.package, item):
                    hidden += 1
                elif self._is_ignored(result.package, item):
                    ignored += 1
                else:
                    new.append(item)
            kept.append(Result(result.package, result.files, new))
        old_ones = f"{count(hidden, 'older finding')} in other files hidden"
        note = f"since {self._revision}: {count(len(self._changed), 'changed file')}; {old_ones}"
        note += f", {ignored:,} in files that git ignores" if ignored else ""
        return kept, note

    def _path(self, package: Package, path: str) -> str:
        return _relative_to(self._commit.top, os.path.join(package.directory, path))

    def _is_touched(self, package: Package) -> bool:
        place = self._path(package, "")
        prefix = "" if place == os.curdir else f"{place}/"
        return any(path.startswith(prefix) for path in self._changed)

    def _is_changed(self, package: Package, diagnostic: Diagnostic) -> bool:
        return self._path(package, diagnostic.location.path) in self._changed

    def _is_ignored(self, package: Package, diagnostic: Diagnostic) -> bool:
        path = self._path(package, diagnostic.location.path)
        is_there = os.path.exists(os.path.join(self._commit.top, path))
        return is_there and path not in self._commit.listed

    def _old_names(self) -> set[str]:
        """Return the old names of changed, moved and removed packages."""
        from scaffold.files.tree import MANIFEST
        from scaffold.model.package import Package

        blobs = self._commit.files()
        manifests = {
            path: blob
            for path, blob in blobs.items()
            if path in self._changed and os.path.basename(path) == MANIFEST
        }
        return {Package.of({MANIFEST: data}).name for _, data in self._commit.read(manifests)}

    def _old_fingerprints(self, session: Session, results: Sequence[Result]) -> frozenset[str]:
        """Return the findings in the same packages of the commit, whose code is not run."""
        from tempfile import TemporaryDirectory

        from scaffold.model.discovery import targets as discovery
        from scaffold.reporters.fingerprints import Fingerprints

        with TemporaryDirectory(prefix="ros2-scaffold-") as made:
            top = os.path.realpath(made)
            self._commit.export(top)
            os.mkdir(os.path.join(top, ".git"))  # marks the top of a repository
            places = [os.path.join(top, self._path(checked.package, "")) for checked in self._all]
            packages = [place for place in places if _is_package(place)]
            wanted = {self._path(result.package, "") for result in results}
            targets = [
                target
                for target in (discovery.find(packages) if packages else [])
                if _relative_to(top, target.package.directory) in wanted
            ]

            def path_of(package: Package, path: str) -> str:
                return _relative_to(top, os.path.join(package.directory, path))

            fingerprints = Fingerprints(path_of)
            return frozenset(
                fingerprints.of(result.package, item)
                for result in session.run(targets)
                for item in result.diagnostics
            )


def _is_package(directory: str) -> bool:
    from scaffold.files.tree import MANIFEST

    return os.path.isfile(os.path.join(directory, MANIFEST))


def _relative_to(top: str, path: str) -> str:
    return os.path.relpath(os.path.realpath(path), top).replace(os.sep, "/")
