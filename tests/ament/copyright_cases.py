"""Packages and what ament_copyright reports about them, by code."""

from __future__ import annotations

from collections.abc import Mapping

from scaffold.check.rules.rule import Example, Report
from scaffold.diagnostic import Severity

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
MIT = """\
# Copyright 2026 Example Robotics
#
# Use of this source code is governed by an MIT-style
# license that can be found in the LICENSE file or at
# https://opensource.org/licenses/MIT.
"""
MIT_TEST = f"""\
{MIT}
from ament_copyright.main import main


def test_copyright():
    assert main(argv=['.', 'test']) == 0
"""
SPDX = "# Copyright 2026 Example Robotics\n# SPDX-License-Identifier: Apache-2.0\n"
CONTRIBUTING = """\
Any contribution that you make to this repository will
be under the MIT license, as dictated by that
[license](https://opensource.org/licenses/MIT).
"""
MIT_TEXT = """\
Permission is hereby granted, free of charge, to any person obtaining a copy
of this software and associated documentation files (the "Software"), to deal
in the Software without restriction, including without limitation the rights
to use, copy, modify, merge, publish, distribute, sublicense, and/or sell
copies of the Software, and to permit persons to whom the Software is
furnished to do so, subject to the following conditions:

The above copyright notice and this permission notice shall be included in
all copies or substantial portions of the Software.

THE SOFTWARE IS PROVIDED "AS IS", WITHOUT WARRANTY OF ANY KIND, EXPRESS OR
IMPLIED, INCLUDING BUT NOT LIMITED TO THE WARRANTIES OF MERCHANTABILITY,
FITNESS FOR A PARTICULAR PURPOSE AND NONINFRINGEMENT. IN NO EVENT SHALL
THE AUTHORS OR COPYRIGHT HOLDERS BE LIABLE FOR ANY CLAIM, DAMAGES OR OTHER
LIABILITY, WHETHER IN AN ACTION OF CONTRACT, TORT OR OTHERWISE, ARISING FROM,
OUT OF OR IN CONNECTION WITH THE SOFTWARE OR THE USE OR OTHER DEALINGS IN
THE SOFTWARE.
"""
NAMES_APACHE = "<package><license>Apache-2.0</license></package>\n"
FILES = {
    "package.xml": "<package/>\n",
    "test/test_copyright.py": MIT_TEST,
    ".git": "gitdir: x\n",
}

