"""The target distributions of a package, as a template variable."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from scaffold import distributions
from scaffold.distributions import Distribution
from scaffold.generate.questions.defaults import DISTRO
from scaffold.generate.questions.questions import Given

_SECTION = "templates"
"""Of their profiles."""


def of(given: Mapping[str, Given]) -> list[Distribution]:
    """Return the distributions that a package is for, oldest first.

    Args:
        given: The user's answers; without one it is for what this process works for.

    Raises:
        InputError: there is no distribution of a name.
    """
    answer = given.get(DISTRO)
    if answer is None:
        return [distributions.target()]
    return distributions.several(written(answer.value), answer.origin)


def written(value: object) -> str:
    """Return an answer, a list of names or a text, as on a command line."""
    return ",".join(map(str, value)) if isinstance(value, list | tuple) else str(value)


def context(targets: Sequence[Distribution]) -> dict[str, Any]:
    """Return what templates know as ``target``.

    Besides ``names``, ``title`` and ``python``, that is the section ``templates`` of the profiles.
    Of several distributions a file holds what runs on all of them: a flag is set if it is in each,
    of numbers the lowest counts, of tables the entries of all, of texts that of the oldest.
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
