"""IM042: programs of CMake packages use absolute imports."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Rule, ViewError
from scaffold.api.cmake import programs

_LISTS = (
    "project(talker)\nfind_package(ament_cmake_python REQUIRED)\n"
    "ament_python_install_package(${PROJECT_NAME})\n"
    "install(PROGRAMS talker/node.py DESTINATION lib/${PROJECT_NAME})\nament_package()\n"
)
_FILES = {"CMakeLists.txt": _LISTS, "talker/__init__.py": "", "talker/text.py": "TEXT = ''\n"}


class RelativeImportInScript(Rule):
    """A script that is executed as a file uses a relative import.

    **Why.** In ``lib/<package>`` it is not part of a Python package: ``ImportError: attempted
    relative import with no known parent package``.

    **Fix.** Write the full name: ``from talker.text import TEXT``.

    **Source.** Python documentation, "Intra-package references".
    """

    code = "IM042"
    name = "relative-import-in-script"
    examples = (
        Example(
            "an absolute import", {**_FILES, "talker/node.py": "from talker.text import TEXT\n"}
        ),
        Example(
            "a relative import",
            {**_FILES, "talker/node.py": "from .text import TEXT\n"},
            "talker/node.py:1:1: relative import in an installed script, which is not part of a "
            "package: ImportError; use the full module name",
        ),
        Example(
            "`__init__.py`, which nobody runs",
            {
                **_FILES,
                "CMakeLists.txt": _LISTS.replace("node.py", "__init__.py"),
                "talker/__init__.py": "from .text import TEXT\n",
            },
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for path in sorted({program.path for program in programs(package)}):
            if path not in package.python_files or path.endswith("__init__.py"):
                continue
            try:
                module = package.module(path)
            except ViewError:
                continue
            for item in module.imports:
                if item.level and not item.guarded and not item.conditional:
                    message = (
                        "relative import in an installed script, which is not part of a package: "
                        "ImportError; use the full module name"
                    )
                    yield self.report(item, message)
