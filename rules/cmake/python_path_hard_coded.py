"""CM028: Python modules go where this Python looks."""

from __future__ import annotations

import re
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Report, Rule

_LISTS = "project(talker)\ninstall(DIRECTORY talker DESTINATION {})\n"


class PythonPathHardCoded(Rule):
    """``install`` writes Python modules below a fixed version of Python.

    **Why.** Any other version does not look there: ``ModuleNotFoundError``.

    **Fix.** Call ``ament_python_install_package(${PROJECT_NAME})``, or use
    ``${PYTHON_INSTALL_DIR}``.

    **Source.** ``ament_cmake_python``: ``PYTHON_INSTALL_DIR``.
    """

    code = "CM028"
    name = "python-path-hard-coded"
    examples = (
        Example("the variable", {"CMakeLists.txt": _LISTS.format("${PYTHON_INSTALL_DIR}")}),
        Example(
            "a version",
            {"CMakeLists.txt": _LISTS.format("lib/python3.8/site-packages")},
            Report(
                "2:38",
                "installs Python modules to lib/python3.8/site-packages, which only "
                "that version of Python searches",
            ),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for install in package.cmake.installs:
            argument = install.destination_argument
            where = install.destination or ""
            if argument is None or not re.search(r"python\d[\d.]*/|(site|dist)-packages", where):
                continue
            if "$" not in argument.raw:
                message = (
                    f"installs Python modules to {where}, which only that version of "
                    "Python searches"
                )
                yield self.report(argument, message)
