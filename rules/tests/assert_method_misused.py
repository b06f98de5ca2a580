"""TS071: assert methods of a TestCase exist, and compare their arguments."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Edit, Example, Fix, Report, Severity, TestRule
from scaffold.api.distributions import target
from scaffold.api.python import PythonModule
from scaffold.api.tests import is_test_case, methods

_REMOVED_IN = (3, 12)
_RENAMED = {
    "assertEquals": "assertEqual",
    "assertNotEquals": "assertNotEqual",
    "assertAlmostEquals": "assertAlmostEqual",
    "assertNotAlmostEquals": "assertNotAlmostEqual",
    "assertRegexpMatches": "assertRegex",
    "assertNotRegexpMatches": "assertNotRegex",
    "assertRaisesRegexp": "assertRaisesRegex",
    "assert_": "assertTrue",
    "failUnless": "assertTrue",
    "failUnlessEqual": "assertEqual",
    "failUnlessAlmostEqual": "assertAlmostEqual",
    "failUnlessRaises": "assertRaises",
    "failIf": "assertFalse",
    "failIfEqual": "assertNotEqual",
    "failIfAlmostEqual": "assertNotAlmostEqual",
}
"""Methods removed in Python 3.12, with their replacements."""
_WITHOUT_NAME = {"assertDictContainsSubset": "assertLessEqual(part.items(), whole.items())"}
"""Methods removed in Python 3.12 without a new name, with the current form."""
_OF_PYTHON2 = {"assertItemsEqual": "assertCountEqual"}
_TEST = (
    "import unittest\n\n\nclass TestText(unittest.TestCase):\n"
    "    def test_text(self):\n        self.{}('a'.upper(), 'A')\n"
)


class AssertMethodMisused(TestRule):
    """A test calls an assert method that does not exist, or that does not compare its arguments.

    **Why.** ``AttributeError: 'TestText' object has no attribute 'assertEquals'``. Python 3.12
    removed the old names, which are deprecated in Python 3.10 of Humble. ``assertTrue(a, b)`` uses
    ``b`` as the message: the test passes with any ``b``.

    **Fix.** Use ``assertEqual``.

    **Source.** Python documentation, ``unittest``, and "What's New In Python 3.12".
    """

    code = "TS071"
    name = "assert-method-misused"
    is_fixed_for_all = True
    other_severities = {
        Severity.WARNING: "``assertTrue(a, True)`` tests what it should",
        Severity.INFO: "the method is only deprecated on the distribution",
    }
    examples = (
        Example("compared", {"test/test_text.py": _TEST.format("assertEqual")}),
        Example(
            "removed",
            {"test/test_text.py": _TEST.format("assertEquals")},
            Report(
                "6:9",
                "assertEquals was removed in Python 3.12: AttributeError; use assertEqual",
                fix="Replace with assertEqual",
            ),
            fixed={"test/test_text.py": _TEST.format("assertEqual")},
        ),
        Example(
            "deprecated",
            {"test/test_text.py": _TEST.format("failUnlessEqual")},
            Report(
                "6:9",
                "failUnlessEqual is deprecated, and removed in Python 3.12; use assertEqual",
                fix="Replace with assertEqual",
                severity=Severity.INFO,
            ),
            fixed={"test/test_text.py": _TEST.format("assertEqual")},
            distro="humble",
        ),
        Example(
            "removed, without a replacement that has the same arguments",
            {"test/test_text.py": _TEST.format("assertDictContainsSubset")},
            "6:9: assertDictContainsSubset was removed in Python 3.12: AttributeError; use "
            "assertLessEqual(part.items(), whole.items())",
        ),
        Example(
            "a method of Python 2",
            {"test/test_text.py": _TEST.format("assertItemsEqual")},
            Report(
                "6:9",
                "assertItemsEqual does not exist in Python 3: AttributeError; use assertCountEqual",
                fix="Replace with assertCountEqual",
            ),
            fixed={"test/test_text.py": _TEST.format("assertCountEqual")},
            distro="humble",
        ),
        Example(
            "a method of the class",
            {
                "test/test_text.py": _TEST.format("assertItemsEqual")
                + "\n    def assertItemsEqual(self, first, second):\n"
                "        self.assertEqual(sorted(first), sorted(second))\n"
            },
        ),
        Example(
            "a frame that is not compared",
            {
                "test/test_frame.py": _TEST.format("assertEqual")
                + "        self.assertTrue(self.got.header.frame_id, 'map')\n"
                "        self.assertTrue(self.got.header.frame_id, 'frame is empty')\n"
            },
            "7:9: assertTrue only checks the first argument, the second is a message; use "
            "assertEqual",
        ),
        Example(
            "not compared",
            {"test/test_text.py": _TEST.format("assertTrue").replace("'A'", "['A']")},
            "6:9: assertTrue only checks the first argument, the second is a message; use "
            "assertEqual",
        ),
        Example(
            "compared with the value that the method expects anyway, and with another one",
            {
                "test/test_text.py": _TEST.format("assertTrue").replace("'A'", "True")
                + "        self.assertTrue('a'.isupper(), False)\n"
            },
            Report(
                "6:9",
                "assertTrue only checks the first argument, the second is a message; use "
                "assertEqual",
                severity=Severity.WARNING,
            ),
            "7:9: assertTrue only checks the first argument, the second is a message; use "
            "assertEqual",
        ),
        Example(
            "the function for assertRaises, called and passed",
            {
                "test/test_text.py": "import pytest\n\n\ndef test_number():\n"
                "    pytest.raises(ValueError, int('a'))\n"
                "    pytest.raises(ValueError, int, 'a')\n"
            },
            "5:31: int() is called before raises(): the test fails; pass int itself",
        ),
    )

    def check_file(self, module: PythonModule) -> Iterator[Diagnostic]:
        for call in module.walk(ast.Call):
            match call:
                case ast.Call(
                    func=ast.Attribute(attr="raises" | "assertRaises" as name),
                    args=[_, ast.Call(func=ast.Name() | ast.Attribute() as func) as made, *_],
                ) if not _makes_function(module, func):
                    called = module.text(func)
                    message = f"{called}() is called before {name}(): the test fails"
                    yield self.report(module.location(made), f"{message}; pass {called} itself")
        for class_ in module.classes.values():
            if is_test_case(module, class_.node):
                yield from self._check_calls(module, class_.node)

    def _check_calls(self, module: PythonModule, class_: ast.ClassDef) -> Iterator[Diagnostic]:
        own = {method.name for method in methods(class_)}
        for node in ast.walk(class_):
            match node:
                case ast.Call(func=ast.Attribute(value=ast.Name(id="self"), attr=name) as method):
                    if name in (_RENAMED | _WITHOUT_NAME | _OF_PYTHON2) and name not in own:
                        yield self._old_name(module, method)
                    elif name in {"assertTrue", "assertFalse"} and _compares(node.args):
                        message = (
                            f"{name} only checks the first argument, the second is a message; use "
                            f"assertEqual"
                        )
                        is_meant = getattr(node.args[1], "value", None) is (name == "assertTrue")
                        severity = Severity.WARNING if is_meant else None
                        yield self.report(module.location(method), message, severity=severity)

    def _old_name(self, module: PythonModule, method: ast.Attribute) -> Diagnostic:
        name, severity = method.attr, None
        use = (_RENAMED | _WITHOUT_NAME | _OF_PYTHON2)[name]
        if name in _OF_PYTHON2:
            message = f"{name} does not exist in Python 3: AttributeError"
        elif target().python >= _REMOVED_IN:
            message = f"{name} was removed in Python 3.12: AttributeError"
        else:
            message = f"{name} is deprecated, and removed in Python 3.12"
            severity = Severity.INFO
        fix = None
        if name not in _WITHOUT_NAME:
            _, end = module.span(method)
            edit = Edit(module.source.path, end - len(name), end, use)
            fix = Fix(f"Replace with {use}", (edit,))
        return self.report(module.location(method), f"{message}; use {use}", fix, severity=severity)


def _makes_function(module: PythonModule, func: ast.expr) -> bool:
    """Return whether a call may return a function: ``partial(drive, -1.0)``."""
    name = module.text(func).rpartition(".")[2]
    return name in {"partial", "methodcaller", "itemgetter", "attrgetter"} or any(
        isinstance(node, ast.Lambda | ast.FunctionDef) and node is not function
        for function in module.function_nodes
        if function.name == name
        for node in ast.walk(function)
    )


_TEXT_FIELDS = frozenset({"frame_id", "child_frame_id"})
"""Fields of messages that are compared with a name, not tested for being set."""


def _compares(given: list[ast.expr]) -> bool:
    """Return whether a second argument is certainly a value to compare with, not a message."""
    if len(given) != 2:  # noqa: PLR2004  a value and a message
        return False
    first, second = given
    if isinstance(second, ast.Constant) and not isinstance(second.value, str):
        return second.value is not None
    if isinstance(first, ast.Attribute) and first.attr in _TEXT_FIELDS:
        return isinstance(second, ast.Constant) and " " not in str(second.value)
    return isinstance(second, ast.List | ast.Dict | ast.Tuple) or (
        isinstance(first, ast.Constant) and isinstance(first.value, str)
    )
