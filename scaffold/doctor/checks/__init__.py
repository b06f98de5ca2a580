"""Checks for common environment mistakes: one module each, with a function ``check``.

A module is named after its findings; nothing has to be registered.
"""

from __future__ import annotations

from collections.abc import Iterator
from importlib import import_module
from pkgutil import iter_modules

from scaffold.doctor.finding import Finding
from scaffold.doctor.machine import Machine


def run(machine: Machine) -> Iterator[tuple[str, Finding]]:
    """Yield the findings of all checks, with the names of the checks."""
    for module in sorted(iter_modules(__path__), key=lambda item: item.name):
        check = import_module(f"{__name__}.{module.name}").check
        for finding in check(machine):
            yield module.name.replace("_", "-"), finding
