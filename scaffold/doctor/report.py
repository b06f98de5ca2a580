"""The report of ``doctor``, as text and as JSON."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from scaffold.diagnostic import Severity
from scaffold.doctor.environments import Environment
from scaffold.doctor.finding import Finding
from scaffold.printable import printable

SCHEMA_VERSION = 1

_NAMES = {"sourced": "sourced", "installed": "installation", "wheels": "Python wheels"}

Findings = Sequence[tuple[str, Finding]]


def as_data(environments: Sequence[Environment], findings: Findings) -> dict[str, Any]:
    """Return the report as JSON data."""
    return {
        "schema_version": SCHEMA_VERSION,
        "environments": [
            {
                "kind": item.kind,
                "prefix": item.prefix,
                "distribution": item.distribution,
                "usable": item.is_usable,
                "taken": item.taken,
                "reason": item.reason,
                "missing": [missing._asdict() for missing in item.missing],
            }
            for item in environments
        ],
        "findings": [
            {
                "name": name,
                "severity": finding.severity.value,
                "message": finding.message,
                "fix": finding.fix,
            }
            for name, finding in findings
        ],
        "ok": is_ok(environments, findings),
    }


def is_ok(environments: Sequence[Environment], findings: Findings) -> bool:
    """Return whether there is a usable environment, and no finding worse than info."""
    worst = {finding.severity for _, finding in findings}
    return any(item.taken for item in environments) and worst <= {Severity.INFO}


def text(environments: Sequence[Environment], findings: Findings) -> Iterator[str]:
    """Yield the lines of the report, with control characters escaped."""
    yield from map(printable, _lines(environments, findings))


def _lines(environments: Sequence[Environment], findings: Findings) -> Iterator[str]:
    yield "ROS 2 environments, in the order in which `smoke` prefers them:"
    for item in environments:
        yield from _environment(item)
    if not any(item.taken for item in environments):
        yield "error: no ROS 2 environment can build and run packages; install one of these"
    yield ""
    order = (Severity.ERROR, Severity.WARNING, Severity.INFO)
    for name, finding in sorted(findings, key=lambda item: order.index(item[1].severity)):
        yield f"{finding.severity.value}: {finding.message} [{name}]"
        yield f"    {finding.fix}"
    problems = sum(finding.severity is not Severity.INFO for _, finding in findings)
    problems += not any(item.taken for item in environments)
    if problems:
        yield f"{problems} problem{'' if problems == 1 else 's'}"
    else:
        yield "no problems"


def _environment(item: Environment) -> Iterator[str]:
    place = item.prefix or "none"
    distribution = f" ({item.distribution})" if item.distribution else ""
    mark = "  <- used by `smoke`" if item.taken else ""
    yield f"  {_NAMES[item.kind]}: {place}{distribution}: {item.reason}{mark}"
    for missing in item.missing:
        yield f"    {missing.what} is missing: {missing.command}"
