"""A package is sourced from two places: the first one shadows the other."""

from __future__ import annotations

import os
from collections.abc import Iterator
from shlex import quote

from scaffold.diagnostic import Severity
from scaffold.doctor.finding import Finding
from scaffold.doctor.machine import Machine, packages_in


def check(machine: Machine) -> Iterator[Finding]:
    """Yield a finding for each package that shadows another."""
    places: dict[str, list[str]] = {}
    for prefix in dict.fromkeys(machine.prefixes):
        for name in packages_in(prefix):
            places.setdefault(name, []).append(prefix)
    for name, prefixes in sorted(places.items()):
        if len(prefixes) > 1:
            hidden = ", ".join(prefixes[1:])
            yield Finding(
                Severity.INFO,
                f"{name!r} in {prefixes[0]} shadows the one in {hidden}",
                _removal(name, prefixes[0]),
            )


def _removal(name: str, prefix: str) -> str:
    top = os.path.dirname(os.path.dirname(prefix))
    build = os.path.join(top, "build", name)
    if os.path.basename(prefix) == name and os.path.isdir(build):
        return f"rm -r {quote(prefix)} {quote(build)}  # unless intended"
    return f"ros2 pkg prefix {name}  # shows which one is used"
