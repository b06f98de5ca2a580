"""A check for several distributions: each finding once, with those that it holds for."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

from scaffold import distributions
from scaffold.check.engine_rules import UnusedSuppression
from scaffold.check.session import Session

if TYPE_CHECKING:
    from scaffold.check.result import Result
    from scaffold.diagnostic import Diagnostic
    from scaffold.distributions import Distribution
    from scaffold.model.discovery.targets import Target

    Agreed = frozenset[tuple[str, str, str]]
    Key = tuple[str, tuple[object, ...], str]

_TITLES = "|".join(name.capitalize() for name in distributions.NAMES)
_NAMED = re.compile(rf"\b(?:{_TITLES}|Python 3\.\d+|\d+\.\d+\.\d+ of ROS 2)\b")
"""What a message may say of the distribution that it is about."""


class AgreedSession(Session):
    """Offers, where packages are for several distributions, the fixes that are right for all."""

    agreed: Agreed | None = None
    """What `agreed` returns; ``None`` to offer all fixes."""

    def _report(self, target: Target, diagnostics: list[Diagnostic]) -> list[Diagnostic]:
        reported = super()._report(target, diagnostics)
        if self.agreed is None:
            return reported
        directory = target.package.directory
        return [
            item
            if item.code in self.codes_fixed_for_all
            or (directory, item.location.path, item.code) in self.agreed
            else item._replace(fix=None)
            for item in reported
        ]


def agreed(by_distribution: Mapping[Distribution, Sequence[Result]]) -> Agreed:
    """Return the codes, with directory and file, that are found for all distributions."""
    found = [
        {
            (result.package.directory, item.location.path, item.code)
            for result in results
            for item in result.diagnostics
        }
        for results in by_distribution.values()
    ]
    return frozenset.intersection(*map(frozenset, found))


def merged(by_distribution: Mapping[Distribution, Sequence[Result]]) -> list[Result]:
    """Return one result for each package, with the findings for all distributions.

    Args:
        by_distribution: The results for each distribution, in the packages that are for it.
    """
    by_package: dict[str, dict[Distribution, Result]] = {}
    for distribution, results in by_distribution.items():
        for result in results:
            by_package.setdefault(result.package.directory, {})[distribution] = result
    return [
        next(iter(those.values()))._replace(
            diagnostics=_merged({item: result.diagnostics for item, result in those.items()}),
            verdict=None,
        )
        for those in by_package.values()
    ]


def without_distribution(message: str) -> str:
    """Return a message without what it says of the distribution that it is about."""
    return _NAMED.sub("", message)


def _merged(by_distribution: Mapping[Distribution, Sequence[Diagnostic]]) -> list[Diagnostic]:
    by_key: dict[Key, Diagnostic] = {}
    holding: dict[Key, list[str]] = {}
    for distribution, diagnostics in by_distribution.items():
        for item in diagnostics:
            key = (item.code, tuple(item.location), without_distribution(item.message))
            by_key.setdefault(key, item)
            names = holding.setdefault(key, [])
            if distribution.name not in names:
                names.append(distribution.name)
    # A suppression that one of them needs is not unused.
    result = [
        item._replace(distributions=tuple(holding[key]))
        for key, item in by_key.items()
        if item.code != UnusedSuppression.code or len(holding[key]) == len(by_distribution)
    ]
    return sorted(result, key=lambda item: item.sort_key)
