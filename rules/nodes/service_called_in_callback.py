"""ND043: a service is not waited for in the thread that would hear the answer."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Rule
from scaffold.model.nodes import NodeFacts
from scaffold.model.single_thread import waits_alone

_NODE = (
    "import rclpy\nfrom rclpy.node import Node\nfrom std_srvs.srv import Trigger\n\n\n"
    "class Caller(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('caller')\n"
    "        self.client = self.create_client(Trigger, 'reset')\n"
    "        self.create_timer(1.0, self.tick)\n\n"
    "    def tick(self):\n"
    "        self.client.{}(Trigger.Request())\n\n\n"
    "def main():\n"
    "    rclpy.init()\n"
    "    rclpy.spin(Caller())\n"
)
_FILES = {
    "package.xml": "<package><name>demo</name>"
    "<export><build_type>ament_python</build_type></export></package>\n",
    "setup.py": "from setuptools import setup\n\nsetup(name='demo', packages=['demo'],\n"
    "      entry_points={'console_scripts': ['caller = demo.caller:main']})\n",
}


class ServiceCalledInCallback(Rule):
    """``client.call()`` waits for an answer that only the waiting thread could take.

    **Why.** The answer is taken while the node is spun: in a callback, or before ``rclpy.spin``,
    the program stands still at the call, for ever.

    **Fix.** Use ``call_async`` and ``add_done_callback``, or ``await`` in an ``async`` callback.

    **Source.** ROS 2 documentation, "Synchronous vs. asynchronous service clients".
    """

    code = "ND043"
    name = "service-called-in-callback"
    examples = (
        Example("asynchronous", {**_FILES, "demo/caller.py": _NODE.format("call_async")}),
        Example(
            "in a timer",
            {**_FILES, "demo/caller.py": _NODE.format("call")},
            at=("demo/caller.py:13",),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for facts, call, where in waits_alone(package, "call", _is_call):
            message = f"this call never ends: the thread that would take the answer {where}"
            yield self.report(facts.module.location(call), message)


def _is_call(facts: NodeFacts, call: ast.Call) -> bool:
    if len(call.args) != 1 or call.keywords or not isinstance(call.func, ast.Attribute):
        return False
    client = facts.evaluator.single_value(call.func.value)
    return any(one.call is client and one.owner is not None for one in facts.clients)
