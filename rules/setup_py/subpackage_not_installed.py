"""SP013: sub-packages are installed."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Edit, Example, Fix, Package, Report, Rule
from scaffold.api.python import Unknown
from scaffold.api.setup_py import FindPackages

_SETUP = "from setuptools import {}\n\nsetup(\n    name='talker',\n    packages={},\n)\n"
_FILES = {"talker/__init__.py": "", "talker/text/__init__.py": "", "test/__init__.py": ""}
_BY_CMAKE = (
    "<package><name>talker</name><export><build_type>ament_cmake</build_type></export></package>\n"
)
_FIND = "find_packages(exclude=['test'])"
_TESTS = frozenset({"test", "tests"})
"""Sub-packages that are often left out on purpose."""


class SubpackageNotInstalled(Rule):
    """``packages`` lists the package, but not a sub-package of it.

    **Why.** It works in the source tree; installed it is ``ModuleNotFoundError: No module named
    'talker.text'``.

    **Fix.** Write ``packages=find_packages(exclude=['test'])``.

    **Source.** setuptools documentation, "Package discovery"; the template of ``ros2 pkg create``.
    """

    code = "SP013"
    name = "subpackage-not-installed"
    examples = (
        Example("found", {**_FILES, "setup.py": _SETUP.format("find_packages, setup", _FIND)}),
        Example(
            "installed by CMake",
            {**_FILES, "package.xml": _BY_CMAKE, "setup.py": _SETUP.format("setup", "['talker']")},
        ),
        Example(
            "listed by their directories",
            {**_FILES, "setup.py": _SETUP.format("setup", "['talker', 'talker/text/']")},
        ),
        Example(
            "left out with its tests",
            {
                "talker/__init__.py": "",
                "talker/tests/__init__.py": "",
                "setup.py": _SETUP.format("setup", "['talker']"),
            },
        ),
        Example(
            "one listed",
            {**_FILES, "setup.py": _SETUP.format("find_packages, setup", "['talker']")},
            Report(
                "setup.py:5:14",
                "packages leaves out talker.text: it is not installed; write "
                "find_packages(exclude=['test'])",
                fix="write find_packages(exclude=['test'])",
            ),
            fixed={"setup.py": _SETUP.format("find_packages, setup", _FIND)},
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        if package.build_type == "ament_cmake":
            return  # ament_python_install_package() copies the whole directory
        setup = package.setup_py
        packages = setup.packages
        keyword = setup.keyword("packages")
        if keyword is None or not packages or isinstance(packages, FindPackages | Unknown):
            return
        missing = sorted(
            name
            for path in package.files
            if path.endswith("/__init__.py") and path.count("/") > 1
            for name in (path.removesuffix("/__init__.py").replace("/", "."),)
            if name.rpartition(".")[0] in packages and name not in packages
            if name.rpartition(".")[2] not in _TESTS
        )
        if not missing or setup.keyword("package_dir"):
            return
        fix = None
        if "find_packages" in setup.module.index.bindings(setup.module.tree):
            start, end = setup.module.span(keyword.node)
            fix = Fix(f"write {_FIND}", (Edit("setup.py", start, end, _FIND),))
        message = f"packages leaves out {', '.join(missing)}: it is not installed; write {_FIND}"
        yield self.report(keyword, message, fix)
