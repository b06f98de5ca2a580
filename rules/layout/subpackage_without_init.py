"""LY004: every imported directory is a Python package."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple

from scaffold.api import (
    CreateFile,
    Diagnostic,
    Effect,
    Example,
    Fix,
    Location,
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


class _Use(NamedTuple):
    """A use of modules in a directory."""

    directory: str
    at: Location
    verb: str
    is_certain: bool
    """Whether the user may run."""


class SubpackageWithoutInit(Rule):
    """A directory with modules that are imported or started has no ``__init__.py``.

    **Why.** setuptools does not install the directory: the import works in the source tree, but
    fails after installation: ``ModuleNotFoundError: No module named 'talker.text'``.

    **Fix.** Add an empty ``__init__.py``.

    **Source.** setuptools documentation, "Package discovery".
    """

    code = "LY004"
    name = "subpackage-without-init"
    effect = Effect.STOPS_PACKAGE
    other_severities = {Severity.WARNING: "only modules that nothing imports or starts import it"}
    examples = (
        Example("with __init__.py", {**_FILES, "talker/text/__init__.py": ""}),
        Example(
            "package that setup.py does not list, so that the file changes nothing",
            {**_FILES, "setup.py": "from setuptools import setup\n\nsetup(packages=['robot'])\n"},
        ),
        Example(
            "package in a directory in which find_packages() does not search",
            {
                **_FILES,
                "setup.py": "from setuptools import find_packages, setup\n\n"
                "setup(packages=find_packages('talker', 'talker/text'))\n",
            },
        ),
        Example(
            "modules that are package data",
            {
                **_FILES,
                "setup.py": "from setuptools import find_packages, setup\n\n"
                "setup(packages=find_packages(), package_data={'talker': ['text/*']})\n",
            },
        ),
        Example(
            "programs",
            {
                "setup.py": "from setuptools import find_packages, setup\n\n"
                "setup(\n    packages=find_packages(),\n"
                "    entry_points={'console_scripts': ['talk = talker.nodes.talk:main']},\n)\n",
                "talker/__init__.py": "",
                "talker/nodes/talk.py": "def main():\n    pass\n",
            },
            Report(
                "talker/nodes/__init__.py:1:1",
                "missing: without it talker/nodes/ is not installed, but setup.py:5 "
                "starts a program in it",
                fix="Create talker/nodes/__init__.py",
            ),
            fixed={"talker/nodes/__init__.py": ""},
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
        missing: dict[str, _Use] = {}
        for use in _uses(package):
            init = f"{use.directory}/__init__.py"
            earlier = missing.get(init)
            if package.has(init) or (earlier and earlier.is_certain):
                continue
            if _is_needless(packages, use.directory) or _is_data(package, use.directory):
                continue
            if use.is_certain or earlier is None:
                missing[init] = use
        for init, use in missing.items():
            message = (
                f"missing: without it {use.directory}/ is not installed, but "
                f"{use.at.path}:{use.at.line} {use.verb} it"
            )
            fix = Fix(f"Create {init}", (CreateFile(init, ""),))
            severity = None if use.is_certain else Severity.WARNING
            yield self.report(package.start_of(init), message, fix, severity=severity)


def _is_needless(packages: object, directory: str) -> bool:
    """Return whether a directory is installed without the file, or not even with it."""
    if isinstance(packages, FindPackages):
        return packages.namespace or packages.where != "."
    if not isinstance(packages, list | tuple):
        return False
    return directory.partition("/")[0] not in packages or directory.replace("/", ".") in packages


def _is_data(package: Package, directory: str) -> bool:
    """Return whether modules of a directory are installed as data of the package around it."""
    modules = package.glob(f"{directory}/*.py")
    return any(matches(pattern, modules) for pattern in package_data(package) or ())


def _uses(package: Package) -> Iterator[_Use]:
    """Yield the uses of directories below import packages: by imports, then by entry points."""
    for path, imports in imports_by_path(package):
        for item in (imported for imported in imports if not imported.in_tests):
            for directory in _directories(package, path, item):
                if not package.has(f"{directory}/__init__.py"):
                    is_used = not is_never_run(package, path)
                    yield _Use(directory, item.location, "imports from", is_used)
    for script in package.setup_py.console_scripts:
        parts = script.module.split(".")
        for directory in _below(package, parts[:-1]):
            yield _Use(directory, script.location, "starts a program in", is_certain=True)


def _directories(package: Package, path: str, node: Import) -> Iterator[str]:
    """Yield the directories of an import below an import package."""
    if node.level:
        base = path.split("/")[: -node.level]
        parts = [*base, *(node.module.split(".") if node.module else ())]
    else:
        parts = node.module.split(".")
    yield from _below(package, parts)
    if not _is_package(package, parts[:1]):
        return
    for name in node.names:
        directory = "/".join([*parts, name.name])
        if package.glob(f"{directory}/*.py"):
            yield directory


def _below(package: Package, parts: Sequence[str]) -> Iterator[str]:
    """Yield the directories of a module below its import package."""
    for depth in range(2, len(parts) + 1) if _is_package(package, parts[:1]) else ():
        directory = "/".join(parts[:depth])
        if package.glob(f"{directory}/*.py") and not package.has(f"{directory}.py"):
            yield directory


def _is_package(package: Package, parts: Sequence[str]) -> bool:
    return bool(parts) and all(
        part not in _TESTS and package.has(f"{part}/__init__.py") for part in parts
    )
