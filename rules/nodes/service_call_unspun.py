"""ND043: blocking service calls run while another thread spins the node."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Report, Rule, fact
from scaffold.api.programs import Waits, in_callbacks, in_constructors, waits_alone, waits_in
from scaffold.api.rclpy import RclpyFile

_CODE = (
    "import rclpy\nfrom std_srvs.srv import Trigger\n\n\n"
    "def main():\n"
    "    rclpy.init()\n"
    "    node = rclpy.create_node('caller')\n"
    "    client = node.create_client(Trigger, 'reset')\n"
    "    client.wait_for_service(timeout_sec=5.0)\n"
    "    {}\n"
)
_FUTURE = (
    "future = client.call_async(Trigger.Request())\n"
    "    rclpy.spin_until_future_complete(node, future)"
)
_FILES = {
    "package.xml": "<package><name>demo</name>"
    "<export><build_type>ament_python</build_type></export></package>\n",
    "setup.py": "from setuptools import setup\n\nsetup(name='demo', packages=['demo'],\n"
    "      entry_points={'console_scripts': ['caller = demo.caller:main']})\n",
}


class ServiceCallUnspun(Rule):
    """``client.call()`` blocks the only thread, while nothing spins the node.

    **Why.** Responses are received only while the node is spun: without a second thread, the
    program hangs at the call forever. ND058 reports this in callbacks and constructors.

    **Fix.** Use ``call_async`` and ``rclpy.spin_until_future_complete``.

    **Source.** ROS 2 documentation, "Synchronous vs. asynchronous service clients".
    """

    code = "ND043"
    name = "service-call-unspun"
    examples = (
        Example("asynchronous", {**_FILES, "demo/caller.py": _CODE.format(_FUTURE)}),
        Example(
            "never spun",
            {**_FILES, "demo/caller.py": _CODE.format("client.call(Trigger.Request())")},
            Report(
                "demo/caller.py:10:5",
                "call() never returns: the thread that would receive the response "
                "is blocked in this call",
            ),
        ),
        Example(
            "spun in a thread",
            {
                **_FILES,
                "demo/caller.py": "import threading\n"
                + _CODE.format(
                    "threading.Thread(target=rclpy.spin, args=(node,)).start()\n"
                    "    client.call(Trigger.Request())"
                ),
            },
        ),
        Example(
            "a thread that does not spin",
            {
                **_FILES,
                "demo/caller.py": "import threading\n"
                + _CODE.format(
                    "threading.Thread(target=print).start()\n    client.call(Trigger.Request())"
                ),
            },
            Report(
                "demo/caller.py:12:5",
                "call() never returns: the thread that would receive the response "
                "is blocked in this call",
            ),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for at, where in waits_alone(package, "call", _calls):
            message = f"call() never returns: the thread that would receive the response {where}"
            yield self.report(at, message)


@fact
def _calls(package: Package, path: str, function: str | None) -> Waits:
    return waits_in(package, (path, function), "call", _is_call)


def _is_call(file: RclpyFile, call: ast.Call) -> bool:
    if len(call.args) != 1 or call.keywords or not isinstance(call.func, ast.Attribute):
        return False
    client = file.evaluator.single_value(call.func.value)
    if not any(x.call is client and x.owner is not None for x in file.clients):
        return False
    inside = (*in_callbacks(file), *in_constructors(file))
    return file.function_of(call) not in {executed.function for executed in inside}
