"""The choice of entries for a screen that is too small."""

from __future__ import annotations

from pathlib import Path

import pytest

from scaffold.check.result import Result
from scaffold.check.rules import registry
from scaffold.configuration import content
from scaffold.diagnostic import Diagnostic, Severity
from scaffold.model.package import Package
from scaffold.reporters import ReportOptions
from scaffold.reporters.terminal.crowded import choose
from scaffold.reporters.terminal.entries import Entry, by_cause, in_order, merged_causes
from scaffold.source import Location

WIDTH = 80


@pytest.fixture(autouse=True)
def workspace(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Load the rules, which declare the effects of findings, and enter an empty directory."""
    registry.load(content.roots("rules"))
    monkeypatch.chdir(tmp_path)


def _entries(findings: list[tuple[str, str]], package: str = ".", cause: str = "{}") -> list[Entry]:
    """Return the entries of findings, each with a code and a message."""
    diagnostics = []
    for line, (code, message) in enumerate(findings, 1):
        at = Location("node.py", line, 1, line, 6)
        name = cause.format(message)
        diagnostics.append(Diagnostic(code, "a-name", Severity.ERROR, at, message, None, name))
    return by_cause(Result(Package.at(package), 1, diagnostics))


def _shown(entries: list[Entry], room: int, width: int = WIDTH) -> tuple[list[str], int]:
    """Return the lines on the screen, and the number of hidden entries."""
    shown, hidden = choose(entries, room, width, ReportOptions())
    texts = [item.text(width, ReportOptions()).plain for item in shown]
    return "\n".join(texts).split("\n"), len(hidden)


def test_each_code_is_shown_once_before_any_is_shown_twice() -> None:
    names = [("TY003", f"name {number}") for number in range(9)]
    entries = _entries([*names, ("ND001", "some words"), ("CM014", "other words")])
    lines, hidden = _shown(in_order(entries), room=4)
    assert [line.split()[2:5] for line in lines] == [
        ["ND001", "some", "words"],
        ["CM014", "other", "words"],
        ["TY003", "name", "0"],
        ["TY003", "name", "1"],
    ]
    assert hidden == 7


def test_first_entries_have_a_source_line_if_there_is_room() -> None:
    Path("package.xml").write_text("<package><name>talker</name></package>\n")
    Path("node.py").write_text("first()\nsecond()\n")
    entries = _entries([("TY003", "one"), ("TY003", "two")])
    source = "       1 | first()"
    assert source not in _shown(entries, room=2)[0]
    lines, hidden = _shown(entries, room=4)
    assert (source in lines, "       2 | second()" in lines, hidden) == (True, False, 0)


def test_long_messages_have_two_lines_if_there_is_room() -> None:
    entries = _entries([("TY003", "word " * 40), ("ND001", "other " * 40)])
    assert [len(line) for line in _shown(entries, room=2)[0]] == [WIDTH, WIDTH]
    assert [len(line) > WIDTH for line in _shown(entries, room=3)[0]] == [True, False]


def test_message_after_a_long_path_fills_the_line_that_it_starts() -> None:
    directory = "a" * (WIDTH - 30)
    line = _shown(_entries([("TY003", "word " * 40)], directory), room=1)[0][0]
    assert len(line) == 2 * WIDTH


def test_further_places_are_counted() -> None:
    entries = _entries([("TY003", "same"), ("TY003", "same"), ("TY003", "same")])
    (line,), _ = _shown(entries, room=1)
    assert line == "node.py:1:1: error TY003 same (and 2 more places)"


def test_missing_dependencies_of_all_packages_are_one_entry_with_their_names() -> None:
    names = [("PX020", name) for name in ("rclpy", "std_msgs", "yaml")]
    talker = _entries(names, "talker", "dependency {}")
    listener = _entries([*names, ("LF005", "rviz2")], "listener", "dependency {}")
    lines, hidden = _shown(merged_causes([*talker, *listener]), room=3)
    assert hidden == 0
    assert lines == [
        "talker/node.py:1:1: error PX020 rclpy [a-name]",
        "    also std_msgs, yaml; in listener: rclpy, std_msgs, yaml, rviz2",
    ]


def test_many_missing_dependencies_are_counted_by_package() -> None:
    names = [("PX020", f"some_long_name_{number}") for number in range(20)]
    talker = _entries(names, "talker", "dependency {}")
    listener = _entries(names, "listener", "dependency {}")
    lines, _ = _shown(merged_causes([*talker, *listener]), room=3)
    assert lines[1].split("; ") == [
        "    also some_long_name_1, some_long_name_2 and 17 more",
        "in listener: some_long_name_0, some_long_name_1 and 18 more",
    ]


def test_packages_that_lack_the_same_dependencies_are_listed_together() -> None:
    packages = [
        _entries([("PX020", "rclpy")], package, "dependency {}")
        for package in ("talker", "listener", "filter")
    ]
    lines, _ = _shown(merged_causes([entry for entries in packages for entry in entries]), room=3)
    assert lines[1] == "    also in listener, filter: rclpy"


def test_dependency_that_most_packages_lack_is_first() -> None:
    talker = _entries([("PX020", "yaml"), ("PX020", "rclpy")], "talker", "dependency {}")
    listener = _entries([("PX020", "rclpy")], "listener", "dependency {}")
    (entry,) = merged_causes([*talker, *listener])
    assert [item.finding.message for item in entry.places] == ["rclpy", "rclpy", "yaml"]


def test_messages_that_differ_in_names_are_one_entry() -> None:
    message = "no plugin '{0}/Spin': it fails; write '{0}::Spin'"
    names = ("one", "two", "three")
    other = ("PF011", "no plugin 'one': the file is empty")
    entries = [*_entries([("PF011", message.format(name)) for name in names]), *_entries([other])]
    entries = merged_causes([*entries, *_entries([("TY003", "no plugin 'one'")])])
    assert [[item.finding.location.line for item in entry.places] for entry in entries] == [
        *([1, 2, 3], [1], [1])
    ]
    lines, _ = _shown(entries[:1], room=3)
    assert lines == [
        "node.py:1:1: error PF011 no plugin 'one/Spin': it fails; write 'one::Spin' [a-name]",
        "    also two/Spin in line 2, three/Spin in line 3",
    ]


def test_names_that_rosdep_rejects_are_separate_from_missing_dependencies() -> None:
    entries = _entries(
        [("PX020", "rclpy"), ("PX081", "cv2"), ("PX081", "torch")], cause="dependency {}"
    )
    ordered = in_order(merged_causes(entries))
    assert [[item.finding.message for item in entry.places] for entry in ordered] == [
        ["cv2", "torch"],
        ["rclpy"],
    ]
