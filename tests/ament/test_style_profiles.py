"""The style findings for each distribution equal those of its linters."""

from __future__ import annotations

import pytest

from scaffold import distributions
from scaffold.ament import StyleCheck
from scaffold.ament import copyright as notices
from scaffold.distributions import ORDER, named
from scaffold.model.package import Package
from tests.ament.profile_cases import BY_FILE, CASES


def codes_by_file(name: str) -> dict[str, set[str]]:
    """Return the codes found in the files of all cases, for a distribution."""
    with distributions.targeting(named(name)):
        package = Package.of(BY_FILE)
        result: dict[str, set[str]] = {path: set() for path in BY_FILE}
        for item in StyleCheck([package]).diagnostics(package):
            result[item.location.path].add(item.code)
        return result


@pytest.mark.parametrize("name", ORDER)
def test_findings_follow_the_linters_of_the_distribution(name: str) -> None:
    result = codes_by_file(name)
    wrong = [
        case
        for case, path in zip(CASES, BY_FILE, strict=True)
        if (case.code in result[path]) != (name in case.reported_for)
    ]
    assert wrong == []


def test_docstring_findings_come_from_pep257_without_flake8_plugin() -> None:
    files = {
        "package.xml": "<package><name>a</name></package>\n",
        "setup.py": "",
        "a/__init__.py": '"""does things"""\n',
        "test/test_pep257.py": (
            "from ament_pep257.main import main\n\n\n"
            "def test_pep257():\n    assert main(argv=['--ignore', 'D400', 'D403']) == 0\n"
        ),
    }
    reported = {}
    for name in ORDER:
        with distributions.targeting(named(name)):
            package = Package.of(files)
            findings = StyleCheck([package]).diagnostics(package)
            reported[name] = "D400" in {item.code for item in findings}
    assert reported == {"humble": True, "jazzy": True, "kilted": True, "lyrical": False}


def test_known_license_texts_depend_on_the_target() -> None:
    (known,) = [item for item in notices.known_texts()["header"] if item.license == "BSD-2.0"]
    text = "# Copyright 2026 Ada\n" + "".join(
        f"# {section}\n" for section in " Ada ".join(known.sections).splitlines()
    )
    licenses = {}
    for name in ORDER:
        with distributions.targeting(named(name)):
            licenses[name] = notices.read("a.py", text.encode()).license
    assert licenses == {
        "humble": "BSD-2.0",
        "jazzy": "BSD-2.0",
        "kilted": "BSD-2.0",
        "lyrical": None,
    }


def test_recognized_notices_depend_on_the_target() -> None:
    lower = b"# copyright 2026 Ada\n"
    block = b"/*\n * Copyright 2026 Ada\n * All of it.\n */\n"
    holders = {}
    for name in ORDER:
        with distributions.targeting(named(name)):
            holders[name] = [notices.read("a.cpp", text).holders for text in (lower, block)]
    some = [("Ada",), ("Ada",)]
    assert holders == {"humble": [(), ()], "jazzy": some, "kilted": some, "lyrical": some}