CASES: Mapping[str, tuple[Example, ...]] = {
    "LY020": (
        Example(
            "all have one", {"a/talker.py": f"{APACHE}\n{BARE}", "test/test_copyright.py": TEST}
        ),
        Example("empty files and setup.py need none", {"a/__init__.py": "", "setup.py": BARE}),
        Example(
            "without",
            {"a/one.py": BARE, "a/two.py": BARE, "test/test_copyright.py": TEST},
            Report(
                "a/one.py:1:1",
                "no copyright notice in the first comment of this file: ament_copyright fails",
            ),
            Report(
                "a/two.py:1:1",
                "no copyright notice in the first comment of this file: ament_copyright fails",
            ),
        ),
        Example(
            "without, where setup.py does not declare pytest",
            {
                "a/one.py": BARE,
                "test/test_copyright.py": TEST,
                "package.xml": "<package><export><build_type>ament_python</build_type></export>"
                "</package>\n",
                "setup.py": "from setuptools import setup\n\nsetup(name='a')\n",
            },
            Report(
                "a/one.py:1:1",
                "no copyright notice: ament_copyright would fail, but setup.py does not declare "
                "pytest, so that colcon runs no test",
                severity=Severity.INFO,
            ),
        ),
        Example(
            "without, where CMake runs another test",
            {
                "a/one.py": BARE,
                "test/test_copyright.py": TEST,
                "package.xml": "<package><export><build_type>ament_cmake</build_type></export>"
                "</package>\n",
                "CMakeLists.txt": "project(a)\nament_add_pytest_test(walk test/test_walk.py)\n",
            },
            Report(
                "a/one.py:1:1",
                "no copyright notice: ament_copyright would fail, but CMake does not run "
                "test/test_copyright.py",
                severity=Severity.INFO,
            ),
        ),
        Example(
            "without, where the file with the test was renamed",
            {
                "a/one.py": BARE,
                "no_tests/_test_copyright.py": TEST,
                "package.xml": "<package><export><build_type>ament_python</build_type></export>"
                "</package>\n",
            },
            Report(
                "a/one.py:1:1",
                "no copyright notice: ament_copyright would fail, but pytest does not run "
                "no_tests/_test_copyright.py",
                severity=Severity.INFO,
            ),
        ),
        Example(
            "without, in a directory that the test does not pass to the linter",
            {
                "a/one.py": f"{APACHE}\n{BARE}",
                "b/two.py": BARE,
                "test/test_copyright.py": TEST.replace("'.',", "'./a',"),
            },
            Report(
                "b/two.py:1:1",
                "no copyright notice: ament_copyright would fail, but it checks other files only",
                severity=Severity.INFO,
            ),
        ),
        Example(
            "without, where nobody looks: advice, once",
            {"a/one.py": BARE, "a/two.py": BARE, "test/test_copyright.py": SKIPPED},
            Report(
                "a/one.py:1:1",
                "no copyright notice here and in 1 more: ament_copyright would "
                "fail, but test/test_copyright.py is skipped",
                severity=Severity.INFO,
            ),
        ),
    ),
    "LY021": (
        Example("known", {"a/talker.py": MIT, "test/test_copyright.py": MIT_TEST}),
        Example(
            "one word is different",
            {
                "a/talker.py": MIT.replace("license", "licence"),
                "test/test_copyright.py": MIT_TEST,
            },
            Report(
                "a/talker.py:1:3",
                '"Use of this source code …" does not begin any known license '
                "header: ament_copyright fails",
            ),
        ),
        Example(
            "an SPDX line, behind a first line",
            {
                "a/talker.py": f"#!/usr/bin/env python3\n{SPDX}",
                "test/test_copyright.py": MIT_TEST,
            },
            Report(
                "a/talker.py:2:3",
                "an SPDX line below the notice is not the header of a license: "
                "ament_copyright fails",
            ),
        ),
        Example(
            "nobody looks",
            {"a/one.py": SPDX, "a/two.py": SPDX},
            Report(
                "a/one.py:1:3",
                "an SPDX line below the notice is not the header of a license "
                "(and 1 more file has no known header): ament_copyright would "
                "fail, but no test of this package runs it",
                severity=Severity.INFO,
            ),
        ),
    ),
    "LY022": (
        Example(
            "no repository",
            {"package.xml": "<package/>\n", "test/test_copyright.py": MIT_TEST},
        ),
        Example(
            "both",
            {**FILES, "LICENSE": MIT_TEXT, "CONTRIBUTING.md": CONTRIBUTING},
        ),
        Example(
            "none",
            FILES,
            Report(
                "CONTRIBUTING.md:1:1",
                "the repository has no CONTRIBUTING.md: ament_copyright fails",
            ),
            Report("LICENSE:1:1", "the repository has no LICENSE: ament_copyright fails"),
        ),
        Example(
            "none, and no test that looks for them",
            {path: text for path, text in FILES.items() if path != "test/test_copyright.py"},
            Report(
                "CONTRIBUTING.md:1:1",
                "the repository has no CONTRIBUTING.md: ament_copyright would fail, "
                "but no test of this package runs it",
                severity=Severity.INFO,
            ),
            Report(
                "LICENSE:1:1",
                "the repository has no LICENSE: ament_copyright would fail, but no "
                "test of this package runs it",
                severity=Severity.INFO,
            ),
        ),
        Example(
            "after git init, under a license that package.xml names",
            {
                **FILES,
                "package.xml": "<package><license>MIT</license></package>\n",
                "LICENSE": MIT_TEXT,
            },
            Report(
                "CONTRIBUTING.md:1:1",
                "the repository has no CONTRIBUTING.md: ament_copyright fails",
                fix="Create the CONTRIBUTING.md of the license",
            ),
            fixed={"CONTRIBUTING.md": CONTRIBUTING},
        ),
        Example(
            "a LICENSE that is not the one that package.xml names",
            {**FILES, "package.xml": NAMES_APACHE, "LICENSE": MIT_TEXT},
            Report(
                "CONTRIBUTING.md:1:1",
                "the repository has no CONTRIBUTING.md: ament_copyright fails",
            ),
        ),
        Example(
            "a LICENSE of one's own",
            {**FILES, "package.xml": NAMES_APACHE, "LICENSE": "Do as you like.\n"},
            Report(
                "CONTRIBUTING.md:1:1",
                "the repository has no CONTRIBUTING.md: ament_copyright fails",
            ),
            Report(
                "LICENSE:1:1",
                "LICENSE is not, word for word, the text that goes with a known license: "
                "ament_copyright fails",
            ),
        ),
        Example(
            "words of one's own",
            {**FILES, "LICENSE": MIT_TEXT, "CONTRIBUTING.md": "Please do.\n"},
            Report(
                "CONTRIBUTING.md:1:1",
                "CONTRIBUTING.md is not, word for word, the text that goes with a "
                "known license: ament_copyright fails",
            ),
        ),
    ),
}
