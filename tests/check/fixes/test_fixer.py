"""Fixing: converges in one run, for all packages at once, and never breaks a file."""

from __future__ import annotations

import fcntl
import os
import pty
import struct
import subprocess
import sys
import termios
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

import pytest

from scaffold.check.fixes import fixer
from scaffold.cli.main import main
from scaffold.diagnostic import Diagnostic, Severity
from scaffold.edits import Edit, Fix, Safety
from scaffold.model.package import Package
from scaffold.source import Location
from tests.writing.test_patch import fill, git, tree

MANIFEST = (
    '<?xml version="1.0"?>\n<package format="3">\n  <name>{name}</name>\n'
    "  <version>0.1.0</version>\n  <description>Talks.</description>\n"
    '  <maintainer email="a@example.org">A</maintainer>\n  <license>Apache-2.0</license>\n'
    "  <buildtool_depend>ament_cmake</buildtool_depend>\n"
    "{depends}"
    "  <export>\n    <build_type>ament_cmake</build_type>\n  </export>\n</package>\n"
)
CMAKE_LISTS = (
    "cmake_minimum_required(VERSION 3.8)\nproject({name})\n"
    "find_package(ament_cmake REQUIRED)\n"
    "install(PROGRAMS node.py DESTINATION lib/${{PROJECT_NAME}})\nament_package()\n"
)
IMPORTS = "#!/usr/bin/env python3\nimport geometry_msgs.msg\nimport nav_msgs.msg\nimport rclpy\n"


def package(name: str, node: str, depends: str = "") -> dict[str, bytes]:
    """Return the files of a package by path."""
    return {
        f"{name}/package.xml": MANIFEST.format(name=name, depends=depends).encode(),
        f"{name}/CMakeLists.txt": CMAKE_LISTS.format(name=name).encode(),
        f"{name}/node.py": node.encode(),
    }


def replace(old: str, new: str, path: str = "a.py", safety: Safety = Safety.SAFE) -> Check:
    """Return a check with a fix that replaces each occurrence of a text."""

    def check(package: Package) -> list[Diagnostic]:
        text = package.editable(path).text
        starts = [at for at in range(len(text)) if text.startswith(old, at)]
        return [
            Diagnostic(
                "XX001",
                "replace",
                Severity.WARNING,
                Location.start_of(path, number),
                f"{old!r}",
                Fix(f"replace {number}", (Edit(path, at, at + len(old), new),), safety),
            )
            for number, at in enumerate(starts, 1)
        ]

    return check


Check = Callable[[Package], list[Diagnostic]]


def test_all_dependencies_are_inserted_in_one_round_in_order() -> None:
    from scaffold.check import runner
    from scaffold.check.rules import registry
    from scaffold.configuration import content

    rules = [rule() for rule in registry.load(content.roots("rules")) if rule.code == "PX020"]
    rounds: list[int] = []

    def check(package: Package) -> list[Diagnostic]:
        rounds.append(1)
        return runner.check(package, rules)

    modules = ["zmq", "nav_msgs", "rclpy", "geometry_msgs", "scipy", "std_msgs", "requests"]
    node = "".join(f"import {module}\n" for module in modules)
    files = {path.removeprefix("talker/"): data for path, data in package("talker", node).items()}
    fixed = fixer.fix(Package.of({**files, "test/test_a.py": b"import numpy\n"}), check)
    assert len(rounds) == 2
    assert not fixed.diagnostics
    lines = fixed.changed["package.xml"].decode().splitlines()
    added = [line.strip() for line in lines if "exec_depend" in line or "test_depend" in line]
    names = ["geometry_msgs", "nav_msgs", "python3-requests", "python3-scipy", "python3-zmq"]
    expected = [f"<exec_depend>{name}</exec_depend>" for name in [*names, "rclpy", "std_msgs"]]
    assert added == [*expected, "<test_depend>python3-numpy</test_depend>"]


def test_fix_that_breaks_a_file_is_skipped() -> None:
    before = "a = 1\nb = 1\nc = 1\n"

    def check(package: Package) -> list[Diagnostic]:
        return [
            *replace("b", "(")(package),
            *replace("a", "x")(package),
            *replace("c", "y")(package),
        ]

    fixed = fixer.fix(Package.of({"a.py": before}), check)
    assert fixed.changed == {"a.py": b"x = 1\nb = 1\ny = 1\n"}
    assert fixed.applied == 2
    assert [(finding.message, finding.fix) for finding in fixed.diagnostics] == [("'b'", None)]
    assert not fixed.unsettled


