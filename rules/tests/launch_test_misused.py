"""TS048: launch_testing tests have a ReadyToTest action, a mark and tests."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Rule, listed_names
from scaffold.api.python import (
    FunctionNode,
    PythonModule,
    is_generator,
    may_end,
    paths_importing,
    returned,
)
from scaffold.api.tests import LAUNCH, is_test_case, marks, may_start, methods

_GIVEN = frozenset({"launch_service", "proc_info", "proc_output", "test_args"})
"""Arguments that launch_testing itself has for tests."""
_MARKS = ("launch_test", "rostest")
_TEST = (
    "import unittest\n\nfrom launch import LaunchDescription\nimport launch_testing.actions\n"
    "import pytest\n\n\n{}"
    "def generate_test_description():\n"
    "    {} LaunchDescription([{}])\n\n\n"
    "class TestTalker({}):\n    def test_all(self):\n        assert True\n"
)
_RIGHT = (
    "@pytest.mark.launch_test\n",
    "return",
    "launch_testing.actions.ReadyToTest()",
    "unittest.TestCase",
)
_OTHER = _TEST.format("", *_RIGHT[1:3], "object")

_AFTER = "launch_testing.post_shutdown_test"


class LaunchTestMisused(Rule):
    """A launch_testing test never becomes ready, runs without its nodes, or contains no tests.

    **Why.** launch_testing stops: ``generate_test_description functions must return a
    LaunchDescription containing a ReadyToTest action``. Without the mark, pytest runs the tests of
    an ament_python package, but does not start the nodes. Classes that are not a ``TestCase`` are
    not run at all.

    **Fix.** Add ``launch_testing.actions.ReadyToTest()`` to the list; ``@pytest.mark.launch_test``;
    ``class TestTalker(unittest.TestCase)``.

    **Source.** ``launch_testing/loader.py``, ``launch_testing/pytest/hooks.py``.
    """

    code = "TS048"
    name = "launch-test-misused"
    examples = (
        Example("a valid test", {"setup.py": "", "test/test_talker.py": _TEST.format(*_RIGHT)}),
        Example(
            "an argument of the description, of launch_testing, and of nobody",
            {
                "setup.py": "",
                "test/test_talker.py": _TEST.format(*_RIGHT)
                .replace("ReadyToTest()])", "ReadyToTest()]), {'talker': 1}")
                .replace("(self)", "(self, talker, proc_output, talkr)"),
            },
            "test/test_talker.py:14:45: launch_testing gives no 'talkr' to a test; there are "
            "launch_service, proc_info, proc_output, talker, test_args",
        ),
        Example(
            "arguments that another function may offer",
            {
                "setup.py": "",
                "test/test_talker.py": _TEST.format(*_RIGHT)
                .replace("return LaunchDescription([", "return describe([")
                .replace("(self)", "(self, talkr)"),
            },
        ),
        Example("for launch_pytest", {"test/test_a.py": "import launch_pytest\n" + _OTHER}),
        Example(
            "never ready, and without any import of launch_testing",
            {
                "setup.py": "",
                "test/test_a.py": "import unittest\n\nfrom launch import LaunchDescription\n"
                "import pytest\n\n\n@pytest.mark.launch_test\n"
                "def generate_test_description():\n    return LaunchDescription([])\n\n\n"
                "class TestA(unittest.TestCase):\n    def test_a(self):\n        assert True\n",
                "launch/b.launch.py": "from launch import LaunchDescription\n\n\n"
                "def generate_test_description():\n    return LaunchDescription([])\n",
            },
            "test/test_a.py:8:5: generate_test_description has no ReadyToTest() in its list: "
            "launch_testing rejects it",
        ),
        Example(
            "never ready",
            {"setup.py": "", "test/test_talker.py": _TEST.format(*_RIGHT[:2], "", _RIGHT[3])},
            "test/test_talker.py:9:5: generate_test_description has no ReadyToTest() in its list: "
            "launch_testing rejects it",
        ),
        Example(
            "no mark",
            {"setup.py": "", "test/test_talker.py": _TEST.format("", *_RIGHT[1:])},
            "test/test_talker.py:8:5: @pytest.mark.launch_test is missing: pytest does not start "
            "the nodes of generate_test_description",
        ),
        Example(
            "nothing returned, no TestCase",
            {"setup.py": "", "test/test_talker.py": _TEST.format("", "", _RIGHT[2], "object")},
            "test/test_talker.py:8:5: generate_test_description returns nothing: launch_testing "
            "needs a LaunchDescription",
            "test/test_talker.py:12:7: TestTalker is not a TestCase: launch_testing does not run "
            "it; inherit from unittest.TestCase",
        ),
        Example(
            "a decorator that is not called",
            {
                "setup.py": "",
                "test/test_talker.py": _TEST.format(*_RIGHT)
                + "\n\n@launch_testing.post_shutdown_test\nclass TestEnd(unittest.TestCase):\n"
                "    pass\n\n\n@launch_testing.post_shutdown_test()\n"
                "class TestLater(unittest.TestCase):\n    pass\n",
            },
            "test/test_talker.py:18:2: post_shutdown_test is not called: TypeError; add ()",
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for module in package.modules(paths_importing(package, "launch_testing", "launch")):
            function = module.functions.get(LAUNCH)
            roots = module.imports_by_root
            if function is None or "launch_pytest" in roots:
                continue
            if "launch_testing" not in roots and not _is_marked(module, function.node):
                continue
            for problem in _problems(package, module):
                yield self.report(function, problem)
            for class_ in module.classes.values():
                has_tests = any(method.name.startswith("test") for method in methods(class_.node))
                plain = not class_.node.bases or module.qualified_names(class_.node.bases[0]) == {
                    "object"
                }
                for decorator in class_.node.decorator_list:
                    if module.qualified_name(decorator) == _AFTER:
                        message = "post_shutdown_test is not called: TypeError; add ()"
                        yield self.report(module.location(decorator), message)
                if is_test_case(module, class_.node):
                    yield from self._check_arguments(module, class_.node)
                if has_tests and plain and not module.index.names(class_.name):
                    message = (
                        f"{class_.name} is not a TestCase: launch_testing does not run it; "
                        f"inherit from unittest.TestCase"
                    )
                    yield self.report(class_, message)

    def _check_arguments(self, module: PythonModule, class_: ast.ClassDef) -> Iterator[Diagnostic]:
        """Report arguments of tests that nothing gives."""
        offered = _offered(module.functions[LAUNCH].node)
        for method in methods(class_) if offered is not None else ():
            count = len(method.args.args) - len(method.args.defaults)
            if not method.name.startswith("test") or method.decorator_list:
                continue
            for argument in method.args.args[1:count]:
                if offered is not None and argument.arg not in offered | _GIVEN:
                    names = listed_names(offered | _GIVEN, argument.arg, "nothing")
                    message = (
                        f"launch_testing gives no {argument.arg!r} to a test; there are {names}"
                    )
                    yield self.report(module.location(argument), message)


def _offered(node: FunctionNode) -> frozenset[str] | None:
    """Return the arguments for tests that the launch description comes with; else ``None``."""
    names = {argument.arg for argument in (*node.args.args, *node.args.kwonlyargs)}
    values = [statement.value for statement in returned(node)]
    if is_generator(node) or not values or node.args.kwarg is not None:
        return None
    for value in values:
        match value:
            case ast.Call(func=ast.Name(id=called) | ast.Attribute(attr=called)) if (
                called == "LaunchDescription"
            ):
                pass
            case ast.Tuple(elts=[_, ast.Dict(keys=keys)]):
                texts = [key.value for key in keys if isinstance(key, ast.Constant)]
                if len(texts) < len(keys):
                    return None
                names.update(map(str, texts))
            case _:
                return None
    return frozenset(names)


def _is_marked(module: PythonModule, node: FunctionNode) -> bool:
    return any(mark in _MARKS for mark, _ in marks(module, node))


def _problems(package: Package, module: PythonModule) -> Iterator[str]:
    """Yield the problems with the function that returns the launch description."""
    node = module.functions[LAUNCH].node
    arguments = {arg.arg for arg in node.args.args}
    if not is_generator(node) and not returned(node) and may_end(node):
        yield f"{LAUNCH} returns nothing: launch_testing needs a LaunchDescription"
    elif not (
        "ReadyToTest" in module.source.text
        or "ready_fn" in arguments
        or _calls_others(module, node)
    ):
        yield f"{LAUNCH} has no ReadyToTest() in its list: launch_testing rejects it"
    tests = any(is_test_case(module, class_.node) for class_ in module.classes.values())
    name = module.path.rpartition("/")[2]
    by_pytest = package.has("setup.py") and not package.has("CMakeLists.txt")
    collected = name.startswith("test_") or name.endswith("_test.py")
    marked = _is_marked(module, node)
    if by_pytest and collected and tests and not marked and not may_start(package, name):
        yield f"@pytest.mark.launch_test is missing: pytest does not start the nodes of {LAUNCH}"


def _calls_others(module: PythonModule, node: ast.AST) -> bool:
    """Return whether a function of this or an unknown package may add actions."""
    for call in ast.walk(node):
        if isinstance(call, ast.Call):
            name = module.qualified_name(call.func) or ""
            if not name.startswith(("launch.", "launch_ros.", "launch_testing.", "os.", "ament_")):
                return True
    return False
