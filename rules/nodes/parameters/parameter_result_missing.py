"""ND049: parameter callbacks return a SetParametersResult."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, RclpyRule
from scaffold.api.python import FunctionNode, is_generator, may_end_with_items, returned
from scaffold.api.rclpy import CALLBACKS, Callback, RclpyFile

from ._callback_results import wrong_value

_ON, _POST, _PRE = CALLBACKS
_NODE = (
    "from rcl_interfaces.msg import SetParametersResult\nfrom rclpy.node import Node\n\n\n"
    "class Talker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('talker')\n"
    "        self.add_on_set_parameters_callback(self.on_set)\n\n"
    "    def on_set(self, {}):\n"
    "{}"
)
_RIGHT = "        return SetParametersResult(successful=True)\n"
_VARIABLE = "        result = SetParametersResult()\n{}        return result\n"
_MIXED = (
    "        if not parameters:\n            return True\n"
    "        if parameters[0].name:\n            return SetParametersResult()\n"
)


class ParameterResultMissing(RclpyRule):
    """A parameter callback does not return a ``SetParametersResult`` with ``successful`` set.

    **Why.** ``Callback returned an invalid type``: every change is rejected, and a parameter that
    is declared later ends the node; a plain ``SetParametersResult()`` rejects every change too. A
    pre-set callback must return the list of parameters.

    **Fix.** ``return SetParametersResult(successful=True)``, on every path.

    **Source.** ``rclpy/node.py``, ``_set_parameters_atomically``; ROS 2 documentation, "Monitoring
    for parameter changes".
    """

    code = "ND049"
    name = "parameter-result-missing"
    examples = (
        Example("a result", {"talker.py": _NODE.format("parameters", _RIGHT)}),
        Example(
            "returned in a loop",
            {"talker.py": _NODE.format("a", "        for b in a:\n    " + _RIGHT)},
        ),
        Example(
            "set afterwards",
            {
                "talker.py": _NODE.format(
                    "parameters", _VARIABLE.format("        result.successful = True\n")
                )
            },
        ),
        Example(
            "nothing, a bool, a rejection",
            {"talker.py": _NODE.format("parameters", _MIXED)},
            "10:9: on_set() does not return a SetParametersResult on every path",
            "12:13: returns True, not a SetParametersResult: every change is rejected",
            "14:13: returns a SetParametersResult without successful=True: every change is "
            "rejected",
        ),
        Example(
            "a return without a value; the class",
            {
                "early.py": _NODE.format(
                    "parameters", "        if not parameters:\n            return\n" + _RIGHT
                ),
                "late.py": _NODE.format("parameters", "        return SetParametersResult\n"),
            },
            "early.py:12:13: returns nothing, not a SetParametersResult: every change is rejected",
            "late.py:11:9: returns the class SetParametersResult; instantiate it with "
            "successful=True",
        ),
        Example(
            "a result, and nothing, instead of the list of a pre-set callback",
            {
                "early.py": _NODE.replace("add_on_set", "add_pre_set").format("parameters", _RIGHT),
                "late.py": _NODE.replace("add_on_set", "add_pre_set").format(
                    "parameters", "        return None\n"
                ),
            },
            "early.py:11:9: returns a SetParametersResult, not the list of parameters: TypeError",
            "late.py:11:9: returns nothing, not the list of parameters to set: TypeError",
        ),
        Example(
            "a bool that a method returns",
            {
                "talker.py": _NODE.format(
                    "parameters", "        return self.accept(parameters)\n\n"
                )
                + "    def accept(self, parameters):\n"
                "        if not parameters:\n            return False\n        return True\n"
            },
            "11:9: returns the result of self.accept(), which is True or False, not a "
            "SetParametersResult: every change is rejected",
        ),
        Example(
            "never set",
            {"talker.py": _NODE.format("parameters", _VARIABLE.format(""))},
            "12:9: returns a SetParametersResult without successful=True: every change is rejected",
        ),
        Example(
            "no argument",
            {"talker.py": _NODE.format("", _RIGHT)},
            "10:9: on_set() takes 0 arguments, but gets 1, the parameters: TypeError",
        ),
        Example(
            "a lambda, a coroutine, a generator",
            {
                "quick.py": _NODE.replace("self.on_set)", "lambda parameters: True)").format(
                    "parameters", _RIGHT
                ),
                "waiting.py": _NODE.replace("def on", "async def on").format("parameters", _RIGHT),
                "yielding.py": _NODE.format("parameters", _RIGHT.replace("return", "yield")),
            },
            "quick.py:8:64: returns True, not a SetParametersResult: every change is rejected",
            "waiting.py:10:15: on_set() is a coroutine: it does not return a SetParametersResult",
            "yielding.py:10:9: on_set() is a generator: it does not return a SetParametersResult",
        ),
        Example(
            "the return value of a method",
            {
                "live.py": "from rcl_interfaces.msg import SetParametersResult\n"
                "from rclpy.node import Node\n\n\n"
                "class Live(Node):\n"
                "    def __init__(self):\n"
                "        super().__init__('live')\n"
                "        self.add_on_set_parameters_callback(self.take)\n\n"
                "    def answer(self):\n"
                "        return SetParametersResult()\n\n"
                "    def take(self, changed):\n"
                "        self.changed = changed\n"
                "        return self.answer()\n"
            },
            "15:9: returns a SetParametersResult without successful=True: every change is rejected",
        ),
    )

    def check_file(self, file: RclpyFile) -> Iterator[Diagnostic]:
        for call, method in file.module.method_calls(*CALLBACKS):
            if call.args:
                yield from self._check(file, file.callback(call.args[0]), method.attr)

    def _check(self, file: RclpyFile, callback: Callback, method: str) -> Iterator[Diagnostic]:
        function = callback.function
        if function is None or callback.is_partial or callback.is_called:
            return
        if isinstance(function, ast.Lambda):
            problem = wrong_value(method, file, function.body) if method != _POST else ""
            if problem:
                yield self.report(file.module.location(function.body), f"returns {problem}")
        elif not function.decorator_list:
            yield from self._check_function(file, function, method, is_bound=callback.is_bound)

    def _check_function(
        self, file: RclpyFile, function: FunctionNode, method: str, *, is_bound: bool
    ) -> Iterator[Diagnostic]:
        module, arguments = file.module, function.args
        wanted = "the list of parameters" if method == _PRE else "a SetParametersResult"
        count = len([*arguments.posonlyargs, *arguments.args]) - int(is_bound)
        if arguments.vararg is None and not count - len(arguments.defaults) <= 1 <= count:
            message = (
                f"{function.name}() takes {count} arguments, but gets 1, the parameters: TypeError"
            )
            yield self.report(module.name_location(function), message)
        if method == _POST:
            return
        if is_generator(function) or isinstance(function, ast.AsyncFunctionDef):
            word = "a generator" if is_generator(function) else "a coroutine"
            message = f"{function.name}() is {word}: it does not return {wanted}"
            yield self.report(module.name_location(function), message)
            return
        if may_end_with_items(function):
            path = " on every path" if returned(function) else ""
            message = f"{function.name}() does not return {wanted}{path}"
            yield self.report(module.name_location(function), message)
        for statement in returned(function):
            problem = wrong_value(method, file, statement.value)
            if problem:
                yield self.report(module.location(statement), f"returns {problem}")