@pytest.mark.parametrize(
    ("path", "text", "old"),
    [
        ("package.xml", "<package><name>a</name></package>\n", "</name>"),
        ("CMakeLists.txt", "project(a)\n", ")"),
        ("config/a.yaml", "a: [b]\n", "]"),
        ("a.py", "x = (1)\n", ")"),
        ("launch/a.xml", "<launch></launch>\n", "</launch>"),
    ],
)
def test_fixed_files_of_all_kinds_still_parse(path: str, text: str, old: str) -> None:
    fixed = fixer.fix(
        Package.of({"package.xml": "<package/>\n", path: text}), replace(old, "", path)
    )
    assert (fixed.changed, fixed.applied) == ({}, 0)


def test_unencodable_fix_is_skipped() -> None:
    before = "# -*- coding: latin-1 -*-\na = '\xe9'\n".encode("latin-1")
    fixed = fixer.fix(Package.of({"a.py": before}), replace("a =", "\u20ac ="))
    assert (fixed.changed, fixed.applied) == ({}, 0)


def test_conflicting_fixes_end_and_are_reported() -> None:
    def check(package: Package) -> list[Diagnostic]:
        return replace("1", "2")(package) or replace("2", "1")(package)

    fixed = fixer.fix(Package.of({"a.py": "a = 1\n"}), check)
    assert fixed.applied == fixer.MAX_ROUNDS_OF_FILE
    assert fixed.unsettled == {"XX001"}
    assert fixed.diagnostics[0].fix


@pytest.mark.parametrize(
    ("before", "old", "rounds"), [("a\n" + "b\n" * 2000, "b\n", 1), ("x = 'bb'\n", "b", 2)]
)
def test_lines_are_removed_at_once_but_not_adjacent_text(
    before: str, old: str, rounds: int
) -> None:
    checks: list[int] = []

    def check(package: Package) -> list[Diagnostic]:
        checks.append(1)
        return replace(old, "")(package)

    fixed = fixer.fix(Package.of({"a.py": before}), check)
    assert fixed.changed == {"a.py": before.replace(old, "").encode()}
    assert len(checks) == rounds + 1


