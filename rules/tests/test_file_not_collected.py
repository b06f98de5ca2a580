"""TS003: pytest collects every test file."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Rule, Severity, ViewError
from scaffold.api.python import PythonModule

DIRECTORIES = ("test/", "tests/")


class TestFileNotCollected(Rule):
    """A file with tests has a name that pytest does not collect.

    **Why.** ``colcon test`` passes, but these tests never run.

    **Fix.** Name it ``test_*.py``. No automatic fix: CMakeLists.txt may refer to it.

    **Source.** pytest documentation, "Conventions for Python test discovery".
    """

    code = "TS003"
    name = "test-file-not-collected"
    severity = Severity.WARNING
    examples = (
        Example(
            "collected, and a helper without tests",
            {
                "setup.py": "",
                "test/test_talker.py": "def test_talk():\n    pass\n",
                "test/helpers.py": "def make():\n    pass\n",
            },
        ),
        Example(
            "files that a test copies, to run pytest on them",
            {
                "setup.py": "",
                "test/examples/talking.py": "def test_talk():\n    pass\n",
                "test/test_plugin.py": "def test_examples(pytester):\n"
                "    pytester.copy_example('examples')\n",
            },
        ),
        Example(
            "a name that pytest does not collect",
            {"setup.py": "", "test/talker_tests.py": "def test_talk():\n    pass\n"},
            "test/talker_tests.py:1:1: test_talk() never runs: pytest only collects test_*.py and "
            "*_test.py; rename the file",
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        if not package.has("setup.py"):
            return
        for path in package.python_files:
            name = path.rpartition("/")[2]
            if not path.startswith(DIRECTORIES) or name == "conftest.py":
                continue
            if re.fullmatch(r"test_.*\.py|.*_test\.py", name) or self._is_used(package, path):
                continue
            try:
                functions = package.module(path).functions
            except ViewError:
                continue
            tests = [function for function in functions if function.startswith("test_")]
            if tests:
                message = (
                    f"{tests[0]}() never runs: pytest only collects test_*.py and "
                    f"*_test.py; rename the file"
                )
                yield self.report(package.start_of(path), message)

    def _is_used(self, package: Package, path: str) -> bool:
        """Return whether another test runs the file: imports it, or refers to its directory."""
        stem = path.rpartition("/")[2][:-3]
        return any(
            any(
                stem in [*imported.module.split("."), *(name.name for name in imported.names)]
                for imported in module.imports
            )
            or _names_directory(module, path)
            for module in package.modules()
        )


def _names_directory(module: PythonModule, path: str) -> bool:
    """Return whether a test names a directory next to it that a file is in."""
    above = f"{module.path.rpartition('/')[0]}/"
    if not module.path.startswith(DIRECTORIES) or not path.startswith(above):
        return False
    inside = path.removeprefix(above).split("/")[:-1]
    return any(node.value in inside for node in module.walk(ast.Constant)) if inside else False
