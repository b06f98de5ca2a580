"""The codes for what ament_copyright reports."""

from __future__ import annotations

from scaffold.ament.codes.code import COPYRIGHT, AmentCode
from scaffold.diagnostic import Severity
from scaffold.edits import Safety

ROWS = (
    AmentCode(
        "LY020",
        "copyright-notice-missing",
        "A source file has no copyright notice at its start",
        COPYRIGHT,
        Severity.ERROR,
        other_severities={Severity.INFO: "no test of the package runs ament_copyright on the file"},
        message=("no copyright notice in the first comment of this file: ament_copyright fails"),
        documentation="""\
**Why.** ``ament_copyright`` fails under ``colcon test``. Where the package does not run it,
or skips it as ``ros2 pkg create`` writes it, this is one piece of advice for the package.

**Fix.** Begin each C, C++, CMake and Python file with a line such as
``# Copyright 2026 Example Robotics`` and the header of the license. No automatic fix: the
tool does not know who holds the copyright.

**Source.** ``ament_copyright/main.py``; ROS 2 developer guide, "Licensing".
""",
    ),
    AmentCode(
        "LY021",
        "license-header-unknown",
        "The text after the copyright notice of a source file is not a known license header",
        COPYRIGHT,
        Severity.ERROR,
        other_severities={Severity.INFO: "no test of the package runs ament_copyright on the file"},
        message=(
            '"Use of this source code …" does not begin any known license '
            "header: ament_copyright fails"
        ),
        documentation="""\
**Why.** ``ament_copyright`` fails under ``colcon test``: it compares word for word, and knows
no ``SPDX-License-Identifier`` lines. Where the package does not run it, this is one piece of
advice for the package.

**Fix.** Use the header of the license as it was published; ``ament_copyright --list-licenses``
shows which are known.

**Source.** ``ament_copyright/parser.py``; ament/ament_lint#462.
""",
    ),
    AmentCode(
        "LY022",
        "repository-file-missing",
        "A package that is a repository of its own lacks a known LICENSE or CONTRIBUTING.md",
        COPYRIGHT,
        Severity.ERROR,
        other_severities={Severity.INFO: "no test of the package runs ament_copyright"},
        message=("the repository has no CONTRIBUTING.md: ament_copyright fails"),
        fix=Safety.SAFE,
        documentation="""\
**Why.** ``ament_copyright`` asks for both in the directory that has ``.git`` or ``.hg``, with
the text it knows, and fails under ``colcon test``. A package inside of a repository is not
asked.

**Fix.** ``--fix`` writes the CONTRIBUTING.md of the license if package.xml and LICENSE agree on
it, and ``ament_copyright --add-missing "NAME" LICENSE`` both files.

**Source.** ``ament_copyright/main.py`` and ``crawler.py``.
""",
    ),
)
