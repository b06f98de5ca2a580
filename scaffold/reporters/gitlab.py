"""GitLab Code Quality reports."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TextIO

from scaffold.check.result import Result
from scaffold.diagnostic import Severity
from scaffold.printable import json_text, printable
from scaffold.reporters import ReportOptions
from scaffold.reporters.fingerprints import Fingerprints
from scaffold.reporters.paths import in_repository

_SEVERITIES = {Severity.ERROR: "major", Severity.WARNING: "minor", Severity.INFO: "info"}


def report(results: Sequence[Result], out: TextIO, options: ReportOptions) -> None:  # noqa: ARG001  same shape as the others
    """Write one object per finding."""
    fingerprints = Fingerprints()
    findings = [
        {
            "description": f"{diagnostic.code} {printable(diagnostic.text)}",
            "check_name": diagnostic.code,
            "fingerprint": fingerprints.of(result.package, diagnostic),
            "severity": _SEVERITIES[diagnostic.severity],
            "location": {
                "path": in_repository(result.package, diagnostic.location.path),
                "lines": {"begin": diagnostic.location.line, "end": diagnostic.location.end_line},
            },
        }
        for result in results
        for diagnostic in result.diagnostics
    ]
    out.write(json_text(findings) + "\n")
