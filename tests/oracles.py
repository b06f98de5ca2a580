"""The real linters of ament, and what they report for a directory."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import NamedTuple

import pytest
from lxml import etree

from tests import PATIENCE

REQUIRE_ALL = "SCAFFOLD_REQUIRE_ALL"
"""Environment variable: with ``1`` a test whose system linter is not installed fails."""

SYSTEM_LINTERS = {
    "ament_copyright": "python3-ament-copyright",
    "ament_lint_cmake": "python3-ament-lint-cmake",
    "ament_xmllint": "python3-ament-xmllint libxml2-utils",
    "ament_cpplint": "python3-ament-cpplint",
    "ament_uncrustify": "python3-ament-uncrustify",
    "ament_lint_auto": "ament-lint",
}
"""The linters that no Python index has, and the packages of Debian and Ubuntu with them."""

_GUARD = "_ROS_WHEELS_BOOTSTRAP_COMPLETE"


class Finding(NamedTuple):
    """A finding of a linter, without its message."""

    path: str
    """Relative to the directory that was linted."""
    line: int
    """From 1; 0 when it is about the whole file."""
    code: str


def ament_flake8(directory: Path, *options: str, paths: Sequence[str] = (".",)) -> set[Finding]:
    """Return what ament_flake8 of the test environment finds, by default with Jazzy's options."""
    program = _from_environment("ament_flake8")
    return _run(program, directory, options, dict(os.environ), paths)


def ament_pep257(directory: Path, *options: str, paths: Sequence[str] = (".",)) -> set[Finding]:
    """Return what ament_pep257 of the test environment finds, by default with Jazzy's options."""
    program = _from_environment("ament_pep257")
    return _run(program, directory, options, dict(os.environ), paths)


def ament_copyright(directory: Path, *options: str) -> set[Finding]:
    """Return the files that ament_copyright of the system rejects."""
    return _run(_from_system("ament_copyright"), directory, options, system_environment())


def ament_lint_cmake(directory: Path, *options: str) -> set[Finding]:
    """Return what ament_lint_cmake of the system finds."""
    return _run(_from_system("ament_lint_cmake"), directory, options, system_environment())


def ament_xmllint(directory: Path, *options: str) -> set[Finding]:
    """Return the lines that ament_xmllint of the system rejects."""
    return _run(_from_system("ament_xmllint"), directory, options, system_environment())


def files_rejected_by_xmllint(directory: Path) -> set[str]:
    """Return the XML files that ament_xmllint of the system rejects.

    Its report is itself ill-formed when a message quotes the end of a CDATA section, so the
    names are taken from what it prints.
    """
    program = _from_system("ament_xmllint")
    done = subprocess.run(
        [program, "."],
        cwd=directory,
        env=system_environment(),
        capture_output=True,
        text=True,
        errors="replace",
        timeout=PATIENCE,
        check=False,
    )
    if "Traceback" in done.stderr:
        raise AssertionError(f"{program} failed ({done.returncode}):\n{done.stderr}")
    return set(re.findall(r"(?m)^File '(.+)' is invalid:$", done.stderr))


def needs_system_linter(name: str) -> pytest.MarkDecorator:
    """Skip a test with a reason where a linter of the system is not installed."""
    return pytest.mark.skipif(
        not is_installed(name) and os.environ.get(REQUIRE_ALL) != "1", reason=_missing(name)
    )


def is_installed(name: str) -> bool:
    """Return whether one of `SYSTEM_LINTERS` is installed."""
    if name == "ament_lint_auto":  # CMake files and no program
        prefixes = system_environment().get("AMENT_PREFIX_PATH", "").split(os.pathsep)
        return any(Path(prefix, "share", name).is_dir() for prefix in [*prefixes, "/usr"] if prefix)
    return _which(name) is not None


def system_environment(variables: Mapping[str, str] | None = None) -> dict[str, str]:
    """Return the environment for programs that are not of the test environment.

    The ROS wheels start Python again with library paths of their own; another Python that
    inherits them loads the wrong libraries. What else was there, such as a sourced ROS, stays.
    """
    kept = dict(os.environ if variables is None else variables)
    for name in (_GUARD, "VIRTUAL_ENV", "PYTHONHOME", "PYTHONSAFEPATH"):
        kept.pop(name, None)
    for name in [name for name in kept if name == "PATH" or name.endswith("PATH")]:
        entries = [entry for entry in kept[name].split(os.pathsep) if not _is_ours(entry)]
        kept[name] = os.pathsep.join(entries)
        if not kept[name]:
            del kept[name]
    return kept


def _is_ours(path: str) -> bool:
    return path == sys.prefix or path.startswith(sys.prefix + os.sep)


def _which(name: str) -> str | None:
    return shutil.which(name, path=system_environment().get("PATH", os.defpath))


def _missing(name: str) -> str:
    ros = "ros-jazzy-" + name.replace("_", "-")
    return f"{name} is not installed: apt-get install {SYSTEM_LINTERS[name]} (or {ros})"


def _from_environment(name: str) -> str:
    return os.path.join(sys.prefix, "bin", name)


def _from_system(name: str) -> str:
    program = _which(name)
    if program is None:
        pytest.fail(_missing(name))
    return program


def _run(
    program: str,
    directory: Path,
    options: tuple[str, ...],
    environment: dict[str, str],
    paths: Sequence[str] = (".",),
) -> set[Finding]:
    """Run a linter where CMake and pytest run it: in the directory."""
    with tempfile.TemporaryDirectory() as scratch:
        report = Path(scratch, "report.xml")
        command = [program, *options, "--xunit-file", str(report), *paths]
        done = subprocess.run(
            command,
            cwd=directory,
            env=environment,
            capture_output=True,
            text=True,
            errors="replace",
            timeout=PATIENCE,
            check=False,
        )
        if report.exists():
            return _parse(report.read_bytes(), os.path.basename(program).removeprefix("ament_"))
    if "No files found" in done.stderr:
        return set()
    raise AssertionError(f"{program} failed ({done.returncode}):\n{done.stdout}{done.stderr}")


def _parse(report: bytes, linter: str) -> set[Finding]:
    """Read a report; quoted source lines may make it ill-formed, hence ``recover``."""
    suite = etree.fromstring(report, etree.XMLParser(recover=True, huge_tree=True))
    result: set[Finding] = set()
    for case in suite.iter("testcase"):
        failure = case.find("failure")
        if failure is not None:
            result |= _findings(case.get("name", ""), failure.text or "", linter)
    return result


def _findings(name: str, text: str, linter: str) -> set[Finding]:
    """Read one failure, whose name is ``CODE (path:line:column)`` or only a path."""
    located = re.fullmatch(r"(\S+) \((.*?):(\d+|-)(?::\d+)?\)", name)
    if located:
        code, path, line = located.groups()
        return {Finding(_relative(path), 0 if line == "-" else int(line), code)}
    path = _relative(name)
    lines = {int(line) for line in re.findall(rf"(?m)/{re.escape(path)}:(\d+): ", text)}
    return {Finding(path, line, linter) for line in lines or {0}}


def _relative(path: str) -> str:
    return path.removeprefix("./")
