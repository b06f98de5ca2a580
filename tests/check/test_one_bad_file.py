"""A file that exhausts memory, time or recursion does not hide other files and packages."""

from __future__ import annotations

import json
import os
import resource
import subprocess
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any, ClassVar

import pytest

from scaffold import time_limit
from scaffold.ament import backend
from scaffold.ament.finding import Finding
from scaffold.api import Diagnostic, Example, Package, Rule
from scaffold.check import runner
from scaffold.check.fixes import fixer
from scaffold.check.selection import Selection
from scaffold.check.session import Session
from scaffold.files.disk import Disk, LargeFileError, holds
from scaffold.source import ViewError

MANIFEST = (
    '<package format="3"><name>{name}</name><version>0.1.0</version>'
    "<description>One bad file.</description>"
    '<maintainer email="ann@ros.example.org">Ann</maintainer><license>MIT</license>'
    "<export><build_type>ament_python</build_type></export></package>\n"
)
TERMS = 1100
DEEP = {
    "a sum of attributes": "import os\nX = " + " + ".join(["os.name"] * TERMS) + "\n",
    "a sum of numbers": "X = " + "+".join(["1"] * TERMS) + "\n",
    "a chain of calls": "X = f" + "()" * TERMS + "\n",
    "a chain of branches": "X = 1\nif X:\n    pass\n" + "elif X:\n    pass\n" * TERMS,
}
SPARSE = 1 << 30
MEMORY = 600_000_000
"""Bytes of addresses for a process, which has some hundred megabytes of them from the start."""


@pytest.fixture(autouse=True)
def _no_results(own_cache: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Start each test without results of others."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(own_cache))


def _write(directory: Path, files: dict[str, str]) -> Path:
    """Write a package and return its directory."""
    for path, text in {"package.xml": MANIFEST.format(name=directory.name), **files}.items():
        (directory / path).parent.mkdir(parents=True, exist_ok=True)
        (directory / path).write_text(text)
    return directory


def _run(*arguments: str | os.PathLike[str]) -> subprocess.CompletedProcess[str]:
    def limit() -> None:
        resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))

    return subprocess.run(
        [sys.executable, "-m", "scaffold", "check", *arguments],
        env={**os.environ, "SCAFFOLD_DEBUG": "1"},
        check=False,
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        preexec_fn=limit,
    )


def _codes(*arguments: str | os.PathLike[str]) -> set[tuple[str, str]]:
    """Return file names and codes of the findings of a run."""
    done = _run("--format", "json", *arguments)
    assert done.returncode in {0, 1}, (done.stdout[-1500:], done.stderr[-1500:])
    result: list[dict[str, Any]] = json.loads(done.stdout)["diagnostics"]
    return {(entry["path"].rpartition("/")[2], entry["code"]) for entry in result}


@pytest.mark.parametrize("kind", DEEP)
def test_deep_file_does_not_hide_the_others(tmp_path: Path, kind: str) -> None:
    deep = _write(tmp_path / "deep", {"a.py": DEEP[kind], "b.py": "import os\n"})
    other = _write(tmp_path / "other", {"c.py": "import os\n"})
    result = _codes(deep, other)
    assert {("a.py", "SC001"), ("b.py", "F401"), ("c.py", "F401")} <= result
    assert "SC002" not in {code for _, code in result}


def test_deep_file_is_reported_by_style_checks(tmp_path: Path) -> None:
    files = {"a.py": DEEP["a sum of attributes"]}
    assert ("a.py", "SC001") in _codes("--select", "F811,SC", _write(tmp_path / "deep", files))


