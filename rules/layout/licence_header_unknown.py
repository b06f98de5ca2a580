"""LY021: the header of a source file is the text of a known licence."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Report, Rule, Severity

MIT = """\
# Copyright 2026 Example Robotics
#
# Use of this source code is governed by an MIT-style
# license that can be found in the LICENSE file or at
# https://opensource.org/licenses/MIT.
"""
TEST = f"""\
{MIT}
from ament_copyright.main import main


def test_copyright():
    assert main(argv=['.', 'test']) == 0
"""
SPDX = "# Copyright 2026 Example Robotics\n# SPDX-License-Identifier: Apache-2.0\n"


class LicenceHeaderUnknown(Rule):
    """The text behind the copyright notice of a source file is no known licence header.

    **Why.** ``ament_copyright`` fails under ``colcon test``: it compares word for word, and knows
    no ``SPDX-License-Identifier`` lines. Where the package does not run it, this is one piece of
    advice for the package.

    **Fix.** Use the header of the licence as it was published; ``ament_copyright --list-licenses``
    shows which are known.

    **Source.** ``ament_copyright/parser.py``; ament/ament_lint#462.
    """

    code = "LY021"
    name = "licence-header-unknown"
    other_severities = {Severity.INFO: "no test of the package runs ament_copyright on the file"}
    examples = (
        Example("known", {"a/talker.py": MIT, "test/test_copyright.py": TEST}),
        Example(
            "one word is different",
            {"a/talker.py": MIT.replace("license", "licence"), "test/test_copyright.py": TEST},
            reports=(
                Report(
                    "a/talker.py:1:3",
                    '"Use of this source code …" begins the header of no licence that '
                    "is known: ament_copyright fails",
                ),
            ),
        ),
        Example(
            "an SPDX line, behind a first line",
            {"a/talker.py": f"#!/usr/bin/env python3\n{SPDX}", "test/test_copyright.py": TEST},
            reports=(
                Report(
                    "a/talker.py:2:3",
                    "an SPDX line stands below the notice, not the header of a licence: "
                    "ament_copyright fails",
                ),
            ),
        ),
        Example(
            "nobody looks",
            {"a/one.py": SPDX, "a/two.py": SPDX},
            reports=(
                Report(
                    "a/one.py:1:3",
                    "an SPDX line stands below the notice, not the header of a licence "
                    "(and 1 more files have no known header): ament_copyright would "
                    "fail, but no test of this package runs it",
                    severity=Severity.INFO,
                ),
            ),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        from scaffold.api.ament import copyright_use, notices

        found = [one for one in notices.headers(package) if one.holders and not one.licence]
        if not found:
            return
        use = copyright_use(package)
        passed_over = [header for header in found if not use.covers(header.path)]
        for header in found:
            if use.covers(header.path):
                yield self.report(header, f"{_reason(header.text)}: ament_copyright fails")
        if passed_over:
            why = use.why_not or "it is told to exclude them"
            number = len(passed_over) - 1
            more = f" (and {number} more files have no known header)" if number else ""
            message = f"{_reason(passed_over[0].text)}{more}: ament_copyright would fail, but {why}"
            yield self.report(passed_over[0], message, severity=Severity.INFO)


def _reason(text: str) -> str:
    from scaffold.api.ament import departure

    if not text:
        return "no licence header stands below the notice"
    near = departure(text)
    if near is not None:
        licence, expected, given = near
        return f'the header is not that of {licence}: "{given}" stands for "{expected}"'
    if "SPDX-License-Identifier" in text:
        return "an SPDX line stands below the notice, not the header of a licence"
    start = " ".join(text.split()[:5])
    return f'"{start} …" begins the header of no licence that is known'
