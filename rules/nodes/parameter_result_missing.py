"""ND049: callbacks for parameters return a SetParametersResult."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Rule
from scaffold.model.nodes import NodeFacts
from scaffold.model.returns import is_generator, may_end, returned
from scaffold.model.scopes import FunctionNode

_RESULT = "rcl_interfaces.msg.SetParametersResult"
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


class ParameterResultMissing(Rule):
    """A callback for set parameters does not return a ``SetParametersResult`` that says yes or no.

    **Why.** ``AttributeError: 'NoneType' object has no attribute 'successful'`` as soon as a
    parameter is set or declared; a plain ``SetParametersResult()`` refuses every change.

    **Fix.** ``return SetParametersResult(successful=True)``, on every path.

    **Source.** ``rclpy/node.py``, ``_set_parameters_atomically``; ROS 2 documentation, "Monitoring
    for parameter changes".
    """

    code = "ND049"
    name = "parameter-result-missing"
    examples = (
        Example("a result", {"talker.py": _NODE.format("parameters", _RIGHT)}),
        Example(
            "nothing, a bool, a refusal",
            {
                "talker.py": _NODE.format(
                    "parameters",
                    "        if not parameters:\n            return True\n"
                    "        if parameters[0].name:\n"
                    "            return SetParametersResult()\n",
                )
            },
            at=("talker.py:10", "talker.py:12", "talker.py:14"),
        ),
        Example("no parameters", {"talker.py": _NODE.format("", _RIGHT)}, at=("talker.py:10",)),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for facts in package.rclpy_files():
            for attribute in facts.module.index.attributes("add_on_set_parameters_callback"):
                call = facts.module.parent(attribute)
                if not isinstance(call, ast.Call) or call.func is not attribute or not call.args:
                    continue
                callback = facts.callback(call.args[0])
                function = callback.function
                if callback.is_called or callback.is_partial or function is None:
                    continue
                if not isinstance(function, ast.Lambda) and not function.decorator_list:
                    yield from self._check(facts, function, is_bound=callback.is_bound)

    def _check(
        self, facts: NodeFacts, function: FunctionNode, *, is_bound: bool
    ) -> Iterator[Diagnostic]:
        module, arguments = facts.module, function.args
        count = len([*arguments.posonlyargs, *arguments.args]) - int(is_bound)
        if arguments.vararg is None and not count - len(arguments.defaults) <= 1 <= count:
            message = f"{function.name} takes {count} arguments; it is given the parameters"
            yield self.report(module.name_location(function), message)
        if is_generator(function):
            return
        if may_end(function):
            path = " on every path" if returned(function) else ""
            message = f"{function.name} does not return a SetParametersResult{path}: AttributeError"
            yield self.report(module.name_location(function), message)
        for statement in returned(function):
            wrong = _wrong(facts, statement.value)
            if wrong:
                yield self.report(module.location(statement), f"returns {wrong}")


def _wrong(facts: NodeFacts, value: ast.expr | None) -> str:
    """Return what is wrong about a returned value, else nothing."""
    if value is None:
        return "nothing, not a SetParametersResult: AttributeError"
    if isinstance(value, ast.Constant):
        return f"{value.value!r}, not a SetParametersResult: AttributeError"
    if isinstance(value, ast.List | ast.Tuple | ast.Dict):
        return f"a {type(value).__name__.lower()}, not one SetParametersResult: AttributeError"
    if facts.module.qualified_name(value) == _RESULT:
        return "the class SetParametersResult: make one with successful=True"
    if isinstance(value, ast.Call) and facts.module.qualified_name(value.func) == _RESULT:
        names = [word.arg for word in value.keywords]
        if "successful" not in names and None not in names and not value.args:
            return "a SetParametersResult without successful=True: every change is refused"
    return ""
