"""ND130: callbacks of subscriptions have a signature that Python can inspect."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, PythonRule
from scaffold.api.distributions import target
from scaffold.api.python import PythonModule, argument_of
from scaffold.api.rclpy import RclpyFile

_NODE = (
    "from collections import deque\n\nfrom rclpy.node import Node\nfrom std_msgs.msg import String"
    "\n\n\nclass Listener(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('listener')\n"
    "        self.heard = {}\n"
    "        self.create_subscription(String, 'chatter', {}, 10)\n"
)


class CallbackWithoutSignature(PythonRule):
    """The callback of a subscription is a method of a deque or set, which has no Python signature.

    **Why.** Since Jazzy, rclpy inspects the signature of the callback; before Python 3.13,
    ``deque.append`` has none: ``ValueError: no signature found for builtin``.

    **Fix.** Pass ``lambda msg: self.heard.append(msg)``. No automatic fix: the attribute may be
    another object later.

    **Source.** ``rclpy/subscription.py``, ``Subscription.callback``; ``inspect.signature``.
    """

    code = "ND130"
    name = "callback-without-signature"
    since = "0.2"
    examples = (
        Example("a list", {"listener.py": _NODE.format("[]", "self.heard.append")}),
        Example(
            "a function",
            {"listener.py": _NODE.format("deque()", "lambda msg: self.heard.append(msg)")},
        ),
        Example(
            "a distribution that does not inspect signatures",
            {"listener.py": _NODE.format("deque()", "self.heard.append")},
            distro="humble",
        ),
        Example(
            "a Python version with the signature",
            {"listener.py": _NODE.format("deque()", "self.heard.append")},
            distro="lyrical",
        ),
        Example(
            "a node of a class",
            {
                "test_listener.py": "from collections import deque\nimport unittest\n\n"
                "from rclpy.node import Node\nfrom std_msgs.msg import String\n\n\n"
                "class TestListener(unittest.TestCase):\n"
                "    @classmethod\n"
                "    def setUpClass(cls):\n"
                "        cls.node = Node('listener')\n"
                "        cls.heard = deque(maxlen=4)\n"
                "        cls.node.create_subscription(String, 'chatter', cls.heard.append, 10)\n"
            },
            "13:57: 'collections.deque.append' has no signature in Python 3.12: rclpy raises "
            "ValueError; pass lambda msg: cls.heard.append(msg)",
        ),
        Example(
            "a deque",
            {"listener.py": _NODE.format("deque()", "self.heard.append")},
            "11:53: 'collections.deque.append' has no signature in Python 3.12: rclpy raises "
            "ValueError; pass lambda msg: self.heard.append(msg)",
        ),
    )

    def check_file(self, module: PythonModule) -> Iterator[Diagnostic]:
        unknown = target().fact("callbacks.without_signature")
        if not unknown or not module.mentions("create_subscription"):
            return
        if not module.mentions(*{name.rpartition(".")[2] for name in unknown}):
            return
        file = RclpyFile(module)
        if not file.uses_rclpy:
            return
        for callback in _callbacks(file):
            method = _method(file, callback)
            if method in unknown:
                text = module.text(callback)
                message = (
                    f"'{method}' has no signature in Python {target().python_version}: rclpy "
                    f"raises ValueError; pass lambda msg: {text}(msg)"
                )
                yield self.report(module.location(callback), message)


def _callbacks(file: RclpyFile) -> Iterator[ast.expr]:
    """Yield the callbacks of subscriptions of any node."""
    for call, _ in file.module.method_calls("create_subscription"):
        callback = argument_of(call, "callback", 2)
        if callback is not None:
            yield callback


def _method(file: RclpyFile, node: ast.expr) -> str:
    """Return the full name of a method of an object created in the file: ``set.add``."""
    if not isinstance(node, ast.Attribute):
        return ""
    kinds = {_kind(file, value) for value in _values(file, node.value)}
    return f"{kinds.pop()}.{node.attr}" if len(kinds) == 1 else ""


def _values(file: RclpyFile, node: ast.expr) -> list[ast.expr]:
    """Return the values assigned to a name, or to an attribute of ``self`` or ``cls``."""
    if not isinstance(node, ast.Attribute) or not isinstance(node.value, ast.Name):
        value = file.evaluator.single_value(node)
        return [value] if isinstance(value, ast.expr) else []
    return [
        statement.value
        for statement in file.module.walk(ast.Assign)
        for target_ in statement.targets
        if isinstance(target_, ast.Attribute)
        and target_.attr == node.attr
        and file.module.text(target_.value) in {"self", "cls"}
    ]


def _kind(file: RclpyFile, value: ast.expr) -> str:
    if isinstance(value, ast.Set):
        return "set"
    if not isinstance(value, ast.Call):
        return ""
    plain = value.func.id if isinstance(value.func, ast.Name) else ""
    return file.module.qualified_name(value.func) or plain
