"""ND043: rates and blocking service calls wait only while another thread spins the node."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Rule, fact
from scaffold.api.programs import Waits, in_callbacks, in_constructors, waits_alone, waits_in
from scaffold.api.rclpy import RclpyFile

_NODE = (
    "import threading\n\nimport rclpy\n\n\n"
    "def main():\n"
    "    rclpy.init()\n"
    "    node = rclpy.create_node('talker')\n"
    "{}"
    "    rate = node.create_rate(10)\n"
    "    while rclpy.ok():\n"
    "        rate.sleep()\n"
)
_THREAD = "    threading.Thread(target=rclpy.spin, args=(node,), daemon=True).start()\n"
_FILES = {
    "package.xml": "<package><name>demo</name>"
    "<export><build_type>ament_python</build_type></export></package>\n",
    "setup.py": "from setuptools import setup\n\nsetup(name='demo', packages=['demo'],\n"
    "      entry_points={'console_scripts': ['talker = demo.talker:main']})\n",
}
_ALONE = _NODE.format("").replace("import threading\n\n", "")
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
_FILES_CALLS = {
    "package.xml": "<package><name>demo</name>"
    "<export><build_type>ament_python</build_type></export></package>\n",
    "setup.py": "from setuptools import setup\n\nsetup(name='demo', packages=['demo'],\n"
    "      entry_points={'console_scripts': ['caller = demo.caller:main']})\n",
}

_WITHOUT_TIMEOUT = {("spin_once", 1), ("executor.spin_once", 0)}
"""Calls that run one callback, with their number of arguments."""


class WaitsUnspun(Rule):
    """``rate.sleep()`` or ``client.call()`` waits, but no other thread spins the node.

    **Why.** A rate is woken by a timer of the node, and timers and responses are only processed
    while the node is spun: without a second thread, the program hangs forever. ND058 reports calls
    in callbacks and constructors.

    **Fix.** Move the body of the loop into a timer callback, use ``call_async`` and
    ``rclpy.spin_until_future_complete``, or spin the node in a separate thread.

    **Source.** ``rclpy/timer.py``, ``Rate.sleep``; rclpy issue 443; ROS 2 documentation,
    "Synchronous vs. asynchronous service clients".
    """

    code = "ND043"
    name = "waits-unspun"
    examples = (
        Example("a rate, spun in a thread", {**_FILES, "demo/talker.py": _NODE.format(_THREAD)}),
        Example(
            "a rate, never spun",
            {**_FILES, "demo/talker.py": _ALONE},
            "demo/talker.py:9:9: sleep() never returns: the thread that would wake it is blocked "
            "in this call",
        ),
        Example(
            "a rate whose timer is run in the loop",
            {
                **_FILES,
                "demo/talker.py": _ALONE.replace(
                    "        rate", "        rclpy.spin_once(node)\n        rate"
                ),
            },
        ),
        Example(
            "a rate, after a function that loops until rclpy is shut down",
            {
                **_FILES,
                "demo/talker.py": "import rclpy\n\n\n"
                "def work():\n    while rclpy.ok():\n        print('work')\n\n\n"
                "def main():\n    rclpy.init()\n    node = rclpy.create_node('talker')\n"
                "    rate = node.create_rate(2)\n    work()\n    rate.sleep()\n",
            },
        ),
        Example(
            "a rate, and a thread that does not spin",
            {
                **_FILES,
                "demo/talker.py": _NODE.format(
                    "    threading.Thread(target=print, args=(node,)).start()\n"
                    "    process_group = [node]\n"
                ),
            },
            "demo/talker.py:13:9: sleep() never returns: the thread that would wake it is blocked "
            "in this call",
        ),
        Example("an asynchronous call", {**_FILES_CALLS, "demo/caller.py": _CODE.format(_FUTURE)}),
        Example(
            "a call before other responses are waited for",
            {
                **_FILES_CALLS,
                "demo/caller.py": "import rclpy\nfrom rclpy.node import Node\n"
                "from std_srvs.srv import Trigger\n\n\n"
                "class Caller(Node):\n"
                "    def __init__(self):\n"
                "        super().__init__('caller')\n"
                "        self.client = self.create_client(Trigger, 'reset')\n\n"
                "    def run(self):\n"
                "        self.client.call(Trigger.Request())\n"
                "        future = self.client.call_async(Trigger.Request())\n"
                "        rclpy.spin_until_future_complete(self, future)\n\n\n"
                "def main():\n"
                "    rclpy.init()\n"
                "    Caller().run()\n",
            },
            "demo/caller.py:12:9: call() never returns: the thread that would receive the "
            "response is blocked in this call",
        ),
        Example(
            "a call while another thread waits for responses",
            {
                **_FILES_CALLS,
                "demo/caller.py": "import threading\n\nimport rclpy\nfrom rclpy.node import Node\n"
                "from std_srvs.srv import Trigger\n\n\n"
                "class Caller(Node):\n"
                "    def __init__(self):\n"
                "        super().__init__('caller')\n"
                "        self.client = self.create_client(Trigger, 'reset')\n\n"
                "    def turn(self):\n"
                "        while rclpy.ok():\n"
                "            rclpy.spin_once(self)\n\n\n"
                "def main():\n"
                "    rclpy.init()\n"
                "    caller = Caller()\n"
                "    threading.Thread(target=caller.turn, daemon=True).start()\n"
                "    caller.client.call(Trigger.Request())\n",
            },
        ),
        Example(
            "a call, never spun",
            {**_FILES_CALLS, "demo/caller.py": _CODE.format("client.call(Trigger.Request())")},
            "demo/caller.py:10:5: call() never returns: the thread that would receive the "
            "response is blocked in this call",
        ),
        Example(
            "a call, spun in a thread",
            {
                **_FILES_CALLS,
                "demo/caller.py": "import threading\n"
                + _CODE.format(
                    "threading.Thread(target=rclpy.spin, args=(node,)).start()\n"
                    "    client.call(Trigger.Request())"
                ),
            },
        ),
        Example(
            "a call, and a thread that does not spin",
            {
                **_FILES_CALLS,
                "demo/caller.py": "import threading\n"
                + _CODE.format(
                    "threading.Thread(target=print).start()\n    client.call(Trigger.Request())"
                ),
            },
            "demo/caller.py:12:5: call() never returns: the thread that would receive the "
            "response is blocked in this call",
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        yield from self._check_rates(package)
        yield from self._check_calls(package)

    def _check_rates(self, package: Package) -> Iterator[Diagnostic]:
        for at, where in waits_alone(package, "sleep", _sleeps):
            yield self.report(at, f"sleep() never returns: the thread that would wake it {where}")

    def _check_calls(self, package: Package) -> Iterator[Diagnostic]:
        for at, where in waits_alone(package, "call", _calls):
            message = f"call() never returns: the thread that would receive the response {where}"
            yield self.report(at, message)


@fact
def _sleeps(package: Package, path: str, function: str | None) -> Waits:
    return waits_in(package, (path, function), "sleep", _is_sleep)


def _is_sleep(file: RclpyFile, call: ast.Call) -> bool:
    value = call.func.value if isinstance(call.func, ast.Attribute) else call.func
    match file.evaluator.single_value(value):
        case ast.Call(func=ast.Attribute(attr="create_rate", value=node)):
            return file.owner_of(node) is not None and not _is_spun_before(file, call)
    return False


def _is_spun_before(file: RclpyFile, call: ast.Call) -> bool:
    """Return whether the loop around a call runs a callback before it, maybe the timer of a rate.

    The timer sets an event, and the next ``sleep()`` returns at once.
    """
    loop = file.module.enclosing(call, ast.While, ast.For)
    return loop is not None and any(
        (spin.name, len(spin.call.args)) in _WITHOUT_TIMEOUT
        and not spin.call.keywords
        and spin.call.lineno < call.lineno
        and loop in file.module.parents(spin.call)
        for spin in file.spin_calls
    )


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
