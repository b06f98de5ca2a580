"""JSON schema of our SARIF reports: a subset of SARIF 2.1.0 with all that GitHub requires.

No package of the index has the schema of OASIS. This one names only the properties that we write,
with the types that section 3 of the standard gives them, and requires what the page "SARIF support
for code scanning" of GitHub requires.
"""

from __future__ import annotations

from typing import Any


def _object(properties: dict[str, Any], *optional: str) -> dict[str, Any]:
    return {
        "type": "object",
        "properties": properties,
        "required": [name for name in properties if name not in optional],
        "additionalProperties": False,
    }


def _array(items: dict[str, Any], least: int = 0) -> dict[str, Any]:
    return {"type": "array", "items": items, "minItems": least}


TEXT = {"type": "string", "minLength": 1}
SHORT_TEXT = {**TEXT, "maxLength": 1024}
LEVEL = {"enum": ["error", "warning", "note"]}
NUMBER = {"type": "integer", "minimum": 1}
REGION = _object(dict.fromkeys(("startLine", "startColumn", "endLine", "endColumn"), NUMBER))
FILE = _object({"uri": {"type": "string", "pattern": r"^(?!/|[A-Za-z]+:)[!-~]+$"}})
REPLACEMENT = _object(
    {"deletedRegion": REGION, "insertedContent": _object({"text": {"type": "string"}})}
)
FIX = _object(
    {
        "description": _object({"text": TEXT}),
        "artifactChanges": _array(
            _object({"artifactLocation": FILE, "replacements": _array(REPLACEMENT, 1)}), 1
        ),
        "properties": _object({"safety": {"enum": ["safe", "unsafe"]}}),
    }
)
RULE = _object(
    {
        "id": TEXT,
        "name": {**TEXT, "maxLength": 255},
        "shortDescription": _object({"text": SHORT_TEXT}),
        "fullDescription": _object({"text": SHORT_TEXT}),
        "help": _object({"text": TEXT, "markdown": TEXT}),
        "helpUri": {"type": "string", "format": "uri"},
        "defaultConfiguration": _object({"level": LEVEL}),
        "properties": _object(
            {
                "tags": {**_array(TEXT), "maxItems": 20, "uniqueItems": True},
                "precision": {"enum": ["very-high", "high", "medium", "low"]},
                "problem.severity": {"enum": ["error", "warning", "recommendation"]},
            }
        ),
    },
    "helpUri",
)
RESULT = _object(
    {
        "ruleId": TEXT,
        "ruleIndex": {"type": "integer", "minimum": 0},
        "level": LEVEL,
        "message": _object({"text": TEXT}),
        "locations": _array(
            _object({"physicalLocation": _object({"artifactLocation": FILE, "region": REGION})}), 1
        ),
        "partialFingerprints": _object({"primaryLocationLineHash": TEXT, "finding/v1": TEXT}),
        "fixes": _array(FIX, 1),
    },
    "fixes",
)
DRIVER = _object(
    {"name": TEXT, "version": TEXT, "semanticVersion": TEXT, "rules": _array(RULE)},
)
RUN = _object(
    {
        "tool": _object({"driver": DRIVER}),
        "automationDetails": _object({"id": {"type": "string", "pattern": "/$"}}),
        "columnKind": {"enum": ["utf16CodeUnits", "unicodeCodePoints"]},
        "invocations": _array(_object({"executionSuccessful": {"type": "boolean"}}), 1),
        "results": _array(RESULT),
    }
)
SCHEMA = _object(
    {"$schema": {"type": "string"}, "version": {"const": "2.1.0"}, "runs": _array(RUN, 1)}
)
