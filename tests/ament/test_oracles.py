"""The linters used as oracles by other tests report what they should."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from tests import oracles
from tests.oracles import Finding, needs_system_linter

BAD_PYTHON = """\
import sys
import os


def work(x):
    '''does it'''
    return os.path.join(x, "a")
"""


def test_flake8_reports_locations_and_codes(tmp_path: Path) -> None:
    write(tmp_path, "pkg/bad.py", BAD_PYTHON)
    assert oracles.ament_flake8(tmp_path) == {
        Finding("pkg/bad.py", 1, "F401"),
        Finding("pkg/bad.py", 2, "I100"),
        Finding("pkg/bad.py", 6, "D300"),
        Finding("pkg/bad.py", 6, "D400"),
        Finding("pkg/bad.py", 6, "D401"),
        Finding("pkg/bad.py", 6, "D403"),
        Finding("pkg/bad.py", 6, "Q002"),
        Finding("pkg/bad.py", 7, "Q000"),
    }


def test_flake8_accepts_options(tmp_path: Path) -> None:
    write(tmp_path, "long.py", f"x = '{'a' * 100}'\n")
    assert oracles.ament_flake8(tmp_path) == {Finding("long.py", 1, "E501")}
    assert oracles.ament_flake8(tmp_path, "--linelength", "120") == set()


def test_pep257_reports_locations_and_codes(tmp_path: Path) -> None:
    write(tmp_path, "bad.py", BAD_PYTHON)
    assert oracles.ament_pep257(tmp_path) == {
        Finding("bad.py", 6, "D300"),
        Finding("bad.py", 6, "D400"),
        Finding("bad.py", 6, "D401"),
        Finding("bad.py", 6, "D403"),
        Finding("bad.py", 6, "D415"),
    }


@pytest.mark.parametrize("linter", [oracles.ament_flake8, oracles.ament_pep257])
def test_empty_directory_has_no_findings(
    linter: Callable[..., set[Finding]], tmp_path: Path
) -> None:
    assert linter(tmp_path) == set()


@needs_system_linter("ament_copyright")
def test_copyright_reports_files(tmp_path: Path) -> None:
    write(tmp_path, "bad.py", BAD_PYTHON)
    write(tmp_path, "good.py", "# SPDX-License-Identifier: Apache-2.0\n# Copyright 2026 Me\n")
    assert Finding("bad.py", 0, "copyright") in oracles.ament_copyright(tmp_path)


@needs_system_linter("ament_lint_cmake")
def test_lint_cmake_reports_locations(tmp_path: Path) -> None:
    write(tmp_path, "CMakeLists.txt", "cmake_minimum_required(VERSION 3.8)\nproject (talker)\n")
    findings = oracles.ament_lint_cmake(tmp_path)
    assert findings == {Finding("CMakeLists.txt", 2, "whitespace/extra")}


@needs_system_linter("ament_xmllint")
def test_xmllint_reports_lines(tmp_path: Path) -> None:
    write(tmp_path, "package.xml", "<package>\n  <name>\n</package>\n")
    findings = oracles.ament_xmllint(tmp_path)
    assert Finding("package.xml", 3, "xmllint") in findings


@needs_system_linter("ament_lint_auto")
def test_lint_auto_is_recognized() -> None:
    assert oracles.is_installed("ament_lint_auto")


def test_system_programs_do_not_inherit_this_environment() -> None:
    inside, outside = os.path.join(sys.prefix, "lib"), "/opt/vendor/lib"
    given = {
        "_ROS_WHEELS_BOOTSTRAP_COMPLETE": "1",
        "VIRTUAL_ENV": sys.prefix,
        "LD_LIBRARY_PATH": os.pathsep.join([inside, outside]),
        "PYTHONPATH": inside,
        "HOME": sys.prefix,
    }
    kept = {"LD_LIBRARY_PATH": outside, "HOME": sys.prefix}
    assert oracles.system_environment(given) == kept


def write(directory: Path, path: str, text: str) -> None:
    target = directory / path
    target.parent.mkdir(parents=True, exist_ok=True)
    target.write_text(text)
