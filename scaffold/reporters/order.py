"""The order of findings: what stops most comes first."""

from __future__ import annotations

import os
import re
from collections.abc import Mapping

from scaffold import lazy_re
from scaffold.ament.codes import STYLE
from scaffold.check.rules.rule import Rule
from scaffold.diagnostic import Diagnostic, Effect, Severity
from scaffold.model.package import Package
from scaffold.reporters.paths import shown

SEVERITIES = (Severity.ERROR, Severity.WARNING, Severity.INFO)
"""Worst first."""

_SET_ASIDE = lazy_re.compile(
    r"(?:.*[_ .-])?(?:archived?|archives|attic|backups?|bak|deprecated|junk|legacy|obsolete|old"
    r"|trash|unused)|[(\[](?:old|unused|deprecated)[)\]].*",
    re.IGNORECASE,
)
"""Matches the name of a directory with abandoned code."""
_TESTS = lazy_re.compile(r"(?:^|/)(?:tests?/|test_[^/]*$|[^/]*_test\.py$)")
"""Matches the paths of tests, which no robot runs."""
DEPENDENCY = "dependency "
"""The prefix of causes that only matter on machines without a package."""
_BEFORE_START = frozenset({Effect.STOPS_ROSDEP, Effect.STOPS_BUILD})
"""The effects of files that nobody has to use: rosdep and colcon read those of all packages."""


def is_dependency(diagnostic: Diagnostic) -> bool:
    """Return whether a finding is about the dependency on another package."""
    return diagnostic.cause.startswith(DEPENDENCY)


def is_style(diagnostic: Diagnostic) -> bool:
    """Return whether a finding is a harmless one of ament_flake8 or ament_pep257."""
    return diagnostic.code in STYLE and diagnostic.severity is not Severity.ERROR


def rank(
    package: Package, diagnostic: Diagnostic, rules: Mapping[str, type[Rule]]
) -> tuple[int, bool, bool, Effect]:
    """Return the key to sort findings by; the worst has the lowest.

    Directories such as ``archive`` or ``old`` come last, unless rosdep or the build stops there.
    """
    effect = effect_of(diagnostic, rules)
    is_aside = effect not in _BEFORE_START and is_set_aside(package, diagnostic)
    return SEVERITIES.index(diagnostic.severity), is_style(diagnostic), is_aside, effect


def is_set_aside(package: Package, diagnostic: Diagnostic) -> bool:
    """Return whether a finding is in a directory with code that is kept, not used."""
    directories = shown(package, diagnostic.location.path).split(os.sep)[:-1]
    return any(_SET_ASIDE.fullmatch(name) for name in directories)


def effect_of(diagnostic: Diagnostic, rules: Mapping[str, type[Rule]]) -> Effect:
    """Return the effect of a finding, as declared by its rule; in a test, only the test fails."""
    effect = diagnostic.effect
    if effect is None:
        effect = _usual_effect(diagnostic.code, rules)
    is_all_stopped = effect <= Effect.STOPS_PACKAGE or is_dependency(diagnostic)
    if is_all_stopped and diagnostic.severity is not Severity.ERROR:
        return Effect.DECLARED_WRONG  # else it would be an error
    if effect in _BEFORE_START or effect > Effect.DECLARED_WRONG:
        return effect
    return Effect.DECLARED_WRONG if _TESTS.search(diagnostic.location.path) else effect


def _usual_effect(code: str, rules: Mapping[str, type[Rule]]) -> Effect:
    if code in STYLE:  # errors among them: E9 of pycodestyle is for unparsable files
        return Effect.STOPS_START if code.startswith("E9") else Effect.STOPS_PROGRAM
    return rules[code].usual_effect() if code in rules else Effect.STOPS_PROGRAM
