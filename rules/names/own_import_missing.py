"""NM041: what a package imports of itself is there."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from difflib import get_close_matches

from scaffold.api import Diagnostic, Example, Package, Rule, ViewError
from scaffold.model.cmake_facts import programs
from scaffold.model.known import ROS_PACKAGES
from scaffold.model.python_module import Import, PythonModule

_SETUP = (
    "from setuptools import setup\n\nsetup(\n    name='talker',\n    packages=['talker'],\n"
    "    entry_points={'console_scripts': ['node = talker.node:main']},\n)\n"
)
_FILES = {
    "setup.py": _SETUP,
    "talker/__init__.py": "",
    "talker/text.py": "def make():\n    pass\n",
}


class OwnImportMissing(Rule):
    """A module imports another one of its package by a name that it does not have.

    **Why.** ``ModuleNotFoundError: No module named 'text'`` or ``ImportError: cannot import name``
    when the node is started; only the package itself is on Python's path, not its directory.

    **Fix.** Write the full name: ``from talker.text import make``.

    **Source.** Python documentation, "The import system"; ROS 2 documentation, "Writing a simple
    publisher and subscriber (Python)".
    """

    code = "NM041"
    name = "own-import-missing"
    examples = (
        Example("full name", {**_FILES, "talker/node.py": "from talker.text import make\n"}),
        Example(
            "no such module",
            {**_FILES, "talker/node.py": "from talker.texts import make\n"},
            at=("talker/node.py:1",),
        ),
        Example(
            "no such function",
            {**_FILES, "talker/node.py": "from .text import makes\n"},
            at=("talker/node.py:1",),
        ),
        Example(
            "without the package, with its directory",
            {
                **_FILES,
                "talker/node.py": "from text import make\nfrom src.talker.text import make\n",
            },
            at=("talker/node.py:1", "talker/node.py:2"),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        roots = {path.partition("/")[0] for path in package.glob("*/__init__.py")}
        roots = {root for root in roots if root.isidentifier()}
        roots -= {"test", "tests", "launch"} | (ROS_PACKAGES - {package.name})
        made = package.has("CMakeLists.txt") and bool(
            package.cmake.find("rosidl_generate_interfaces", "generate_parameter_module")
        )
        for module in package.modules():
            if made or module.path == "setup.py":
                continue
            for one in module.imports:
                if one.guarded or one.conditional or one.type_checking:
                    continue
                yield from self._check(package, module, one, roots)

    def _check(
        self, package: Package, module: PythonModule, one: Import, roots: set[str]
    ) -> Iterator[Diagnostic]:
        name = _absolute(module, one)
        root = name.partition(".")[0]
        if root in roots and package.has(f"{root}/__init__.py"):
            path = _file_of(package, name)
            if not path:
                if not _is_made(package, name):
                    modules = [one for one in _modules(package, root) if "__init__" not in one]
                    near = get_close_matches(name, modules, 1, 0.6)
                    hint = f"; {near[0]!r} is meant" if near else ""
                    yield self.report(one, f"the package has no module {name!r}{hint}")
                return
            yield from self._check_names(package, one, name, path)
            return
        meant = "" if one.level else _meant(package, module, name)
        if meant:
            message = f"no module {name!r} is installed: ModuleNotFoundError; {meant!r} is meant"
            yield self.report(one, message)

    def _check_names(
        self, package: Package, one: Import, name: str, path: str
    ) -> Iterator[Diagnostic]:
        try:
            module = package.module(path)
        except ViewError:
            return
        for imported in one.names:
            if imported.name == "*" or module.defines(imported.name) is not False:
                continue
            below = f"{name}.{imported.name}"
            if _file_of(package, below) or _is_made(package, below):
                continue
            near = get_close_matches(imported.name, [*module.functions, *module.classes], 1)
            hint = f"; it has {near[0]!r}" if near else ""
            yield self.report(imported, f"{path} has no {imported.name!r}: ImportError{hint}")


def _absolute(module: PythonModule, one: Import) -> str:
    if not one.level:
        return one.module
    directory = module.path.split("/")[: -one.level]
    return ".".join([*directory, *([one.module] if one.module else [])])


def _file_of(package: Package, name: str) -> str:
    base = name.replace(".", "/")
    return next((one for one in (f"{base}.py", f"{base}/__init__.py") if package.has(one)), "")


def _is_made(package: Package, name: str) -> bool:
    """Tell whether a module may come from elsewhere: compiled, generated, a namespace."""
    base = name.replace(".", "/")
    if package.has_directory(base) or package.glob(f"{base}.*"):
        return True
    cmake = package.source("CMakeLists.txt").text if package.has("CMakeLists.txt") else ""
    last = name.rpartition(".")[2]
    if last in cmake or "pybind11" in cmake:
        return True
    return any(
        last in package.source(path).text
        for path in ("setup.py", ".gitignore")
        if package.has(path)
    )


def _modules(package: Package, root: str) -> list[str]:
    return [
        path.removesuffix(".py").replace("/", ".")
        for path in package.python_files
        if path.startswith(f"{root}/") and path.endswith(".py")
    ]


def _meant(package: Package, module: PythonModule, name: str) -> str:
    """Return the module of the package that a name means which is not on Python's path."""
    own = module.path.partition("/")[0]
    if module.path.count("/") != 1 or not package.has(f"{own}/__init__.py") or module.in_tests:
        return ""
    root, _, rest = name.partition(".")
    if root in ROS_PACKAGES or root in sys.stdlib_module_names:
        return ""
    if rest.startswith(f"{own}.") and not package.has_directory(root) and _file_of(package, rest):
        return rest if root == "src" else ""
    if package.build_type == "ament_python":
        return f"{own}.{name}" if _lacks_package(package, module, own, name) else ""
    installed = {one.path: one.destination for one in programs(package)}
    path = _file_of(package, f"{own}.{name}")
    if module.path in installed and path and path not in installed:
        others = [one for one in package.cmake.installs if one.kind == "FILES"]
        mended = "sys.path" in module.source.text or bool(others)
        return "" if mended else f"{own}.{name}"
    return ""


def _lacks_package(package: Package, module: PythonModule, own: str, name: str) -> bool:
    """Tell whether a module that an entry point starts imports without its package's name."""
    root = name.partition(".")[0]
    setup = package.setup_py
    started = {one.module for one in setup.console_scripts}
    if module.path.removesuffix(".py").replace("/", ".") not in started:
        return False
    if package.has_directory(root) or package.has(f"{root}.py"):
        return False
    mended = "sys.path" in module.source.text or "-packages" in setup.module.source.text
    return not mended and bool(_file_of(package, f"{own}.{name}"))
