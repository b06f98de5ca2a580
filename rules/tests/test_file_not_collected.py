"""TS003: pytest collects every test file."""

from __future__ import annotations

import re
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Report, Rule, Severity, ViewError

DIRECTORIES = ("test/", "tests/")


class TestFileNotCollected(Rule):
    """A file with tests has a name that pytest does not collect.

    **Why.** ``colcon test`` passes and says nothing: these tests never run.

    **Fix.** Name it ``test_*.py``. No automatic fix: a CMakeLists.txt may name it.

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
            "a name that pytest passes over",
            {"setup.py": "", "test/talker_tests.py": "def test_talk():\n    pass\n"},
            Report(
                "test/talker_tests.py:1:1",
                "test_talk() never runs: pytest collects test_*.py and *_test.py only",
            ),
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
                message = f"{tests[0]}() never runs: pytest collects test_*.py and *_test.py only"
                yield self.report(package.start_of(path), message)

    def _is_used(self, package: Package, path: str) -> bool:
        """Tell whether another test imports the file: then it is a helper."""
        stem = path.rpartition("/")[2][:-3]
        return any(
            stem in [*imported.module.split("."), *(name.name for name in imported.names)]
            for module in package.modules()
            for imported in module.imports
        )
