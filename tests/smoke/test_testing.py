"""``smoke --test``: the results of ``colcon test`` are part of the report."""

from __future__ import annotations

import json
import subprocess
from io import StringIO
from pathlib import Path

import pytest

from scaffold.smoke.building.testing import read
from scaffold.smoke.reports import report
from scaffold.smoke.result import Build, PackageResult, Smoke, TestCase, Tests
from tests.reporters.test_junit import test_result
from tests.smoke.smoke_packages import ONCE, python_package, write
from tests.smoke.smoke_runs import NEEDS_ROS, command_line, variables

XML = b"""\
<testsuites><testsuite>
<testcase classname="demo.flake8" name="D100"><failure message="D100 missing">line 1

line 2</failure></testcase>
<testcase classname="demo" name="good"/>
<testcase name="left"><skipped/></testcase>
<testcase classname="demo" name="bad"><error>boom</error></testcase>
</testsuite></testsuites>
"""


def test_cases_are_read_from_junit() -> None:
    assert list(read(XML)) == [
        TestCase("demo.flake8.D100", "failed", ("D100 missing", "line 1", "line 2")),
        TestCase("demo.good", "passed"),
        TestCase("left", "skipped"),
        TestCase("demo.bad", "failed", ("boom",)),
    ]


@pytest.mark.parametrize(
    "data",
    [
        b"",
        b"no XML",
        b"<Site><Testing/></Site>",
        b'<!DOCTYPE a [<!ENTITY b SYSTEM "file:///etc/passwd">]><testsuite>&b;</testsuite>',
    ],
)
def test_file_without_cases(data: bytes) -> None:
    assert list(read(data)) == []


def smoke_of(tests: Tests) -> Smoke:
    package = PackageResult("demo", Build(ok=True), tests=tests)
    return Smoke({"kind": "wheels", "prefix": "/opt", "rmw": "rmw"}, (package,))


def written(tests: Tests, form: str) -> str:
    out = StringIO()
    report(smoke_of(tests), form, out)
    return out.getvalue()


def test_failed_test_fails_the_package() -> None:
    tests = Tests(tuple(read(XML)))
    assert not smoke_of(tests).ok
    lines = written(tests, "text").splitlines()
    assert "  4 tests: 2 failed" in lines
    assert "    failed: demo.bad" in lines
    assert lines[-1].startswith("1 package, 0 executables: tests of demo failed in ")
    assert "title=demo: demo.bad failed::boom" in written(tests, "github").replace("%3A", ":")


def test_passed_tests_are_counted() -> None:
    tests = Tests((TestCase("a", "passed"),))
    assert smoke_of(tests).ok
    assert "  1 test: ok" in written(tests, "text").splitlines()


def test_failure_of_colcon_itself() -> None:
    tests = Tests((), "the tests did not finish within 5 s")
    assert not smoke_of(tests).ok
    assert "    problem: the tests did not finish within 5 s" in written(tests, "text").splitlines()


def test_cases_are_part_of_the_junit_suite(tmp_path: Path) -> None:
    (tmp_path / "smoke.xunit.xml").write_text(written(Tests(tuple(read(XML))), "junit"))
    code, output = test_result(tmp_path, "--verbose")
    assert (code, "5 tests, 0 errors, 2 failures, 1 skipped" in output) == (1, True)


@pytest.mark.build
@NEEDS_ROS
def test_tests_of_a_package_are_run(tmp_path: Path) -> None:
    package = python_package(tmp_path / "src", "demo", {"once": ONCE})
    setup = package / "setup.py"
    setup.write_text(
        setup.read_text().replace(
            "    entry", "    extras_require={'test': ['pytest']},\n    entry"
        )
    )
    test = "import os\n\ndef test_good():\n    assert os.environ['ROS_DOMAIN_ID']\n\n"
    write(package, {"test/test_demo.py": test + "def test_bad():\n    assert 1 == 2\n"})
    done = subprocess.run(
        command_line(package, "--test", "--duration", "1", "--format", "json"),
        env=variables(tmp_path),
        capture_output=True,
        text=True,
        check=False,
    )
    assert (done.returncode, done.stderr) == (1, "")
    (result,) = json.loads(done.stdout)["packages"]
    outcomes = {
        case["name"].rpartition(".")[2]: case["outcome"] for case in result["tests"]["cases"]
    }
    assert outcomes == {"test_good": "passed", "test_bad": "failed"}
    assert (result["tests"]["ok"], result["tests"]["error"]) == (False, "")
    assert result["executables"][0]["ok"]
    assert not [path for path in package.rglob("*") if "pytest" in path.name]
