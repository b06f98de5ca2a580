"""GitLab Code Quality report: the documented fields."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import jsonschema

Check = Callable[..., str]

SCHEMA = {
    "type": "array",
    "items": {
        "type": "object",
        "properties": {
            "description": {"type": "string", "minLength": 1},
            "check_name": {"type": "string", "minLength": 1},
            "fingerprint": {"type": "string", "minLength": 1},
            "severity": {"enum": ["info", "minor", "major", "critical", "blocker"]},
            "location": {
                "type": "object",
                "properties": {
                    "path": {"type": "string", "pattern": r"^(?!\.?/)"},
                    "lines": {
                        "type": "object",
                        "properties": {
                            "begin": {"type": "integer", "minimum": 1},
                            "end": {"type": "integer", "minimum": 1},
                        },
                        "required": ["begin"],
                    },
                },
                "required": ["path", "lines"],
            },
        },
        "required": ["description", "check_name", "fingerprint", "severity", "location"],
    },
}


def test_every_finding_has_the_documented_fields(
    check: Check, diagnostics: list[dict[str, Any]]
) -> None:
    text = check("--format", "gitlab")
    assert not text.startswith("\ufeff")
    report = json.loads(text)
    jsonschema.validate(report, SCHEMA)
    severities = {"error": "major", "warning": "minor", "info": "info"}
    assert [
        (finding["check_name"], finding["severity"], finding["location"]["path"])
        for finding in report
    ] == [
        (finding["code"], severities[finding["severity"]], finding["path"])
        for finding in diagnostics
    ]


def test_fingerprints_are_unique_and_independent_of_line_numbers(
    check: Check, repository: Path
) -> None:
    before = json.loads(check("--format", "gitlab"))
    names = [item["fingerprint"] for item in before]
    assert len({*names}) == len(names)
    path = repository / "src" / "talker" / "talker" / "talk.py"
    path.write_text(path.read_text().replace("import os\n", "import os\n\n\nLIMIT = 1\n"))
    after = json.loads(check("--format", "gitlab"))
    assert [item["fingerprint"] for item in after] == names
    assert [item["location"] for item in after] != [item["location"] for item in before]


def test_clean_package_gives_an_empty_array(check: Check) -> None:
    assert json.loads(check("--format", "gitlab", "--select", "ND", code=0)) == []
