"""TS050: tests can import helpers in their directory."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Rule
from scaffold.api.python import Import, PythonModule
from scaffold.api.tests import settings_or_tests_mention, test_modules

_PATHS = ("import-mode", "importmode", "pythonpath", "sys.path", "rootdir", "site.addsitedir")
_TEST = "{}\n\n\ndef test_make():\n    assert make()\n"
_HELPER = {"test/helpers.py": "def make():\n    return 1\n"}


class TestImportFails(Rule):
    """A test imports a helper in its directory in a way that fails under pytest.

    **Why.** pytest stops with ``ImportError: attempted relative import with no known parent
    package`` in a directory without ``__init__.py``, with ``No module named 'helpers'`` in a
    directory with one, and with ``No module named 'test.helpers'`` because ``test`` is a package of
    the standard library.

    **Fix.** Write ``from helpers import ...`` without an ``__init__.py`` in the directory, or
    ``from .helpers import ...`` with one.

    **Source.** pytest documentation, "pytest import mechanisms and sys.path/PYTHONPATH".
    """

    code = "TS050"
    name = "test-import-fails"
    examples = (
        Example(
            "found",
            {"setup.py": "", "test/test_a.py": _TEST.format("from helpers import make"), **_HELPER},
        ),
        Example(
            "a relative import, and an import from test",
            {
                "setup.py": "",
                "test/test_a.py": _TEST.format("from .helpers import make"),
                "test/test_b.py": _TEST.format("from test.helpers import make"),
                **_HELPER,
            },
            "test/test_a.py:1:1: the relative import fails: test/ has no __init__.py",
            "test/test_b.py:1:1: test is a package of the standard library: ModuleNotFoundError; "
            "write `from helpers import ...`",
        ),
        Example(
            "the directory is a package",
            {
                "setup.py": "",
                "test/__init__.py": "",
                "test/test_a.py": _TEST.format("from helpers import make"),
                **_HELPER,
            },
            "test/test_a.py:1:1: test/ is a package: ModuleNotFoundError; write `from .helpers "
            "import ...`",
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        if settings_or_tests_mention(package, _PATHS):
            return
        for module in test_modules(package):
            directory = module.path.rpartition("/")[0]
            if directory in {"test", "tests"}:
                for item in module.imports:
                    problem = _problem(package, module, directory, item)
                    if problem and not (item.guarded or item.conditional or item.in_function):
                        yield self.report(item, problem)


def _problem(package: Package, module: PythonModule, directory: str, node: Import) -> str:
    is_package = package.has(f"{directory}/__init__.py")
    if node.level == 1 and not is_package:
        return f"the relative import fails: {directory}/ has no __init__.py"
    first, _, rest = node.module.partition(".")
    helper = rest.partition(".")[0] or (node.names[0].name if node.names else "")
    if node.level == 0 and first == "test" == directory and not is_package:
        if package.has(f"test/{helper}.py"):
            return (
                f"test is a package of the standard library: ModuleNotFoundError; write `from "
                f"{helper} import ...`"
            )
    elif node.level == 0 and is_package and package.has(f"{directory}/{first}.py"):
        is_elsewhere = package.has(f"{first}.py") or package.has(f"{first}/__init__.py")
        if not is_elsewhere and first != module.path.rpartition("/")[2][:-3]:
            return (
                f"{directory}/ is a package: ModuleNotFoundError; write `from .{first} import ...`"
            )
    return ""