def test_crash_of_style_checks_is_reported_at_the_file(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    from scaffold.ament import verdict as rules

    check = rules.check

    def broken(name: str, *arguments: Any) -> list[Finding]:  # noqa: ANN401  handed on
        if name == "a.py":
            raise KeyError(name)
        findings: list[Finding] = check(name, *arguments)
        return findings

    monkeypatch.setattr(rules, "check", broken)
    monkeypatch.setenv("SCAFFOLD_NO_CACHE", "1")
    package = Package.of({"a.py": "import os\n", "b.py": "import os\n"})
    findings = backend.StyleCheck([package]).diagnostics(package)
    codes = {(diagnostic.location.path, diagnostic.code) for diagnostic in findings}
    assert {("a.py", "SC002"), ("b.py", "F401")} <= codes


class _Recursive(Rule):
    """Recurses once per character of a module."""

    code = "ND990"
    name = "recursive"
    examples: ClassVar[tuple[Example, ...]] = ()

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for module in package.modules():
            self._descend(module, len(module.source.text))
            yield self.report(module.source.location(0, 0), "is short")

    def _descend(self, module: object, depth: int) -> None:
        if depth:
            self._descend(module, depth - 1)


def test_file_that_exhausts_a_rule_is_skipped_by_it() -> None:
    package = Package.of({"a.py": "# " * 9000, "b.py": "# b\n", "c.py": "# c" * 6000})
    findings = runner.check(package, [_Recursive()])
    assert [(finding.location.path, finding.code) for finding in findings] == [
        ("a.py", "SC001"),
        ("b.py", "ND990"),
        ("c.py", "SC001"),
    ]


@pytest.mark.parametrize("encoding", ["idna", "punycode", "utf-7", "unicode_escape", "hz"])
def test_unencodable_style_fixes_are_skipped(tmp_path: Path, encoding: str) -> None:
    text = f"# coding: {encoding}\nimport os\nX = \"a\\n..{'b' * 80}\" + 'é..'\n"
    package = _write(tmp_path / "odd", {"a.py": text, "b.py": "import os\nX = 1\n"})
    done = _run("--fix", package)
    assert done.returncode == 1, done.stderr
    assert (package / "b.py").read_text() == "X = 1\n"
    assert (package / "a.py").read_text() == text


def test_unencodable_fix_is_not_written() -> None:
    package = Package.of({"a.py": "# coding: latin-1\nx = 1\n"})
    rule = _Euro()
    fixed = fixer.fix(package, lambda current: list(rule.check(current)))
    assert fixed.changed == {}


class _Euro(Rule):
    """Fixes with a character that is not in Latin-1."""

    code = "ND991"
    name = "euro"
    examples: ClassVar[tuple[Example, ...]] = ()

    def check(self, package: Package) -> Iterator[Diagnostic]:
        from scaffold.api import Edit, Fix

        source = package.editable("a.py")
        end = len(source.text)
        fix = Fix("add a sign", (Edit("a.py", end, end, "# \N{EURO SIGN}\n"),))
        yield self.report(source.location(0, 0), "no sign of money", fix)


# -- sizes

LARGE = {
    "config/a.yaml": set[str](),
    "launch/a.launch.xml": {"PX050", "SC004"},
    "launch/a.launch.yaml": {"SC004"},
    "launch/a.launch.py": {"SC004"},
    "a.py": {"SC004"},
    "a.cpp": {"SC004"},
    "a.xml": {"PX050"},
    "setup.py": {"SC004"},
    "setup.cfg": {"SC004"},
    "package.xml": {"SC004"},
    ".gitignore": set[str](),
    "LICENSE": set[str](),
    "msg/A.msg": set[str](),
}


@pytest.mark.parametrize("path", LARGE)
def test_size_is_checked_before_reading(tmp_path: Path, path: str) -> None:
    """A sparse file of a gigabyte; the process has memory for half of it."""
    package = _write(tmp_path / "large", {"b.py": "import os\n"})
    (package / path).parent.mkdir(parents=True, exist_ok=True)
    (package / path).touch()
    os.truncate(package / path, SPARSE)
    result = _codes(package)
    assert ("b.py", "F401") in result
    name = path.rpartition("/")[2]
    assert {(name, code) for code in LARGE[path]} <= result


def test_large_file_is_identified_by_its_time_stamp(tmp_path: Path) -> None:
    path = tmp_path / "a"
    path.touch()
    os.truncate(path, SPARSE)
    disk = Disk()
    with pytest.raises(LargeFileError):
        disk.read(str(path))
    assert holds(disk.seen)
    os.truncate(path, SPARSE + 1)
    assert not holds(disk.seen)


def test_file_that_grows_beyond_its_limit_is_noticed(tmp_path: Path) -> None:
    path = tmp_path / "a"
    path.write_bytes(b"abc")
    disk = Disk()
    assert disk.read(str(path), most=3) == b"abc"
    assert holds(disk.seen)
    os.truncate(path, SPARSE)
    assert not holds(disk.seen)
    with pytest.raises(LargeFileError):
        Disk().read(str(path), most=3)


def test_files_of_size_zero_in_proc_are_read() -> None:
    """Files in /proc have a size of 0 bytes."""
    assert Disk().read("/proc/self/status").startswith(b"Name:")
    with pytest.raises(LargeFileError):
        Disk().read("/proc/self/status", most=10)


# -- schemas

XSI = 'xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance"'
XSD = (
    '<xs:schema xmlns:xs="http://www.w3.org/2001/XMLSchema">{}<xs:element name="a"/></xs:schema>\n'
)
RNG = "http://relaxng.org/ns/structure/1.0"
MODEL = f'<?xml-model href="a.rng" schematypens="{RNG}"?>\n<a>{{}}</a>\n'


def _schema_findings(package: Package) -> Sequence[tuple[str, str]]:
    from scaffold.check.rules import registry
    from scaffold.configuration import content

    rules = registry.load(content.roots("rules", ()))
    findings = Session(rules, Selection(select=("PX051", "PX052"))).check(package)
    return [(diagnostic.code, diagnostic.message) for diagnostic in findings]


@pytest.mark.parametrize(
    ("name", "schema"),
    [
        ("a.xsd", XSD.format('<xs:include schemaLocation="pipe"/>')),
        ("a.xsd", XSD.format('<xs:import namespace="b" schemaLocation="pipe"/>')),
        ("a.xsd", XSD.format('<xs:redefine schemaLocation="pipe"/>')),
        ("a.xsd", '<!DOCTYPE a [<!ENTITY % b SYSTEM "pipe"> %b;]>\n' + XSD.format("")),
        ("a.xsd", '<!DOCTYPE a SYSTEM "pipe">\n' + XSD.format("")),
        ("a.rng", f'<grammar xmlns="{RNG}"><include href="pipe"/></grammar>\n'),
        ("a.rng", f'<externalRef xmlns="{RNG}" href="pipe"/>\n'),
    ],
)
def test_schema_cannot_open_other_files(tmp_path: Path, name: str, schema: str) -> None:
    """Opening a pipe without a writer would block forever."""
    use = (
        f'<a {XSI} xsi:noNamespaceSchemaLocation="a.xsd"/>\n'
        if name == "a.xsd"
        else MODEL.format("")
    )
    directory = _write(tmp_path / "schemas", {name: schema, "a.xml": use})
    os.mkfifo(directory / "pipe")
    findings = _schema_findings(Package.at(directory))
    message = f"names the schema '{name}', which is not checked: it includes other files"
    assert findings == [("PX052", message)]


def test_pipe_as_schema_is_not_waited_for(tmp_path: Path) -> None:
    directory = _write(tmp_path / "schemas", {"a.xml": MODEL.format("")})
    os.mkfifo(directory / "a.rng")
    message = "names the schema a.rng, but there is no file a.rng"
    assert _schema_findings(Package.at(directory)) == [("PX051", message)]


def test_endless_schema_validation_is_stopped() -> None:
    """Sixty choices, each of which doubles the number of states."""
    element = "<element name='b'><{}/></element>"
    choice = f"<choice>{element.format('empty')}{element.format('text')}</choice>"
    doubling = "".join(
        f"<define name='d{n}'><choice><group>{ref * 2}</group>{ref}</choice></define>"
        for n in range(60)
        for ref in [f"<ref name='d{n + 1}'/>"]
    )
    schema = (
        f"<grammar xmlns='{RNG}'><start><element name='a'><ref name='d0'/></element></start>"
        f"{doubling}<define name='d60'>{choice}</define></grammar>"
    )
    files = {"a.rng": schema, "a.xml": MODEL.format("<b/>" * 60), "b.xml": "<b>\n"}
    message = "names the schema 'a.rng', which is not checked: it takes too long"
    ((code, finding),) = _schema_findings(Package.of(files))
    assert code == "PX052"
    assert finding.startswith(message)


def test_each_document_has_its_own_findings() -> None:
    schema = f"<element name='a' xmlns='{RNG}'><empty/></element>"
    files = {
        "a.rng": schema,
        "a.xml": MODEL.format(""),
        "b.xml": MODEL.format("<b/>"),
        "c.rng": "<",
    }
    files["c.xml"] = MODEL.replace("a.rng", "c.rng").format("")
    findings = _schema_findings(Package.of(files))
    assert [code for code, _ in findings] == ["PX051", "PX051"]
    assert findings[0][1].startswith("does not fit a.rng: ")
    assert findings[1][1].startswith("names the schema c.rng, which cannot be used: ")


class Endless(Rule):
    """Never returns for one file."""

    code = "XX001"
    name = "endless"
    examples: ClassVar[tuple[Example, ...]] = ()

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for path in package.glob("*.py"):
            try:
                text = package.source(path).text
            except ViewError:
                continue
            while "endless" in text:
                pass
            yield self.report(package.start_of(path), "seen")


def test_file_that_takes_too_long_is_skipped(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(time_limit.limited.__wrapped__, "__defaults__", (0.05,))  # type: ignore[attr-defined]
    package = Package.of({"a.py": "a = 1\n", "b.py": "# endless\n", "c.py": "c = 1\n"})
    reported = [(d.location.path, d.code, d.message) for d in runner.check(package, [Endless()])]
    assert reported == [
        ("a.py", "XX001", "seen"),
        ("b.py", "SC001", "takes too long to check"),
        ("c.py", "XX001", "seen"),
    ]
    assert not package.is_repeatable, "another machine may be faster"


def test_style_checks_of_a_file_have_a_time_limit(monkeypatch: pytest.MonkeyPatch) -> None:
    def check(*_: object) -> list[Finding]:
        while True:
            pass

    monkeypatch.setattr(time_limit.limited.__wrapped__, "__defaults__", (0.05,))  # type: ignore[attr-defined]
    monkeypatch.setattr("scaffold.ament.verdict.check", check)
    monkeypatch.setenv("SCAFFOLD_NO_CACHE", "1")
    diagnostics = Session([], Selection()).check(Package.of({"a.py": "a = 1\n"}))
    assert [(d.location.path, d.message) for d in diagnostics if d.code.startswith("SC")] == [
        ("a.py", "takes too long to check")
    ]
