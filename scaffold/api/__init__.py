"""The stable interface for rule files, with one module per topic, as in ``scaffold.model``.

docs/api.md lists all names, with examples.
"""

from __future__ import annotations

from scaffold.check.rules.file_rules import LaunchRule, MessageRule, PythonRule, RclpyRule, TestRule
from scaffold.check.rules.rule import Example, Report, Rule
from scaffold.check.rules.type_rules import TypeRule
from scaffold.closure import closure
from scaffold.diagnostic import Diagnostic, Effect, Severity
from scaffold.edits import CreateFile, Edit, Fix, MakeExecutable, Remove, Safety
from scaffold.model.facts import fact
from scaffold.model.package import Package
from scaffold.source import Location, ParseError, Source, ViewError
from scaffold.suggestions import closest_name, listed_names

__all__ = [
    "VERSION",
    "CreateFile",
    "Diagnostic",
    "Edit",
    "Effect",
    "Example",
    "Fix",
    "LaunchRule",
    "Location",
    "MakeExecutable",
    "MessageRule",
    "Package",
    "ParseError",
    "PythonRule",
    "RclpyRule",
    "Remove",
    "Report",
    "Rule",
    "Safety",
    "Severity",
    "Source",
    "TestRule",
    "TypeRule",
    "ViewError",
    "closest_name",
    "closure",
    "fact",
    "listed_names",
]

VERSION = 1
"""Grows when a name is removed or changes its meaning."""
