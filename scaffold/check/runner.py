"""Runs rules on one package; whatever happens, the other rules still run."""

from __future__ import annotations

from collections.abc import Iterable
from itertools import islice

from scaffold import time_limit
from scaffold.check.engine_rules import FileTooLarge, RuleCrashed, UnparsableFile
from scaffold.check.rule import Rule
from scaffold.diagnostic import MOST_FINDINGS, Diagnostic, crash_message
from scaffold.errors import EXHAUSTED, OutOfTimeError, exhausted
from scaffold.files.tree import MANIFEST
from scaffold.model.package import Package
from scaffold.source import Location, TooLargeError, ViewError

MOST_REFUSED = 100
"""Files of one package that exhaust a rule one after the other."""


def check(package: Package, rules: Iterable[Rule]) -> list[Diagnostic]:
    """Return what the rules say, in reading order.

    A file that cannot be parsed gives one SC001, a rule that fails one SC002.
    """
    said: list[Diagnostic] = []
    for rule in rules:
        said += _run(rule, package)
    said.extend(_unparsable(package))
    return sorted(set(said), key=lambda diagnostic: diagnostic.sort_key)


def _run(rule: Rule, package: Package) -> list[Diagnostic]:
    """Return what a rule says; a file that exhausts it counts as unparsable from then on."""
    said: list[Diagnostic] = []
    for _ in range(MOST_REFUSED):
        said.clear()
        try:
            with time_limit.limited():
                # One more than is shown, so that the session knows of it.
                said.extend(islice(rule.check(package), MOST_FINDINGS + 1))
        except ViewError:
            pass
        except EXHAUSTED as error:
            package.is_repeatable &= not isinstance(error, OutOfTimeError)
            path = _file_at_fault(package, error)
            if path is not None and package.refuse(path, exhausted(error)):
                continue
            said.append(_crash(rule, package, error))
        except Exception as error:  # noqa: BLE001  a defect in one rule must not hide the others
            said.append(_crash(rule, package, error))
        break
    return said


def _crash(rule: Rule, package: Package, error: Exception) -> Diagnostic:
    path = _file_at_fault(package, error) or MANIFEST
    message = crash_message(f"the rule {rule.code} {rule.name}", error)
    return RuleCrashed().report(Location.start_of(path), message)


def _file_at_fault(package: Package, error: Exception) -> str | None:
    """Return the file that the failing code was looking at, if its variables tell."""
    path: str | None = None
    trace = error.__traceback__
    while trace is not None:
        for value in trace.tb_frame.f_locals.values():
            held = value if isinstance(value, str) else getattr(value, "path", None)
            if isinstance(held, str) and package.has(held):
                path = held
        trace = trace.tb_next
    return path


def _unparsable(package: Package) -> list[Diagnostic]:
    found = {
        (isinstance(error, TooLargeError), error.location, error.message)
        for error in package.parse_errors
    }
    return [
        (FileTooLarge if too_large else UnparsableFile)().report(location, message)
        for too_large, location, message in found
    ]
