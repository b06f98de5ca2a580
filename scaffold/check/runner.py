"""Runs rules on one package; whatever happens, the other rules still run."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import islice

from scaffold.check.diagnostic import Diagnostic
from scaffold.check.internal import FileTooLarge, RuleCrashed, UnparsableFile
from scaffold.check.rule import Rule
from scaffold.errors import TooLargeError, ViewError
from scaffold.model.package import Package
from scaffold.model.source import Location
from scaffold.model.tree import MANIFEST

MOST_FINDINGS = 5000
"""Of one code in one package; a flood of them must not hold the check up."""


def check(package: Package, rules: Iterable[Rule]) -> list[Diagnostic]:
    """Return what the rules say, in reading order.

    A file that cannot be parsed gives one SC001, a rule that fails one SC002.
    """
    said: list[Diagnostic] = []
    for rule in rules:
        try:
            # One more than is shown, so that the session knows of it.
            said.extend(islice(rule.check(package), MOST_FINDINGS + 1))
        except ViewError:
            continue
        except Exception as error:  # noqa: BLE001  a defect in one rule must not hide the others
            said.append(_crash(rule, error))
    said.extend(_unparsable(package))
    return sorted(set(said), key=lambda diagnostic: diagnostic.sort_key)


def _crash(rule: Rule, error: Exception) -> Diagnostic:
    trace = error.__traceback__
    while trace is not None and trace.tb_next is not None:
        trace = trace.tb_next
    where = f" (line {trace.tb_lineno} of {trace.tb_frame.f_code.co_name})" if trace else ""
    message = f"the rule {rule.code} {rule.name} failed: {type(error).__name__}: {error}{where}"
    return RuleCrashed().report(Location.start_of(MANIFEST), message)


def _unparsable(package: Package) -> list[Diagnostic]:
    found = {
        (isinstance(error, TooLargeError), error.location, error.message)
        for error in package.parse_errors
    }
    return [
        (FileTooLarge if too_large else UnparsableFile)().report(location, message)
        for too_large, location, message in found
    ]
