"""ND087: parameters are set as a list of parameters."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, RclpyRule, Report
from scaffold.api.rclpy import PARAMETER, RclpyFile, class_of

_METHODS = ("set_parameters", "set_parameters_atomically")
_NODE = (
    "from rclpy.node import Node\nfrom rclpy.parameter import Parameter\n\n\n"
    "class Talker(Node):\n"
    "    def on_timer(self):\n"
    "        self.set_parameters({})\n"
)


class ParametersSetWrongly(RclpyRule):
    """``set_parameters`` gets a value that is not a list of parameters.

    **Why.** ``TypeError: 'Parameter' object is not iterable``, or ``TypeError: parameter must be
    instance of type '<class 'rclpy.parameter.Parameter'>'``.

    **Fix.** ``self.set_parameters([Parameter('rate', value=2.0)])``.

    **Source.** ``rclpy/node.py``, ``set_parameters``.
    """

    code = "ND087"
    name = "parameters-set-wrongly"
    examples = (
        Example("a list", {"talker.py": _NODE.format("[Parameter('rate', value=2.0)]")}),
        Example(
            "a parameter",
            {"talker.py": _NODE.format("Parameter('rate', value=2.0)")},
            Report("7:29", "set_parameters() takes a list: TypeError; write [Parameter(...)]"),
        ),
        Example(
            "a dictionary",
            {"talker.py": _NODE.format("{'rate': 2.0}")},
            Report("7:29", "set_parameters() takes a list: TypeError; write [Parameter(...)]"),
        ),
        Example(
            "pairs",
            {"talker.py": _NODE.format("[('rate', 2.0)]")},
            Report("7:30", "not a Parameter: TypeError; write Parameter('name', value=...)"),
        ),
    )

    def check_file(self, file: RclpyFile) -> Iterator[Diagnostic]:
        for method in _METHODS:
            for attribute in file.module.index.attributes(method):
                call = file.module.parent(attribute)
                if not isinstance(call, ast.Call) or call.func is not attribute:
                    continue
                if call.args and file.owner_of(attribute.value) is not None:
                    for node, problem in _problems(file, call.args[0]):
                        yield self.report(file.module.location(node), problem)


def _problems(file: RclpyFile, given: ast.expr) -> Iterator[tuple[ast.AST, str]]:
    if class_of(file, given) == PARAMETER or isinstance(given, ast.Dict):
        yield given, "set_parameters() takes a list: TypeError; write [Parameter(...)]"
    for item in given.elts if isinstance(given, ast.List | ast.Tuple) else ():
        if isinstance(item, ast.Tuple | ast.Dict | ast.Constant):
            yield item, "not a Parameter: TypeError; write Parameter('name', value=...)"
