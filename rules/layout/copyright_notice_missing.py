"""LY020: every source file says whose it is."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Report, Rule, Severity

APACHE = """\
# Copyright 2026 Example Robotics
#
# Licensed under the Apache License, Version 2.0 (the "License");
# you may not use this file except in compliance with the License.
# You may obtain a copy of the License at
#
#     http://www.apache.org/licenses/LICENSE-2.0
#
# Unless required by applicable law or agreed to in writing, software
# distributed under the License is distributed on an "AS IS" BASIS,
# WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
# See the License for the specific language governing permissions and
# limitations under the License.
"""
TEST = f"""\
{APACHE}
from ament_copyright.main import main


def test_copyright():
    assert main(argv=['.', 'test']) == 0
"""
SKIPPED = TEST.replace("\n\ndef", "import pytest\n\n\n@pytest.mark.skip(reason='later')\ndef")
BARE = "import rclpy\n"


class CopyrightNoticeMissing(Rule):
    """A source file has no copyright notice at its start.

    **Why.** ``ament_copyright`` fails under ``colcon test``. Where the package does not run it,
    or skips it as ``ros2 pkg create`` writes it, this is one piece of advice for the package.

    **Fix.** Begin each C, C++, CMake and Python file with a line such as
    ``# Copyright 2026 Example Robotics`` and the header of the licence. No automatic fix: the
    tool does not know who holds the copyright.

    **Source.** ``ament_copyright/main.py``; ROS 2 developer guide, "Licensing".
    """

    code = "LY020"
    name = "copyright-notice-missing"
    other_severities = {Severity.INFO: "no test of the package runs ament_copyright on the file"}
    examples = (
        Example(
            "all have one", {"a/talker.py": f"{APACHE}\n{BARE}", "test/test_copyright.py": TEST}
        ),
        Example("empty files and setup.py need none", {"a/__init__.py": "", "setup.py": BARE}),
        Example(
            "without",
            {"a/one.py": BARE, "a/two.py": BARE, "test/test_copyright.py": TEST},
            reports=(
                Report(
                    "a/one.py:1:1",
                    "no copyright notice in the first comment of this file: ament_copyright fails",
                ),
                Report(
                    "a/two.py:1:1",
                    "no copyright notice in the first comment of this file: ament_copyright fails",
                ),
            ),
        ),
        Example(
            "without, where nobody looks: advice, once",
            {"a/one.py": BARE, "a/two.py": BARE, "test/test_copyright.py": SKIPPED},
            reports=(
                Report(
                    "a/one.py:1:1",
                    "no copyright notice here and in 1 more: ament_copyright would "
                    "fail, but test/test_copyright.py is skipped",
                    severity=Severity.INFO,
                ),
            ),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        from scaffold.api.ament import copyright_use, notices

        found = [header for header in notices.headers(package) if not header.holders]
        if not found:
            return
        use = copyright_use(package)
        passed_over = [header for header in found if not use.covers(header.path)]
        for header in found:
            if use.covers(header.path):
                said = header.unreadable or "no copyright notice in the first comment of this file"
                yield self.report(header, f"{said}: ament_copyright fails")
        if passed_over:
            why = use.why_not or "it is told to exclude them"
            number = len(passed_over) - 1
            said = (
                f"no copyright notice here and in {number} more"
                if number
                else "no copyright notice"
            )
            message = f"{said}: ament_copyright would fail, but {why}"
            yield self.report(passed_over[0], message, severity=Severity.INFO)
