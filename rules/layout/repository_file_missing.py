"""LY022: the root of a repository has the files that ament_copyright looks for."""

from __future__ import annotations

import os
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Report, Rule, Severity

TEST = """\
# Copyright 2026 Example Robotics
#
# Use of this source code is governed by an MIT-style
# license that can be found in the LICENSE file or at
# https://opensource.org/licenses/MIT.

from ament_copyright.main import main


def test_copyright():
    assert main(argv=['.', 'test']) == 0
"""
CONTRIBUTING = """\
Any contribution that you make to this repository will
be under the MIT license, as dictated by that
[license](https://opensource.org/licenses/MIT).
"""
MIT = """\
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
FILES = {"package.xml": "<package/>\n", "test/test_copyright.py": TEST, ".git": "gitdir: x\n"}


class RepositoryFileMissing(Rule):
    """A package that is a repository of its own lacks a known LICENSE or CONTRIBUTING.md.

    **Why.** ``ament_copyright`` asks for both in the directory that has ``.git`` or ``.hg``, with
    the text it knows, and fails under ``colcon test``. A package inside of a repository is not
    asked.

    **Fix.** ``ament_copyright --add-missing "NAME" LICENCE`` writes both.

    **Source.** ``ament_copyright/main.py`` and ``crawler.py``.
    """

    code = "LY022"
    name = "repository-file-missing"
    other_severities = {Severity.INFO: "no test of the package runs ament_copyright"}
    examples = (
        Example("no repository", {"package.xml": "<package/>\n", "test/test_copyright.py": TEST}),
        Example("both", {**FILES, "LICENSE": MIT, "CONTRIBUTING.md": CONTRIBUTING}),
        Example(
            "none",
            FILES,
            reports=(
                Report(
                    "CONTRIBUTING.md:1:1",
                    "the repository has no CONTRIBUTING.md: ament_copyright fails",
                ),
                Report("LICENSE:1:1", "the repository has no LICENSE: ament_copyright fails"),
            ),
        ),
        Example(
            "none, and no test that looks for them",
            {path: text for path, text in FILES.items() if path != "test/test_copyright.py"},
            reports=(
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
        ),
        Example(
            "words of one's own",
            {**FILES, "LICENSE": MIT, "CONTRIBUTING.md": "Please do.\n"},
            reports=(
                Report(
                    "CONTRIBUTING.md:1:1",
                    "CONTRIBUTING.md is not, word for word, the text that goes with a "
                    "known licence: ament_copyright fails",
                ),
            ),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        from scaffold.api.ament import REPOSITORY_FILES, copyright_use

        if not _is_repository(package):
            return
        use = copyright_use(package)
        for name in REPOSITORY_FILES:
            wrong = _wrong(package, name)
            if wrong and use.runs:
                yield self.report(package.start_of(name), f"{wrong}: ament_copyright fails")
            elif wrong:
                message = f"{wrong}: ament_copyright would fail, but {use.why_not}"
                at = package.start_of(name)
                yield self.report(at, message, severity=Severity.INFO)


def _is_repository(package: Package) -> bool:
    if package.has(".git") or package.has(".hg"):
        return True
    root = package.place
    places = [os.path.join(root, name) for name in (".git", ".hg")] if root is not None else []
    return any(package.outside.exists(place) for place in places)


def _wrong(package: Package, name: str) -> str:
    from scaffold.api.ament import identify_file

    if not package.has(name):
        return f"the repository has no {name}"
    data = package.tree.read(name)
    if not data:
        return f"{name} is empty"
    if identify_file(name, data) is None:
        return f"{name} is not, word for word, the text that goes with a known licence"
    return ""
