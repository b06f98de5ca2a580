"""The target distributions of a package, as a template variable."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from scaffold import distributions
from scaffold.distributions import Distribution
from scaffold.generate.questions.defaults import DISTRO
from scaffold.generate.questions.questions import Given

_SECTION = "templates"
"""The section of the profiles of distributions."""


def of(given: Mapping[str, Given]) -> list[Distribution]:
    """Return the distributions that a package is for, oldest first.

    Args:
        given: The user's answers; the default is the target of this process.

    Raises:
        InputError: a distribution is unknown.
    """
    answer = given.get(DISTRO)
    if answer is None:
        return [distributions.target()]
    return distributions.several(written(answer.value), answer.origin)


def written(value: object) -> str:
    """Return an answer, a list of names or a text, as written on a command line."""
    return ",".join(map(str, value)) if isinstance(value, list | tuple) else str(value)


def context(targets: Sequence[Distribution]) -> dict[str, Any]:
    """Return the template variable ``target``.

    Besides ``names``, ``title`` and ``python``, that is the section ``templates`` of the profiles.
    For several distributions, values work on all of them: a flag is set if it is set for each,
    a number is the lowest, a table is merged, and a text is that of the oldest.
    """
    profiles = [distribution.profile[_SECTION] for distribution in targets]
    oldest = targets[0]
    return {
        "names": [distribution.name for distribution in targets],
        "title": distributions.titles(targets),
        "python": oldest.python_version,
        **{key: _common([profile[key] for profile in profiles]) for key in profiles[0]},
    }


def _common(values: Sequence[Any]) -> Any:  # noqa: ANN401  as in the profile
    if isinstance(values[0], dict):
        return {key: value for table in values for key, value in table.items()}
    return values[0] if isinstance(values[0], str) else min(values)
