"""The same package in two places that are sourced: the first hides the others."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.diagnostic import Severity
from scaffold.doctor.finding import Finding
from scaffold.doctor.machine import Machine, packages_in


def check(machine: Machine) -> Iterator[Finding]:
    """Yield a finding for each package that hides another."""
    places: dict[str, list[str]] = {}
    for prefix in dict.fromkeys(machine.prefixes):
        for name in packages_in(prefix):
            places.setdefault(name, []).append(prefix)
    for name, prefixes in sorted(places.items()):
        if len(prefixes) > 1:
            hidden = ", ".join(prefixes[1:])
            yield Finding(
                Severity.INFO,
                f"{name!r} of {prefixes[0]} hides that of {hidden}",
                "remove it from the first if that is not intended",
            )
