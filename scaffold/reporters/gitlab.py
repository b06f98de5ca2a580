"""Code Quality of GitLab: a JSON array for ``artifacts: reports: codequality``."""

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
            "description": f"{one.code} {printable(one.message)}",
            "check_name": one.code,
            "fingerprint": fingerprints.of(result.package, one),
            "severity": _SEVERITIES[one.severity],
            "location": {
                "path": in_repository(result.package, one.location.path),
                "lines": {"begin": one.location.line, "end": one.location.end_line},
            },
        }
        for result in results
        for one in result.diagnostics
    ]
    out.write(json_text(findings) + "\n")
