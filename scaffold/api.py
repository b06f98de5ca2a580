"""The names that a rule file may import: a stable interface."""

from __future__ import annotations

from scaffold.check.diagnostic import (
    CreateFile,
    Diagnostic,
    Edit,
    Fix,
    MakeExecutable,
    Remove,
    Safety,
    Severity,
)
from scaffold.check.rule import Example, Report, Rule
from scaffold.errors import ViewError
from scaffold.model.package import Package
from scaffold.model.source import Location, Source

__all__ = [
    "CreateFile",
    "Diagnostic",
    "Edit",
    "Example",
    "Fix",
    "Location",
    "MakeExecutable",
    "Package",
    "Remove",
    "Report",
    "Rule",
    "Safety",
    "Severity",
    "Source",
    "ViewError",
]
