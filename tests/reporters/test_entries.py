"""The order of the entries on a screen."""

from __future__ import annotations

from pathlib import Path

import pytest

from scaffold.check.result import Result
from scaffold.check.rules import registry
from scaffold.configuration import content
from scaffold.diagnostic import Diagnostic, Effect, Severity
from scaffold.model.package import Package
from scaffold.reporters.terminal.entries import by_cause, in_order, merged
from scaffold.source import Location


@pytest.fixture(autouse=True, scope="module")
def rules() -> None:
    """Load the rules, which declare the effects of findings."""
    registry.load(content.roots("rules"))


def _result(directory: str, code: str, path: str, severity: Severity = Severity.ERROR) -> Result:
    diagnostic = Diagnostic(code, "some-name", severity, Location.start_of(path), code, None)
    return Result(Package.at(directory), 1, [diagnostic])


def test_archived_packages_come_last(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
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


def test_ros1_packages_come_after_crashes() -> None:
    results = [_result(".", "SC007", "package.xml"), _result(".", "ND001", "node.py")]
    ordered = in_order([entry for result in results for entry in by_cause(result)])
    assert [entry.first.code for entry in ordered] == ["ND001", "SC007"]


def test_build_failures_come_before_crashes() -> None:
    codes = ["LY020", "PX001", "PF004", "CM014", "ND046", "LF006", "PX081", "CM011", "E999"]
    ordered = in_order([entry for code in codes for entry in by_cause(_result(".", code, "a"))])
    assert [entry.first.code for entry in ordered] == [
        *("PX081", "CM011", "LF006", "E999", "ND046", "CM014", "PF004", "PX001", "LY020")
    ]


def test_missing_packages_come_before_harmless_findings() -> None:
    results = [_result(".", code, "a") for code in ("LY020", "PX001", "CM020", "PX020", "LF005")]
    for result in results[2:]:
        (finding,) = result.diagnostics
        result.diagnostics[:] = [finding._replace(cause=f"dependency {finding.code}")]
    ordered = in_order([entry for result in results for entry in by_cause(result)])
    assert [entry.first.code for entry in ordered] == ["CM020", "PX020", "LF005", "PX001", "LY020"]


def test_builds_that_always_stop_come_before_missing_dependencies() -> None:
    results = [_result(".", code, "a") for code in ("CM020", "PX031")]
    results[0].diagnostics[0] = results[0].diagnostics[0]._replace(cause="dependency rclpy")
    ordered = in_order([entry for result in results for entry in by_cause(result)])
    assert [entry.first.code for entry in ordered] == ["PX031", "CM020"]


def test_starts_that_always_fail_come_before_missing_dependencies() -> None:
    results = [_result(".", code, code) for code in ("LF005", "PX020", "LF015")]
    for result in results[:2]:
        result.diagnostics[0] = result.diagnostics[0]._replace(cause="dependency rclpy")
    ordered = in_order([entry for result in results for entry in by_cause(result)])
    assert [entry.first.code for entry in ordered] == ["LF015", "LF005", "PX020"]


def test_style_of_cmake_files_comes_last() -> None:
    results = [_result(".", code, "a", Severity.WARNING) for code in ("CM075", "CM084", "PX020")]
    results[2].diagnostics[0] = results[2].diagnostics[0]._replace(cause="dependency rclpy")
    ordered = in_order([entry for result in results for entry in by_cause(result)])
    assert [entry.first.code for entry in ordered] == ["PX020", "CM075", "CM084"]


def test_effect_of_a_finding_comes_before_that_of_its_rule() -> None:
    results = [_result(".", code, "setup.py") for code in ("SP011", "LF006")]
    (finding,) = results[0].diagnostics
    for effect, codes in (
        (None, ["SP011", "LF006"]),
        (Effect.SPOILS_INSTALL, ["LF006", "SP011"]),
        (Effect.STOPS_ROSDEP, ["SP011", "LF006"]),
    ):
        results[0].diagnostics[:] = [finding._replace(effect=effect)]
        ordered = in_order([entry for result in results for entry in by_cause(result)])
        assert [entry.first.code for entry in ordered] == codes


def test_cause_with_more_files_comes_first() -> None:
    result = _result(".", "ND083", "a.py")
    (finding,) = result.diagnostics
    result.diagnostics[1:] = [
        finding._replace(location=Location.start_of(path), code=code, message=code)
        for path, code in (("b.py", "LF006"), ("c.py", "LF006"), ("d.py", "ND041"))
    ]
    ordered = in_order(by_cause(result))
    assert [entry.first.code for entry in ordered] == ["LF006", "ND083", "ND041"]


def test_what_stops_rosdep_or_the_build_is_never_put_last() -> None:
    results = [
        _result("archive/talker", code, "package.xml") for code in ("ND001", "CM020", "PX081")
    ]
    results.append(_result("listener", "ND001", "node.py"))
    ordered = in_order([entry for result in results for entry in by_cause(result)])
    assert [(entry.first.code, entry.package.directory) for entry in ordered] == [
        ("PX081", "archive/talker"),
        ("CM020", "archive/talker"),
        ("ND001", "listener"),
        ("ND001", "archive/talker"),
    ]


def test_errors_in_a_file_of_ros1_are_one_entry() -> None:
    result = _result("talker", "LF005", "a.launch")
    (finding,) = result.diagnostics
    leftover = finding._replace(code="LF046", message="ROS 1", cause="launch files of ROS 1")
    at = Location.start_of("b.launch")
    result.diagnostics[1:] = [
        leftover,
        finding._replace(location=at),
        leftover._replace(severity=Severity.WARNING),
    ]
    shown = [
        [(item.finding.code, item.finding.location.path) for item in entry.places]
        for entry in by_cause(result)
    ]
    assert shown == [
        [("LF005", "a.launch"), ("LF046", "a.launch"), ("LF046", "a.launch")],
        [("LF005", "b.launch")],
    ]
    assert len(by_cause(result, everything=True)) == 2


def test_findings_in_tests_come_after_those_in_programs() -> None:
    paths = ("test/test_a.py", "a/contest.py", "tests/helper.py")
    results = [_result(".", "TY003", path) for path in paths]
    ordered = in_order([entry for result in results for entry in by_cause(result)])
    assert [entry.first.location.path for entry in ordered] == [
        "a/contest.py",
        "test/test_a.py",
        "tests/helper.py",
    ]


def test_same_cause_in_several_packages_is_one_entry() -> None:
    results = [
        _result("archive/talker", "SC007", "package.xml"),
        _result("talker", "SC007", "package.xml"),
        _result("listener", "SC007", "package.xml"),
        _result("listener", "PX001", "package.xml"),
    ]
    ordered = in_order([entry for result in results for entry in by_cause(result)])
    shown = [
        [(item.package.directory, item.finding.code) for item in entry.places]
        for entry in merged(ordered)
    ]
    assert shown == [
        [("talker", "SC007"), ("listener", "SC007"), ("archive/talker", "SC007")],
        [("listener", "PX001")],
    ]


def test_different_messages_of_one_cause_are_not_merged() -> None:
    first = _result("talker", "LF005", "a.launch.py")
    second = _result("listener", "LF005", "a.launch.py")
    second.diagnostics[0] = first.diagnostics[0]._replace(message="another", cause="dependency a")
    first.diagnostics[0] = first.diagnostics[0]._replace(cause="dependency a")
    entries = [entry for result in (first, second) for entry in by_cause(result)]
    assert merged(entries) == entries


def test_missing_dependencies_and_missing_imports_are_one_entry_each() -> None:
    result = _result("talker", "PX020", "a.py")
    (finding,) = result.diagnostics
    names = ("rclpy", "std_msgs", "yaml")
    result.diagnostics[:] = [
        *(finding._replace(message=name, cause=f"dependency {name}") for name in names),
        *(finding._replace(code="F821", message=name) for name in names),
    ]
    assert [len(entry.places) for entry in by_cause(result)] == [3, 3]
    assert [len(entry.places) for entry in by_cause(result, everything=True)] == [1] * 6
