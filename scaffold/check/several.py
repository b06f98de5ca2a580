"""Merges checks for several distributions: each finding once, with its distributions."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from typing import TYPE_CHECKING

from scaffold import distributions, lazy_re
from scaffold.check.rules.engine_rules import UnusedSuppression
from scaffold.check.session import Session

if TYPE_CHECKING:
    from scaffold.check.result import Result
    from scaffold.diagnostic import Diagnostic
    from scaffold.distributions import Distribution
    from scaffold.model.discovery.targets import Target

    Agreed = frozenset[tuple[str, str, str]]
    Key = tuple[str, tuple[object, ...], str]

_TITLES = "|".join(name.capitalize() for name in distributions.NAMES)
_NAMED = lazy_re.compile(rf"\b(?:{_TITLES}|Python 3\.\d+|\d+\.\d+\.\d+ of ROS 2)\b")
"""Matches a distribution in a message."""
# linear: a message is a few lines long
_JOINED = lazy_re.compile(
    rf"\b(?:(?:{_TITLES})(?:/(?:{_TITLES}))*|Python 3\.\d+(?:/3\.\d+)*"
    r"|\d+\.\d+\.\d+(?:/\d+\.\d+\.\d+)* of ROS 2)\b"
)
"""Matches several distributions, as written by `_for_all`."""


class AgreedSession(Session):
    """A session whose fixes must be correct for all distributions of a package."""

    agreed: Agreed | None = None
    """The result of `agreed`; ``None`` to offer all fixes."""

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
    """Return the codes, with directory and file, found for all distributions."""
    agreed_diagnostics = [
        {
            (result.package.directory, item.location.path, item.code)
            for result in results
            for item in result.diagnostics
        }
        for results in by_distribution.values()
    ]
    return frozenset.intersection(*map(frozenset, agreed_diagnostics))


def merged(
    by_distribution: Mapping[Distribution, Sequence[Result]], fixed_for_all: Collection[str] = ()
) -> list[Result]:
    """Return one result for each package, with the findings for all distributions.

    Args:
        by_distribution: The results for each distribution, of the packages for it.
        fixed_for_all: The codes whose fixes are valid for all, even if only some have the finding.
    """
    by_package: dict[str, dict[Distribution, Result]] = {}
    for distribution, results in by_distribution.items():
        for result in results:
            by_package.setdefault(result.package.directory, {})[distribution] = result
    return [
        next(iter(those.values()))._replace(
            diagnostics=_merged(
                {item: result.diagnostics for item, result in those.items()}, fixed_for_all
            ),
            verdict=None,
        )
        for those in by_package.values()
    ]


def without_distribution(message: str) -> str:
    """Return a message without the names of distributions."""
    return _JOINED.sub("", message)


def _for_all(messages: Sequence[str]) -> str:
    """Return the merged message of messages that only differ in their distributions.

    ``Jazzy`` in one and ``Lyrical`` in the other become ``Jazzy/Lyrical``.
    """
    words = [_NAMED.findall(message) for message in messages]
    if len({*map(len, words)}) > 1:
        return messages[0]
    joined = iter([_alternatives([*dict.fromkeys(names)]) for names in zip(*words, strict=True)])
    return _NAMED.sub(lambda _: next(joined), messages[0])


def _alternatives(names: Sequence[str]) -> str:
    """Join names with a separator, with a common prefix or suffix only once."""
    start = "Python " if names[0].startswith("Python ") else ""
    end = " of ROS 2" if names[0].endswith(" of ROS 2") else ""
    return start + "/".join(name.removeprefix(start).removesuffix(end) for name in names) + end


def _merged(
    by_distribution: Mapping[Distribution, Sequence[Diagnostic]], fixed_for_all: Collection[str]
) -> list[Diagnostic]:
    by_key: dict[Key, Diagnostic] = {}
    holding: dict[Key, dict[str, str]] = {}
    for distribution, diagnostics in by_distribution.items():
        for item in diagnostics:
            key = (item.code, tuple(item.location), without_distribution(item.message))
            by_key.setdefault(key, item)
            holding.setdefault(key, {}).setdefault(distribution.name, item.message)
    names = {key: sorted(those, key=distributions.NAMES.index) for key, those in holding.items()}
    merged = [
        {(item.location.path, item.code) for item in those} for those in by_distribution.values()
    ]
    has_fix = frozenset.intersection(*map(frozenset, merged))
    for key, item in by_key.items():
        if item.code not in fixed_for_all and (item.location.path, item.code) not in has_fix:
            by_key[key] = item._replace(fix=None)
    # A suppression needed for one of them is not unused.
    result = [
        item._replace(
            message=_for_all([holding[key][name] for name in names[key]]),
            distributions=tuple(names[key]),
        )
        for key, item in by_key.items()
        if item.code != UnusedSuppression.code or len(holding[key]) == len(by_distribution)
    ]
    return sorted(result, key=lambda item: item.sort_key)
