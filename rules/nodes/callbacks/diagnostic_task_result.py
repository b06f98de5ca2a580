"""ND131: tasks of the diagnostic updater return their status."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, PythonRule
from scaffold.api.python import PythonModule, is_generator, may_end, returned
from scaffold.api.rclpy import RclpyFile, rclpy_file

_NODE = (
    "from diagnostic_msgs.msg import DiagnosticStatus\nfrom diagnostic_updater import Updater\n"
    "from rclpy.node import Node\n\n\n"
    "class Wheels(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('wheels')\n"
    "        self.updater = Updater(self)\n"
    "        self.updater.add('wheels', self.check)\n\n"
    "    def check(self, stat):\n"
    "        stat.summary(DiagnosticStatus.OK, 'turns')\n"
    "        {}\n"
)
_TASK = (
    "from diagnostic_updater import DiagnosticTask\n\n\n"
    "class Check(DiagnosticTask):\n"
    "    def run(self, stat):\n"
    "        if stat.name:\n            return stat\n"
    "        stat.add('name', 'none')\n"
)


class DiagnosticTaskResult(PythonRule):
    """A task of the diagnostic updater does not return its status.

    **Why.** The updater publishes what the task returns: ``AttributeError: 'NoneType' object has
    no attribute 'name'``, and the node ends at the first update.

    **Fix.** ``return stat``, on every path.

    **Source.** ``diagnostic_updater/_diagnostic_updater.py``, ``Updater.force_update``.
    """

    code = "ND131"
    name = "diagnostic-task-result"
    examples = (
        Example("returned", {"wheels.py": _NODE.format("return stat")}),
        Example("returned by another function", {"wheels.py": _NODE.format("return print(stat)")}),
        Example(
            "not returned",
            {"wheels.py": _NODE.format("stat.add('count', '4')")},
            "12:9: check() does not return its status: AttributeError; return it",
        ),
        Example(
            "not on every path",
            {"check.py": _TASK},
            "5:9: run() does not return its status on every path: AttributeError; return it",
        ),
    )

    def check_in(self, package: Package, module: PythonModule) -> Iterator[Diagnostic]:
        if "diagnostic_updater" not in module.imports_by_root:
            return
        file = rclpy_file(package, module.path)
        for function in dict.fromkeys([*_functions(file), *_methods(module)]):
            if function.decorator_list or is_generator(function) or not may_end(function):
                continue
            path = " on every path" if returned(function) else ""
            message = (
                f"{function.name}() does not return its status{path}: AttributeError; return it"
            )
            yield self.report(module.name_location(function), message)


def _functions(file: RclpyFile) -> Iterator[ast.FunctionDef]:
    """Yield the functions that are added to an updater as tasks."""
    for call in file.module.walk(ast.Call):
        match call:
            case ast.Call(func=ast.Attribute(attr="add", value=updater), args=[_, given]):
                made = file.evaluator.single_value(updater)
                names = file.module.qualified_names(made.func) if isinstance(made, ast.Call) else ()
                is_task = any(name.startswith("diagnostic_updater.") for name in names)
            case ast.Call(args=[_, given]):
                names = file.module.qualified_names(call.func)
                is_task = "diagnostic_updater.FunctionDiagnosticTask" in names
            case _:
                continue
        function = file.callback(given).function if is_task else None
        if isinstance(function, ast.FunctionDef):
            yield function


def _methods(module: PythonModule) -> Iterator[ast.FunctionDef]:
    """Yield the ``run`` methods of task classes."""
    for class_ in module.walk(ast.ClassDef):
        names = {name for base in class_.bases for name in module.qualified_names(base)}
        for method in class_.body if "diagnostic_updater.DiagnosticTask" in names else ():
            if isinstance(method, ast.FunctionDef) and method.name == "run":
                yield method
