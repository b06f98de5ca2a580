"""A check for several distributions: each finding once, with those that it holds for."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

from scaffold import distributions

if TYPE_CHECKING:
    from scaffold.check.result import Result
    from scaffold.diagnostic import Diagnostic
    from scaffold.distributions import Distribution

    Key = tuple[str, tuple[object, ...], str]

_TITLES = "|".join(name.capitalize() for name in distributions.NAMES)
_NAMED = re.compile(rf"\b(?:{_TITLES}|Python 3\.\d+|\d+\.\d+\.\d+ of ROS 2)\b")
"""What a message may say of the distribution that it is about."""


def merged(by_distribution: Mapping[Distribution, Sequence[Result]]) -> list[Result]:
    """Return one result for each package, with the findings for all distributions.

    Args:
        by_distribution: The results for each distribution, in the same packages.
    """
    first, *_ = by_distribution.values()
    results: list[Result] = []
    for at, result in enumerate(first):
        findings = {
            distribution: results_[at].diagnostics
            for distribution, results_ in by_distribution.items()
        }
        results.append(result._replace(diagnostics=_merged(findings), verdict=None))
    return results


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
    result = [item._replace(distributions=tuple(holding[key])) for key, item in by_key.items()]
    return sorted(result, key=lambda item: item.sort_key)
