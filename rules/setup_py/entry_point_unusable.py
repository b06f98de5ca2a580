"""SP053: entry points are functions that can be called without arguments."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Location, Package, Report, Rule, ViewError, fact
from scaffold.api.rclpy import rclpy_file
from scaffold.api.setup_py import EntryPoint

_SETUP = (
    "from setuptools import setup\n\nsetup(\n    name='talker',\n    packages=['talker'],\n"
    "    entry_points={{'console_scripts': ['node = {}:main']}},\n)\n"
)
_FILES = {"talker/__init__.py": "", "talker/node.py": "def main(args=None):\n    pass\n"}


class EntryPointUnusable(Rule):
    """An entry point names a module by another path, or a function that needs arguments.

    **Why.** The script that setuptools makes imports the module by its full name and calls the
    function without arguments: ``ModuleNotFoundError: No module named 'node'``, ``TypeError: main()
    missing 1 required positional argument``.

    **Fix.** ``name = package.module:function``, and ``def main(args=None):``.

    **Source.** setuptools documentation, "Entry points".
    """

    code = "SP053"
    name = "entry-point-unusable"
    examples = (
        Example("full name", {"setup.py": _SETUP.format("talker.node"), **_FILES}),
        Example(
            "without the package",
            {"setup.py": _SETUP.format("node"), **_FILES},
            Report("setup.py:6:39", "no module 'node' is installed; closest: 'talker.node'"),
        ),
        Example(
            "another package",
            {"setup.py": _SETUP.format("my_package.node"), **_FILES},
            Report(
                "setup.py:6:39", "no module 'my_package.node' is installed; closest: 'talker.node'"
            ),
        ),
        Example(
            "an argument",
            {
                "setup.py": _SETUP.format("talker.node"),
                **_FILES,
                "talker/node.py": "def main(args):\n    pass\n",
            },
            Report(
                "talker/node.py:1:5",
                "the entry point 'node' of setup.py calls main() without arguments: "
                "TypeError; give args a default",
            ),
        ),
        Example(
            "a node class",
            {
                "setup.py": _SETUP.format("talker.node").replace(":main", ":Talker"),
                **_FILES,
                "talker/node.py": "from rclpy.node import Node\n\n\n"
                "class Talker(Node):\n    pass\n",
            },
            Report(
                "setup.py:6:39", "Talker is a node class: a program needs a function that spins it"
            ),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        setup = package.setup_py
        if setup.keyword("package_dir") is not None or setup.keyword("py_modules") is not None:
            return
        for entry in setup.console_scripts:
            if entry.malformed or not entry.function:
                continue
            path = _file_of(package, entry.module)
            if path:
                yield from self._check_function(package, entry, path)
                continue
            closest = _closest_module(package, entry.module)
            if closest:
                message = f"no module {entry.module!r} is installed; closest: {closest!r}"
                yield self.report(entry, message)

    def _check_function(
        self, package: Package, entry: EntryPoint, path: str
    ) -> Iterator[Diagnostic]:
        try:
            at, required, is_node_class = _function(package, path, str(entry.function))
        except ViewError:
            return
        if required:
            message = (
                f"the entry point {entry.name!r} of setup.py calls {entry.function}() without "
                f"arguments: TypeError; give {required} a default"
            )
            yield self.report(at, message)
        if is_node_class:
            message = f"{entry.function} is a node class: a program needs a function that spins it"
            yield self.report(entry, message)


@fact
def _function(package: Package, path: str, name: str) -> tuple[Location, str, bool]:
    """Return the place of a function, a parameter that it needs, and whether it is a node class.

    Raises ViewError.
    """
    function = package.module(path).functions.get(name)
    if function is None or function.node.decorator_list:
        classes = rclpy_file(package, path).classes
        return package.start_of(path), "", any(node.name == name for node in classes)
    arguments = function.node.args
    positional = [*arguments.posonlyargs, *arguments.args]
    count = len(positional) - len(arguments.defaults)
    return function.location, positional[0].arg if count else "", False


def _file_of(package: Package, name: str) -> str:
    base = name.replace(".", "/")
    return next((item for item in (f"{base}.py", f"{base}/__init__.py") if package.has(item)), "")


def _closest_module(package: Package, name: str) -> str:
    """Return the module of the package that a name without its package means."""
    first, _, rest = name.partition(".")
    if package.has_directory(first):
        return ""
    for root in package.glob("*/__init__.py"):
        own = root.partition("/")[0]
        for item in (f"{own}.{name}", f"{own}.{rest}" if rest else ""):
            if item and _file_of(package, item):
                return item
    return ""
