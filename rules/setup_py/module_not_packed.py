"""SP051: packages lists the packages that there are."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Report, Rule
from scaffold.api.python import Unknown
from scaffold.api.setup_py import FindPackages, SetupPy

_SETUP = (
    "from setuptools import find_packages, setup\n\nsetup(\n    name='talker',\n{}"
    "    entry_points={{'console_scripts': ['node = talker.node:main']}},\n)\n"
)
_FILES = {"talker/__init__.py": "", "talker/node.py": "def main():\n    pass\n"}


class ModuleNotPacked(Rule):
    """``packages`` lacks the package that the entry points start, or names a missing one.

    **Why.** The executables are made, the code is not installed: ``ModuleNotFoundError`` when they
    are started. For a package that does not exist the build stops: ``package directory 'demo' does
    not exist``.

    **Fix.** ``packages=find_packages(exclude=['test'])``.

    **Source.** setuptools documentation, "Package discovery".
    """

    code = "SP051"
    name = "module-not-packed"
    examples = (
        Example(
            "found",
            {
                "setup.py": _SETUP.format("    packages=find_packages(exclude=['test']),\n"),
                **_FILES,
            },
        ),
        Example(
            "none",
            {"setup.py": _SETUP.format(""), **_FILES},
            Report("setup.py:3:1", "packages leaves out 'talker', which the entry points start"),
        ),
        Example(
            "excluded",
            {
                "setup.py": _SETUP.format("    packages=find_packages(include=['test']),\n"),
                **_FILES,
            },
            Report(
                "setup.py:5:14", "find_packages leaves out 'talker', which the entry points start"
            ),
        ),
        Example(
            "another name",
            {"setup.py": _SETUP.format("    packages=['demo'],\n"), **_FILES},
            Report("setup.py:5:14", "packages leaves out 'talker', which the entry points start"),
            Report(
                "setup.py:5:14",
                "packages names 'demo', but there is no such directory: the build stops",
            ),
        ),
        Example(
            "no __init__.py",
            {
                "setup.py": _SETUP.format("    packages=find_packages(),\n"),
                "talker/node.py": "def main():\n    pass\n",
            },
            Report(
                "talker/__init__.py:1:1",
                "missing: find_packages does not install talker/ without it",
            ),
        ),
        Example(
            "no directory src",
            {"setup.py": _SETUP.format("    packages=find_packages(where='src'),\n"), **_FILES},
            Report(
                "setup.py:5:14",
                "find_packages looks in src/, which does not exist: nothing is installed",
            ),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        setup = package.setup_py
        if package.build_type == "ament_cmake":
            return  # nothing runs setup.py there
        if setup.call is None or setup.has_unknown_keywords or _is_configured(package, setup):
            return
        keyword = setup.keyword("packages")
        packages = setup.packages
        roots = {script.module.partition(".")[0] for script in setup.console_scripts} - {""}
        if isinstance(packages, FindPackages):
            yield from self._check_found(package, setup, packages, roots)
            return
        names = list(packages) if isinstance(packages, list | tuple) else None
        if (keyword is not None and names is None) or setup.keyword("py_modules"):
            return
        at = keyword or setup
        for name in names or ():
            if not package.has_directory(name.partition(".")[0]):
                message = (
                    f"packages names {name!r}, but there is no such directory: the build stops"
                )
                yield self.report(at, message)
        for root in sorted(roots - {item.partition(".")[0] for item in names or ()}):
            if package.has_directory(root):
                message = f"packages leaves out {root!r}, which the entry points start"
                yield self.report(at, message)

    def _check_found(
        self, package: Package, setup: SetupPy, packages: FindPackages, roots: set[str]
    ) -> Iterator[Diagnostic]:
        keyword = setup.keyword("packages")
        if keyword is None or packages.namespace or isinstance(packages.where, Unknown):
            return
        where = packages.where.strip("./")
        if where and not package.has_directory(where):
            message = f"find_packages looks in {where}/, which does not exist: nothing is installed"
            yield self.report(keyword, message)
            return
        for root in sorted(roots) if not where else ():
            is_left_out = packages.leaves_out(root)
            if isinstance(is_left_out, Unknown):
                return
            if is_left_out:
                message = f"find_packages leaves out {root!r}, which the entry points start"
                yield self.report(keyword, message)
            elif package.glob(f"{root}/*.py") and not package.has(f"{root}/__init__.py"):
                init = f"{root}/__init__.py"
                message = f"missing: find_packages does not install {root}/ without it"
                yield self.report(package.start_of(init), message)


def _is_configured(package: Package, setup: SetupPy) -> bool:
    """Tell whether packages are named in some other way."""
    if setup.keyword("package_dir") is not None:
        return True
    text = package.source("setup.cfg").text if package.has("setup.cfg") else ""
    return "packages" in text or package.has("pyproject.toml")
