"""LY004: every imported directory is a Python package."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import (
    CreateFile,
    Diagnostic,
    Effect,
    Example,
    Fix,
    Package,
    Report,
    Rule,
    Severity,
)
from scaffold.api.install import is_never_run
from scaffold.api.python import UNKNOWN, Import, imports_by_path
from scaffold.api.setup_py import FindPackages, matches, package_data

_TESTS = frozenset({"test", "tests"})
_FILES = {
    "setup.py": "from setuptools import find_packages, setup\n\nsetup(packages=find_packages())\n",
    "talker/__init__.py": "",
    "talker/node.py": "from talker.text.hello import hello\n",
    "talker/text/hello.py": "",
}


class SubpackageWithoutInit(Rule):
    """A directory with imported modules has no ``__init__.py``.

    **Why.** setuptools does not install the directory: the import works in the source tree, but
    fails after installation: ``ModuleNotFoundError: No module named 'talker.text'``.

    **Fix.** Add an empty ``__init__.py``.

    **Source.** setuptools documentation, "Package discovery".
    """

    code = "LY004"
    name = "subpackage-without-init"
    effect = Effect.STOPS_BUILD
    other_severities = {Severity.WARNING: "only modules that nothing imports or starts import it"}
    examples = (
        Example("with __init__.py", {**_FILES, "talker/text/__init__.py": ""}),
        Example(
            "modules that are package data",
            {
                **_FILES,
                "setup.py": "from setuptools import find_packages, setup\n\n"
                "setup(packages=find_packages(), package_data={'talker': ['text/*']})\n",
            },
        ),
        Example(
            "tests, which run in the source tree",
            {
                **_FILES,
                "talker/text/__init__.py": "",
                "test/__init__.py": "",
                "test/node/tools.py": "",
                "test/node/test_node.py": "from test.node.tools import start\n",
            },
        ),
        Example(
            "tests inside the package",
            {
                **_FILES,
                "talker/text/__init__.py": "",
                "talker/tests/__init__.py": "",
                "talker/tests/test_node.py": "from .etc.ports import Port\n",
                "talker/tests/etc/ports.py": "class Port: ...\n",
            },
        ),
        Example(
            "without, in a module that nothing imports or starts",
            {
                **_FILES,
                "setup.py": "from setuptools import find_packages, setup\n\n"
                "setup(packages=find_packages(),\n"
                "      entry_points={'console_scripts': ['node = talker.node:main']})\n",
                "talker/node.py": "def main():\n    pass\n",
                "talker/past.py": "from talker.text.hello import hello\n",
            },
            Report(
                "talker/text/__init__.py:1:1",
                "missing: without it talker/text/ is not installed, but "
                "talker/past.py:1 imports from it",
                fix="Create talker/text/__init__.py",
                severity=Severity.WARNING,
            ),
            fixed={"talker/text/__init__.py": ""},
        ),
        Example(
            "without __init__.py",
            _FILES,
            Report(
                "talker/text/__init__.py:1:1",
                "missing: without it talker/text/ is not installed, but "
                "talker/node.py:1 imports from it",
                fix="Create talker/text/__init__.py",
            ),
            fixed={"talker/text/__init__.py": ""},
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        packages = package.setup_py.packages
        if package.build_type != "ament_python" or packages is UNKNOWN:
            return
        missing: dict[str, tuple[Import, str, bool]] = {}
        for path, imports in imports_by_path(package):
            for item in (imported for imported in imports if not imported.in_tests):
                for directory in _directories(package, path, item):
                    init = f"{directory}/__init__.py"
                    earlier = missing.get(init)
                    if package.has(init) or (earlier and earlier[2]):
                        continue
                    if self._is_listed(packages, directory) or _is_data(package, directory):
                        continue
                    is_used = not is_never_run(package, path)
                    if is_used or earlier is None:
                        missing[init] = (item, directory, is_used)
        for init, (item, directory, is_used) in missing.items():
            at = item.location
            message = (
                f"missing: without it {directory}/ is not installed, but {at.path}:{at.line} "
                f"imports from it"
            )
            fix = Fix(f"Create {init}", (CreateFile(init, ""),))
            severity = None if is_used else Severity.WARNING
            yield self.report(package.start_of(init), message, fix, severity=severity)

    def _is_listed(self, packages: object, directory: str) -> bool:
        if isinstance(packages, FindPackages):
            return packages.namespace
        return isinstance(packages, list | tuple) and directory.replace("/", ".") in packages


def _is_data(package: Package, directory: str) -> bool:
    """Return whether modules of a directory are installed as data of the package around it."""
    modules = package.glob(f"{directory}/*.py")
    return any(matches(pattern, modules) for pattern in package_data(package) or ())


def _directories(package: Package, path: str, node: Import) -> Iterator[str]:
    """Yield the directories of an import below an import package."""
    if node.level:
        base = path.split("/")[: -node.level]
        parts = [*base, *(node.module.split(".") if node.module else ())]
    else:
        parts = node.module.split(".")
    if not parts or parts[0] in _TESTS or not package.has(f"{parts[0]}/__init__.py"):
        return
    for depth in range(2, len(parts) + 1):
        directory = "/".join(parts[:depth])
        if package.glob(f"{directory}/*.py") and not package.has(f"{directory}.py"):
            yield directory
    for name in node.names:
        directory = "/".join([*parts, name.name])
        if package.glob(f"{directory}/*.py"):
            yield directory
