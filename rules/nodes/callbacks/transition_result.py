"""ND066: lifecycle callbacks return the result of the transition."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Mapping
from difflib import get_close_matches

from scaffold.api import Diagnostic, Example, RclpyRule
from scaffold.api.programs import publish_calls
from scaffold.api.python import FunctionNode, is_generator, may_end, returned
from scaffold.api.rclpy import NodeClass, RclpyFile

_TRANSITIONS = (
    *("on_configure", "on_activate", "on_deactivate", "on_cleanup", "on_shutdown", "on_error"),
)
_NODE = (
    "from rclpy.lifecycle import LifecycleNode, TransitionCallbackReturn\n"
    "from std_msgs.msg import String\n\n\n"
    "class Talker(LifecycleNode):\n"
    "    def __init__(self):\n"
    "        super().__init__('talker')\n"
    "        self.pub = self.create_lifecycle_publisher(String, 'chatter', 10)\n\n"
    "    def {}:\n"
    "        {}\n"
)
_RIGHT = "return super().on_activate(state)"
_OWN_TRANSITIONS = ("on_configure", "on_activate", "on_deactivate", "on_cleanup")
"""Names that are only used for transition callbacks."""
_MIN_METHODS = 2
"""The minimum number of such methods in a class meant as a lifecycle node."""
_WITH_STATE = 2
"""Parameters of a transition callback: ``self`` and the state."""


class TransitionResult(RclpyRule):
    """A transition callback has a wrong name, signature or return value, or publishes too early.

    **Why.** The node fails with ``AttributeError: 'NoneType' object has no attribute 'to_label'``
    at the transition; a method with another name is never called; publishers of
    ``create_lifecycle_publisher`` drop all messages until ``super().on_activate`` is called.

    **Fix.** Accept the state, and ``return super().on_activate(state)``, or
    ``TransitionCallbackReturn.SUCCESS`` if there is no lifecycle publisher.

    **Source.** ``rclpy/lifecycle/node.py``, ``LifecycleNodeMixin``; ``managed_entity.py``.
    """

    code = "ND066"
    name = "transition-result"
    examples = (
        Example(
            "returns the result of super()",
            {"talker.py": _NODE.format("on_activate(self, state)", _RIGHT)},
        ),
        Example(
            "returns the result of another method",
            {
                "talker.py": _NODE.format("on_configure(self, state)", "return self.open()")
                + "\n    def open(self):\n        return True\n"
            },
            "11:9: returns True from open(), not a TransitionCallbackReturn: AttributeError at "
            "the transition",
        ),
        Example(
            "returns a wrong result of another method",
            {
                "talker.py": _NODE.format("on_configure(self, state)", "return self.open()")
                + "\n    def open(self):\n        return TransitionCallbackReturn.SUCCESS\n"
            },
        ),
        Example(
            "nothing",
            {"talker.py": _NODE.format("on_configure(self, state)", "self.count = 0")},
            "10:9: on_configure() returns nothing, not a TransitionCallbackReturn: AttributeError "
            "at the transition",
        ),
        Example(
            "the result of a comparison",
            {"talker.py": _NODE.format("on_activate(self, state)", f"{_RIGHT} is not None")},
            "11:9: returns a bool, not a TransitionCallbackReturn: AttributeError at the "
            "transition",
        ),
        Example(
            "a bool, no state",
            {"talker.py": _NODE.format("on_configure(self)", "return True")},
            "10:9: on_configure() takes 0 arguments, but gets the state: the transition fails",
            "11:9: returns True, not a TransitionCallbackReturn: AttributeError at the transition",
        ),
        Example(
            "a publisher that stays active",
            {
                "talker.py": _NODE.format(
                    "on_deactivate(self, state)", "return TransitionCallbackReturn.SUCCESS"
                )
            },
            "10:9: super().on_deactivate(state) is not called: the publisher of line 8 stays "
            "active",
        ),
        Example(
            "a publisher that stays inactive",
            {
                "talker.py": _NODE.format(
                    "on_activate(self, state)", "return TransitionCallbackReturn.SUCCESS"
                )
            },
            "10:9: super().on_activate(state) is not called: the publisher of line 8 stays "
            "inactive",
        ),
        Example(
            "published before the publisher is active",
            {
                "talker.py": _NODE.format(
                    "on_configure(self, state)",
                    "self.say()\n        return TransitionCallbackReturn.SUCCESS",
                )
                + "\n    def on_activate(self, state):\n"
                "        result = super().on_activate(state)\n"
                "        self.pub.publish(String())\n        return result\n\n"
                "    def say(self):\n        self.pub.publish(String())\n"
            },
            "20:9: the publisher of line 8 is not active yet: it drops this message; publish "
            "after super().on_activate(state)",
        ),
        Example(
            "another name",
            {"talker.py": _NODE.format("on_activated(self, state)", _RIGHT)},
            "10:9: rclpy never calls 'on_activated'; did you mean 'on_activate'?",
        ),
        Example(
            "a plain node",
            {
                "talker.py": "from rclpy.node import Node\n\n\n"
                "class Talker(Node):\n"
                "    def on_configure(self, state):\n        return True\n\n"
                "    def on_activate(self, state):\n        return True\n"
            },
            "5:9: Talker is a plain Node: rclpy never calls 'on_configure', and there are no "
            "transitions; inherit from rclpy.lifecycle.LifecycleNode",
        ),
        Example(
            "nothing on one path",
            {
                "talker.py": _NODE.format(
                    "on_activate(self, state)", f"if self.pub:\n            {_RIGHT}"
                )
            },
            "10:9: on_activate() returns nothing on one path, not a TransitionCallbackReturn: "
            "AttributeError at the transition",
        ),
    )

    def check_file(self, file: RclpyFile) -> Iterator[Diagnostic]:
        for class_ in file.classes:
            if not class_.is_lifecycle:
                yield from self._check_plain(file, class_)
            else:
                for name, function in class_.methods.items():
                    if function.decorator_list or is_generator(function):
                        continue
                    if name in _TRANSITIONS:
                        yield from self._check(file, function)
                    elif name.startswith("on_") and not file.module.index.attributes(name):
                        yield from self._check_name(file, function, class_.methods)
                yield from self._check_publishers(file, class_)
                for call, problem in _published_inactive(file, class_):
                    yield self.report(file.module.location(call), problem)

    def _check_plain(self, file: RclpyFile, class_: NodeClass) -> Iterator[Diagnostic]:
        """Check a node without a lifecycle: rclpy never calls its transition callbacks."""
        methods = [class_.methods[name] for name in _OWN_TRANSITIONS if name in class_.methods]
        if len(methods) < _MIN_METHODS or class_.base is not None or len(class_.node.bases) != 1:
            return
        if any(
            not ast.unparse(use).startswith("super().")
            for method in methods
            for use in file.module.index.attributes(method.name)
        ):
            return
        if all(len([*x.args.posonlyargs, *x.args.args]) == _WITH_STATE for x in methods):
            message = (
                f"{class_.name} is a plain Node: rclpy never calls {methods[0].name!r}, and there "
                "are no transitions; inherit from rclpy.lifecycle.LifecycleNode"
            )
            yield self.report(file.module.name_location(methods[0]), message)

    def _check(self, file: RclpyFile, function: FunctionNode) -> Iterator[Diagnostic]:
        module, given = file.module, function.args
        count = len([*given.posonlyargs, *given.args]) - 1
        at = module.name_location(function)
        if given.vararg is None and not count - len(given.defaults) <= 1 <= count:
            message = f"{function.name}() takes {count} arguments, but gets the state: "
            yield self.report(at, message + "the transition fails")
        happens = "not a TransitionCallbackReturn: AttributeError at the transition"
        if may_end(function):
            path = " on one path" if returned(function) else ""
            yield self.report(at, f"{function.name}() returns nothing{path}, {happens}")
        for statement in returned(function):
            source, value = "", "nothing"
            if isinstance(statement.value, ast.Call):
                name, value = _result_of(file, statement.value)
                source = f" from {name}()"
            elif statement.value is not None:
                value = _plain(statement.value)
            if value:
                message = f"returns {value}{source}, {happens}"
                yield self.report(module.location(statement), message)

    def _check_name(
        self, file: RclpyFile, function: FunctionNode, methods: Mapping[str, FunctionNode]
    ) -> Iterator[Diagnostic]:
        left = [name for name in _TRANSITIONS if name not in methods]
        for closest in get_close_matches(function.name, left, 1, 0.85):
            message = f"rclpy never calls {function.name!r}; did you mean {closest!r}?"
            yield self.report(file.module.name_location(function), message)

    def _check_publishers(self, file: RclpyFile, class_: NodeClass) -> Iterator[Diagnostic]:
        publishers = [x for x in class_.publishers if x.is_lifecycle]
        for name, state in (("on_activate", "inactive"), ("on_deactivate", "active")):
            function = class_.methods.get(name)
            if function is None or not publishers or file.module.index.attributes(name):
                continue
            if "destroy" in file.module.text(function) or function.decorator_list:
                continue
            line = publishers[0].location.line
            message = (
                f"super().{name}(state) is not called: the publisher of line {line} stays {state}"
            )
            yield self.report(file.module.name_location(function), message)


def _published_inactive(file: RclpyFile, class_: NodeClass) -> Iterator[tuple[ast.Call, str]]:
    """Yield messages that the inactive publisher drops: before ``super().on_activate()``."""
    activating = class_.methods.get("on_activate")
    supers = [
        call
        for call in (() if activating is None else file.calls_in(activating))
        if isinstance(call.func, ast.Attribute) and call.func.attr == "on_activate"
    ]
    if len(supers) != len(file.module.index.attributes("on_activate")):
        return  # publishers may be activated one by one
    configuring = class_.methods.get("on_configure")
    early = [] if configuring is None else file.reached(configuring)
    for publisher in class_.publishers:
        for call in publish_calls(file, publisher) or () if publisher.is_lifecycle else ():
            function = file.function_of(call)
            is_early = function in early and not file.is_conditional(call)
            if function is activating and supers:
                is_early = call.lineno < supers[0].lineno
            if is_early:
                line = publisher.location.line
                problem = f"the publisher of line {line} is not active yet: it drops this message; "
                yield call, problem + "publish after super().on_activate(state)"


def _result_of(file: RclpyFile, call: ast.Call) -> tuple[str, str]:
    """Return the name and the constant result of a function of the file; empty if not known."""
    function = file.callback(call.func).function
    if not isinstance(function, ast.FunctionDef) or function.decorator_list:
        return "", ""
    values = [statement.value for statement in returned(function)]
    if may_end(function) or is_generator(function) or not values:
        return "", ""
    texts = [_plain(value) if value is not None else "" for value in values]
    return function.name, " or ".join(dict.fromkeys(texts)) if all(texts) else ""


def _plain(value: ast.expr) -> str:
    """Describe a constant, or the bool of a comparison; empty for other values."""
    if isinstance(value, ast.Constant):
        return ast.unparse(value)
    is_bool = isinstance(value, ast.Compare) or (
        isinstance(value, ast.UnaryOp) and isinstance(value.op, ast.Not)
    )
    return "a bool" if is_bool else ""
