"""Migrates packages in memory: findings, fixes, and remaining consequences."""

from __future__ import annotations

from typing import TYPE_CHECKING

from scaffold import distributions
from scaffold.record import NamedTuple

if TYPE_CHECKING:
    import argparse
    from collections.abc import Mapping, Sequence

    from scaffold.check.fixes.fixer import Fixed
    from scaffold.check.migration import Consequences, MigratingSession, OrderSession
    from scaffold.check.result import Result
    from scaffold.check.session import Session
    from scaffold.cli.choices import Choices
    from scaffold.distributions import Distribution
    from scaffold.model.discovery.targets import Target


class Move(NamedTuple):
    """A migration of packages from one distribution to another."""

    origin: Distribution
    directories: Sequence[str]
    target: Distribution
    kept: Sequence[Distribution]


class Moved(NamedTuple):
    """The result of a migration, in memory."""

    consequences: Sequence[Consequences]
    """The remaining consequences."""
    fixed: Mapping[str, Fixed]
    """The fixed packages by directory; empty without fixes."""
    types_failure: str

    @property
    def arrived(self) -> list[str]:
        """The directories of packages without remaining consequences."""
        if self.types_failure:
            return []
        return [item.result.package.directory for item in self.consequences if item.is_done]


class Mover:
    """Checks and fixes packages that are migrated.

    Args:
        options: The flags of the verb.
        choices: The rules.
    """

    def __init__(self, options: argparse.Namespace, choices: Choices) -> None:
        self._options = options
        self._choices = choices
        self._fixed: dict[str, Fixed] = {}

    def move(self, move: Move) -> Moved:
        """Compute the consequences of a move, after fixes if requested."""
        from scaffold.check.migration import Consequences, identities

        has_fixes = self._options.fix or self._options.diff
        origin, target = move.origin, move.target
        session = self.session(is_back=target.place < origin.place)
        self._fixed = {}
        with distributions.targeting(origin):
            session.known = identities(self._checked(session, move))
            ordering = self._ordering(move) if has_fixes else None
        if ordering is not None:
            with distributions.targeting(target, origin, move.kept):
                self._fix(session, move)
            with distributions.targeting(origin):
                self._fix(ordering, move)
        with distributions.targeting(target, origin, move.kept):
            results = self._checked(session, move)
        results = self._with_kept(move, session, results)
        rules = self._choices.rules
        consequences = [Consequences.of(result, rules, session.known, origin) for result in results]
        return Moved(consequences, self._fixed, session.types_failure)

    def session(self, *, is_back: bool) -> MigratingSession:
        """Return the session for packages.

        Args:
            is_back: Whether packages move to an older distribution.
        """
        from scaffold.check.migration import CODES, MigratingSession, deprecations

        choices = self._choices
        selection = choices.selection([",".join(CODES)])
        session = MigratingSession(choices.rules, selection, choices.adjustments(), has_types=True)
        if is_back:
            session.improved = deprecations(choices.rules)
        return session

    def _with_kept(
        self, move: Move, session: MigratingSession, results: Sequence[Result]
    ) -> list[Result]:
        """Add the findings for kept distributions to the results for the target."""
        from scaffold.check.migration import identities
        from scaffold.check.several import merged

        kept = [
            distribution for distribution in move.kept if distribution.place != move.target.place
        ]
        if not kept:
            return [*results]
        everything = self.session(is_back=False)
        with distributions.targeting(move.target, move.origin, move.kept):
            at_target = identities(self._checked(everything, move))
        by_distribution = {move.target: results}
        for distribution in kept:
            checking = self.session(is_back=distribution.place < move.origin.place)
            checking.known, checking.at_target = session.known, at_target
            with distributions.targeting(distribution, move.origin, move.kept):
                consequences = self._checked(checking, move)
            by_distribution[distribution] = [item.without_fixes() for item in consequences]
            session.types_failure = session.types_failure or checking.types_failure
        # Fixes must be valid for the target and the kept distributions.
        return merged(
            by_distribution,
            {item.code for distribution in results for item in distribution.diagnostics},
        )

    def _ordering(self, move: Move) -> OrderSession:
        """Return the fixes that sort imports left unsorted by other fixes.

        They are those for the origin, where only the fixes have changed something; files
        whose imports are no worse than before are not changed.
        """
        from scaffold.check.migration import ORDER, OrderSession, unordered

        selection = self._choices.selection([",".join(ORDER)])
        session = OrderSession(self._choices.rules, selection, self._choices.adjustments())
        session.unordered = unordered(self._checked(session, move))
        return session

    def _fix(self, session: Session, move: Move) -> None:
        from scaffold.check.fixes import workspace_fixer
        from scaffold.cli.interactive.progress import Bar

        targets = self._targets(session, move)
        with Bar() as bar:
            unsafe = self._options.unsafe_fixes
            fixed = workspace_fixer.fix(targets, session, bar, unsafe=unsafe)
        for item in fixed:
            before = self._fixed.get(item.package.directory)
            self._fixed[item.package.directory] = item if before is None else before.then(item)

    def _targets(self, session: Session, move: Move) -> list[Target]:
        """Return the packages with their fixes."""
        from scaffold.check.fixes.overlay import Overlay
        from scaffold.cli.packages import find_targets

        found = find_targets(self._options, session, None)
        targets = [item for item in found if item.package.directory in move.directories]
        for target in targets:
            fixed = self._fixed.get(target.package.directory)
            if fixed is not None and fixed.is_change:
                target.package.change(Overlay.of(target.package.tree, fixed))
        return targets

    def _checked(self, session: Session, move: Move) -> list[Result]:
        from scaffold.cli.interactive import progress

        targets = self._targets(session, move)
        if any(item.is_change for item in self._fixed.values()):  # which is in memory
            return session.run_batch(targets)
        return list(progress.shown(session.run(targets), len(targets), "packages"))
