"""The order of the entries on a screen."""

from __future__ import annotations

from pathlib import Path

import pytest

from scaffold.check.result import Result
from scaffold.diagnostic import Diagnostic, Severity
from scaffold.model.package import Package
from scaffold.reporters.entries import by_cause, in_order
from scaffold.source import Location


def _result(directory: str, code: str, path: str, severity: Severity = Severity.ERROR) -> Result:
    diagnostic = Diagnostic(code, "some-name", severity, Location.start_of(path), code, None)
    return Result(Package.at(directory), 1, [diagnostic])


def test_what_is_set_aside_comes_after_what_is_used(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    top = tmp_path / "old"  # around the current directory: says nothing about what is below
    names = ("archive/talker", "legacy_nodes/talker", "listener", "my_old/talker", "threshold")
    for name in names:
        (top / name).mkdir(parents=True)
    monkeypatch.chdir(top)
    results = [
        *(_result(str(top / name), "ND001", "node.py") for name in names),
        _result(str(top / "listener"), "PX001", "package.xml"),
        _result(str(top / "listener"), "ND001", "junk/node.py"),
        _result(str(top / "listener"), "ND001", "old.py", Severity.WARNING),
    ]
    ordered = in_order([entry for result in results for entry in by_cause(result)])
    shown = [
        (str(Path(entry.package.directory).relative_to(top)), entry.first.location.path)
        for entry in ordered
    ]
    assert shown == [
        ("legacy_nodes/talker", "node.py"),
        ("listener", "node.py"),
        ("threshold", "node.py"),
        ("listener", "package.xml"),
        ("archive/talker", "node.py"),
        ("my_old/talker", "node.py"),
        ("listener", "junk/node.py"),
        ("listener", "old.py"),
    ]


def test_packages_of_ros1_come_after_crashes() -> None:
    results = [_result(".", "SC007", "package.xml"), _result(".", "ND001", "node.py")]
    ordered = in_order([entry for result in results for entry in by_cause(result)])
    assert [entry.first.code for entry in ordered] == ["ND001", "SC007"]
