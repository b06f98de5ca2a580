"""SP055: every node has an entry point."""

from __future__ import annotations

import re
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Report, Rule, Severity, ViewError, fact
from scaffold.api.install import absolute_name
from scaffold.api.launch import launch_files
from scaffold.api.python import imports_by_path
from scaffold.api.rclpy import rclpy_file, rclpy_paths
from scaffold.api.setup_py import SetupPy

_SETUP = (
    "from setuptools import setup\n\nsetup(\n    name='talker',\n    packages=['talker'],\n"
    "    entry_points={{'console_scripts': [\n        'node = talker.node:main',\n{}    ]}},\n)\n"
)
_NODE = (
    "import rclpy\nfrom rclpy.node import Node\n\n\nclass Talker(Node):\n    pass\n\n\n"
    "def main():\n    rclpy.init()\n\n\nif __name__ == '__main__':\n    main()\n"
)
_FILES = {
    "talker/__init__.py": "",
    "talker/node.py": _NODE,
    "talker/other.py": _NODE.replace("Talker", "Listener"),
}
_TEXTS = (".md", ".rst", ".sh")


class NodeWithoutEntryPoint(Rule):
    """A module with a node and a ``main`` is in no entry point.

    **Why.** ``ros2 run`` fails with ``No executable found``.

    **Fix.** Add ``'other = talker.other:main'`` to ``console_scripts``.

    **Source.** ROS 2 documentation, "Writing a simple publisher and subscriber (Python)", entry
    points.
    """

    code = "SP055"
    name = "node-without-entry-point"
    other_severities = {Severity.WARNING: "no launch file or document mentions it"}
    examples = (
        Example(
            "both nodes have entry points",
            {"setup.py": _SETUP.format("        'other = talker.other:main',\n"), **_FILES},
        ),
        Example(
            "a copy, kept next to the node",
            {
                "setup.py": _SETUP.format(""),
                **_FILES,
                "talker/other.py": "",
                "talker/node_old.py": _NODE,
            },
        ),
        Example(
            "a node without an entry point",
            {"setup.py": _SETUP.format(""), **_FILES},
            Report(
                "setup.py:6:18",
                "talker/other.py is a node with a main function, but no entry point "
                "starts it; add 'other = talker.other:main'",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "a node that the README starts",
            {
                "setup.py": _SETUP.format(""),
                **_FILES,
                "README.md": "Run it:\n\n    ros2 run talker other\n",
            },
            "setup.py:6:18: talker/other.py is a node with a main function, but no entry point "
            "starts it; add 'other = talker.other:main'",
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        setup = package.setup_py
        keyword = setup.keyword("entry_points")
        if keyword is None or not _is_complete(package, setup):
            return
        started = {entry.module for entry in setup.entry_points}
        used = _names_imported(package)
        copied = _started_classes(package, started)
        for path, classes, is_program in _nodes(package):
            name = path.removesuffix(".py").replace("/", ".")
            if name in started or name in used or not classes or not is_program:
                continue
            if copied.issuperset(classes) or not _is_module(name):
                continue
            root = path.partition("/")[0]
            if path.count("/") == 1 and root in {item.partition(".")[0] for item in started}:
                stem = path.rpartition("/")[2].removesuffix(".py")
                message = (
                    f"{path} is a node with a main function, but no entry point starts it; "
                    f"add '{stem} = {name}:main'"
                )
                severity = Severity.ERROR if _is_named(package, stem) else Severity.WARNING
                cause = f"nodes without entry points: {severity.value}"
                yield self.report(keyword, message, severity=severity, cause=cause)


def _nodes(package: Package) -> Iterator[tuple[str, tuple[str, ...], bool]]:
    """Yield the files that use rclpy, each with its node classes and whether it is a program."""
    for path in rclpy_paths(package):
        try:
            yield path, *_node_classes(package, path)
        except ViewError:
            continue


@fact
def _node_classes(package: Package, path: str) -> tuple[tuple[str, ...], bool]:
    file = rclpy_file(package, path)
    is_program = file.module.has_main_guard and "main" in file.module.functions
    return tuple(node.name for node in file.classes), is_program


def _is_named(package: Package, program: str) -> bool:
    """Return whether a launch file or a text of the package starts a program."""
    texts = [path for path in package.files if path.endswith(_TEXTS)]
    for path in {*texts, *launch_files(package)}:
        try:
            text = package.source(path).text
        except ViewError:
            continue
        if program in text and re.search(rf"(?<![\w./]){program}(?![\w./])", text):
            return True
    return False


def _is_module(name: str) -> bool:
    """Return whether Python can import a file: not ``node.sync-conflict-1.py``."""
    return all(part.isidentifier() for part in name.split("."))


def _started_classes(package: Package, started: set[str]) -> set[str]:
    """Return the names of the nodes of entry points; others of the same name are copies."""
    return {
        name
        for path, classes, _ in _nodes(package)
        if path.removesuffix(".py").replace("/", ".") in started
        for name in classes
    }


def _is_complete(package: Package, setup: SetupPy) -> bool:
    """Return whether all entry points are known, and there are no other programs."""
    if not setup.entry_points_complete or setup.has_unknown_keywords or setup.keyword("scripts"):
        return False
    if package.build_type != "ament_python" or any(
        point.malformed or point.joined for point in setup.entry_points
    ):
        return False
    return not any(str(data.destination).startswith("lib") for data in setup.data_files)


def _names_imported(package: Package) -> set[str]:
    """Return the full names imported by modules of the package: modules and names in them."""
    result: set[str] = set()
    for path, imports in imports_by_path(package):
        for item in imports:
            base = absolute_name(path, item)
            result |= {base, *(f"{base}.{name.name}" for name in item.names)}
    return result
