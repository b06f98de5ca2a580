"""``check --add-noqa`` suppresses each finding with a comment, where possible."""

from __future__ import annotations

import ast
import re
from pathlib import Path

import pytest

from scaffold.cli.main import main

CODE = '''# Copyright 2025 Ada
"""Summary without a full stop"""
import os


def talk(a, b):
    """Talks

    And more.
    """
    text = """
    trailing \\
    {long}
    """
    x = \\
        1;
    return text  # why not


def other(
    a,
):
    pass
'''.format(long="x" * 120)


@pytest.fixture
def talker(
    own_cache: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> Path:
    """Return a package with findings in files of all kinds, in the current directory."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(own_cache))
    monkeypatch.chdir(tmp_path)
    assert main(["new", "talker"]) == 0
    root = tmp_path / "talker"
    (root / "talker" / "extra.py").write_text(CODE)
    (root / "talker" / "other.py").write_text("import os  # noqa: F401\nimport scipy\nscipy.pi\n")
    manifest = root / "package.xml"
    manifest.write_text(
        manifest.read_text().replace("<test_depend>", "<depend>rclpy</depend>\n  <test_depend>", 1)
    )
    cmake = root / "CMakeLists.txt"
    cmake.write_text(re.sub(r"project\(talker.*", "project (listener)", cmake.read_text()))
    capsys.readouterr()
    return root


def test_check_is_clean_afterwards_and_second_run_changes_nothing(
    talker: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    before = {path: path.read_text() for path in talker.rglob("*") if path.is_file()}
    assert main(["check"]) == 1
    result = capsys.readouterr().out
    for name in ("extra.py", "other.py", "package.xml", "CMakeLists.txt"):
        assert name in result
    assert main(["check", "--add-noqa"]) == 0
    captured = capsys.readouterr()
    assert captured.err.startswith("noqa added to ")
    assert captured.out == "1 package, 14 files for Jazzy: no findings\n"
    after = {path: path.read_text() for path in before}
    changed = sorted(path.name for path in before if before[path] != after[path])
    assert changed == ["CMakeLists.txt", "extra.py", "other.py", "package.xml"]
    for path in (talker / "talker" / "extra.py", talker / "talker" / "other.py"):
        assert ast.dump(ast.parse(after[path])) == ast.dump(ast.parse(before[path]))
        assert len(after[path].splitlines()) == len(before[path].splitlines())
    assert "# noqa: F401, " in after[talker / "talker" / "other.py"], "merged"
    assert main(["check"]) == 0
    assert main(["check", "--add-noqa"]) == 0
    assert capsys.readouterr().err.endswith("noqa added to 0 lines\n")
    assert {path: path.read_text() for path in before} == after


def test_only_selected_codes_are_suppressed(
    talker: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["check", "--add-noqa", "--select", "PX020"]) == 0
    capsys.readouterr()
    assert main(["check", "--add-noqa", "--diff", "--select", "CM001"]) == 1
    patch = capsys.readouterr().out
    assert "\n+project (listener)  # noqa: CM001\n" in patch
    assert "import scipy  # noqa: PX020\n" in (talker / "talker" / "other.py").read_text()
    assert "noqa" not in (talker / "CMakeLists.txt").read_text(), "a patch writes nothing"


def test_findings_without_room_for_a_comment_are_still_reported(
    talker: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    node = talker / "talker" / "other.py"
    node.write_text("#!/usr/bin/env python3\nimport os  # noqa: F401\n")
    main(["check", "--add-noqa", "--select", "LY020"])
    captured = capsys.readouterr()
    assert "talker/talker/other.py:1:1: error LY020 " in captured.out
    assert node.read_text().startswith("#!/usr/bin/env python3\nimport")


def test_no_useless_comment_is_added(talker: Path, capsys: pytest.CaptureFixture[str]) -> None:
    cmake = talker / "CMakeLists.txt"
    cmake.write_text(f"{cmake.read_text()}# the end \n")
    assert main(["check", "--add-noqa", "talker/CMakeLists.txt"]) == 1
    reported = capsys.readouterr().out
    assert " CM074 " in reported
    assert "SC003" not in reported


@pytest.mark.usefixtures("talker")
@pytest.mark.parametrize("flag", [["--fix"], ["--since", "HEAD"], ["--write-baseline", "a"]])
def test_add_noqa_excludes_other_flags(capsys: pytest.CaptureFixture[str], flag: list[str]) -> None:
    assert main(["check", "--add-noqa", *flag]) == 2
    assert f"omit {flag[0]}\n" in capsys.readouterr().err
