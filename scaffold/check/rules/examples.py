"""Runs the examples of rules, which are both tests and documentation."""

from __future__ import annotations

import pickle

from scaffold.check import runner
from scaffold.check.rules.rule import Example, Report, Rule
from scaffold.diagnostic import Diagnostic
from scaffold.edits import Safety
from scaffold.errors import ContentError
from scaffold.files.tree import MemoryTree
from scaffold.model.package import Package
from scaffold.model.workspace.rosdep import RosdepKeys
from scaffold.model.workspace.workspace import Workspace


def package_of(example: Example) -> Package:
    """Return the package of an example, in the workspace of its neighbors."""
    workspace = Workspace[Package]()
    # Set on the instance, so that the rosdep cache of this machine does not matter.
    data = pickle.dumps({key: {"ubuntu": [key]} for key in example.rosdep_keys or ()}, 2)
    workspace.rosdep = None if example.rosdep_keys is None else RosdepKeys([data])
    tree = MemoryTree(dict(example.files), example.executable)
    package = Package(tree, directory="", workspace=workspace)
    workspace.add(package)
    for directory, files in example.neighbors.items():
        workspace.add(Package(MemoryTree(dict(files)), directory=directory, workspace=workspace))
    return package


def reports(rule: type[Rule], example: Example) -> list[Report]:
    """Return the reports of a rule about an example, in reading order.

    Raises:
        ContentError: the rule crashes on the example, or cannot read a file of it.
    """
    with example.targeting():
        diagnostics = runner.check(package_of(example), [rule()])
    for diagnostic in diagnostics:
        if diagnostic.code != rule.code:
            where = f"{rule.code}, example {example.title!r}"
            raise ContentError(f"{where}: {diagnostic.code} {diagnostic.message}")
    return [_report(rule, diagnostic) for diagnostic in diagnostics]


def _report(rule: type[Rule], diagnostic: Diagnostic) -> Report:
    at, fix = diagnostic.location, diagnostic.fix
    severity = None if diagnostic.severity is rule.severity else diagnostic.severity
    return Report(
        f"{at.path}:{at.line}:{at.column}",
        diagnostic.message,
        fix=fix.title if fix and fix.safety is Safety.SAFE else None,
        unsafe_fix=fix.title if fix and fix.safety is Safety.UNSAFE else None,
        severity=severity,
    )