def test_cascading_fixes_end_in_a_few_rounds(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Each variable is only used by the next one, and the last one is unused."""
    monkeypatch.chdir(tmp_path)
    chain = "".join(f"    x{at} = x{at - 1}\n" for at in range(1, 200))
    fill(tmp_path, {"a.py": f"def f():\n    x0 = 1\n{chain}".encode()})
    main(["check", "--fix", "--unsafe-fixes", "--select", "F841", "a.py"])
    error = capsys.readouterr().err
    assert error.startswith(f"{fixer.MAX_ROUNDS_OF_FILE} fixes applied\n")
    assert "the fixes of F841 do not converge" in error


def test_second_run_changes_nothing(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """The dependencies of a package, fixed in the first round, affect its dependents."""
    monkeypatch.chdir(tmp_path)
    fill(tmp_path, {**package("a", IMPORTS), **package("b", IMPORTS + 'x = "1" \n')})
    main(["check", "--fix"])
    assert "0 fixes applied" not in capsys.readouterr().err
    after = tree(tmp_path)
    main(["check", "--fix"])
    assert capsys.readouterr().err == "0 fixes applied\n"
    assert tree(tmp_path) == after


def test_patch_of_a_workspace_equals_fix(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capfdbinary: pytest.CaptureFixture[bytes]
) -> None:
    files = {
        **package("a", IMPORTS),
        **package("b dir", IMPORTS.replace("\n", "\r\n")),
        "a/caf\xe9 1.py": '# -*- coding: latin-1 -*-\nx = "\xe9" \n'.encode("latin-1"),
    }
    for side in ("patched", "fixed"):
        fill(tmp_path / side / "src", files)
    monkeypatch.chdir(tmp_path / "fixed" / "src")
    main(["check", "--fix", "."])
    git(tmp_path / "patched", "init", "-q")
    for below in ("", "src", "src/a"):
        monkeypatch.chdir(tmp_path / "patched" / below)
        capfdbinary.readouterr()
        assert main(["check", "--diff", "."]) in {0, 1}
        text = capfdbinary.readouterr().out
        (tmp_path / "saved").write_bytes(text)
        if below != "src/a":
            git(tmp_path / "patched" / below, "apply", "--check", str(tmp_path / "saved"))
    git(tmp_path / "patched" / "src" / "a", "apply", str(tmp_path / "saved"))
    monkeypatch.chdir(tmp_path / "patched")
    capfdbinary.readouterr()
    main(["check", "--diff", "src/b dir"])
    (tmp_path / "saved").write_bytes(capfdbinary.readouterr().out)
    git(tmp_path / "patched", "apply", str(tmp_path / "saved"))
    assert tree(tmp_path / "patched") == tree(tmp_path / "fixed")
    assert tree(tmp_path / "fixed" / "src") != {name: (data, False) for name, data in files.items()}


def test_symlink_out_of_the_package_does_not_block_other_fixes(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    fill(tmp_path, {**package("a", "import os \n"), "outside.py": b"import os \n"})
    (tmp_path / "a" / "linked.py").symlink_to("../outside.py")
    (tmp_path / "a" / "twin.py").symlink_to("node.py")
    main(["check", "--fix", "a"])
    assert (tmp_path / "outside.py").read_bytes() == b"import os \n"
    assert (tmp_path / "a" / "twin.py").is_symlink()
    assert b"import" not in (tmp_path / "a" / "node.py").read_bytes()


def test_summary_counts_safe_and_unsafe_fixes(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    fill(tmp_path, {"a.py": b"x = None\ny = x == None\nz = x == None \n"})
    main(["check", "a.py"])
    assert capsys.readouterr().out.endswith(
        "; 1 fixable with --fix, 2 more with --fix --unsafe-fixes\n"
    )
    main(["check", "a.py", "--unsafe-fixes"])
    assert capsys.readouterr().out.endswith("; 3 fixable with --fix --unsafe-fixes\n")
    main(["check", "a.py", "--select", "E711"])
    assert capsys.readouterr().out.endswith("; 2 fixable with --fix --unsafe-fixes\n")


def test_no_dependency_is_added_for_a_removed_import(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    fill(tmp_path, package("talker", "#!/usr/bin/env python3\nimport nav_msgs.msg\nimport os\n"))
    main(["check", "--fix", "--select", "F401,PX020", "talker"])
    assert (tmp_path / "talker" / "node.py").read_text() == "#!/usr/bin/env python3\n"
    assert "nav_msgs" not in (tmp_path / "talker" / "package.xml").read_text()


def test_single_file_is_fixed_alone(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    fill(tmp_path, {**package("a", "import os\nX = 1\n"), "a/other.py": b"import os\n"})
    main(["check", "--fix", "--select", "F401", "a/node.py"])
    assert (tmp_path / "a" / "node.py").read_bytes() == b"X = 1\n"
    assert (tmp_path / "a" / "other.py").read_bytes() == b"import os\n"


def test_file_without_a_package_is_fixed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    fill(tmp_path, {"a.py": b"x = 1 \n", "b.py": b"x = 1 \n"})
    main(["check", "--fix", "a.py"])
    assert (tmp_path / "a.py").read_bytes() == b"x = 1\n"
    assert (tmp_path / "b.py").read_bytes() == b"x = 1 \n"


def test_whole_packages_of_given_files_are_fixed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    fill(tmp_path, {**package("a", f"{IMPORTS}\n"), **package("b", f"{IMPORTS}\n")})
    fill(tmp_path, {"a/other.py": b"x = 1 \n", "loose.py": b"x = 1 \n"})
    before = tree(tmp_path)
    words = ["--select", "PX020,W291", "--whole-packages", "a/CMakeLists.txt", "loose.py"]
    assert main(["check", "--fix", *words]) == 0
    after = tree(tmp_path)
    assert {path for path in after if after[path] != before[path]} == {
        "a/package.xml",
        "a/other.py",
    }


@pytest.mark.parametrize("is_terminal", [True, False])
def test_progress_bar_is_only_shown_on_a_terminal(tmp_path: Path, *, is_terminal: bool) -> None:
    fill(tmp_path, package("a", "import os\n"))
    leader, follower = pty.openpty()
    fcntl.ioctl(follower, termios.TIOCSWINSZ, struct.pack("HHHH", 24, 80, 0, 0))
    with subprocess.Popen(
        [sys.executable, "-m", "scaffold", "check", "--fix", tmp_path],
        stdin=subprocess.DEVNULL,
        stdout=subprocess.DEVNULL,
        stderr=follower if is_terminal else subprocess.PIPE,
    ) as process:
        os.close(follower)
        shown = process.stderr.read() if process.stderr else b""
        with suppress(OSError):  # the end of a terminal is an error
            while is_terminal and (part := os.read(leader, 1 << 16)):
                shown += part
    os.close(leader)
    assert (b"round 1:" in shown) == is_terminal
    assert b"\r: " not in shown, "a bar without a label"
    assert shown.rstrip().endswith(b"fixes applied")
