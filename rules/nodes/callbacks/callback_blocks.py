"""ND030: callbacks return quickly."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Effect, Example, RclpyRule, Severity
from scaffold.api.programs import (
    blocks_node,
    in_callbacks,
    in_constructors,
    names_other_executor,
    spins_in_one_thread,
)
from scaffold.api.rclpy import RclpyFile, class_of

SHORT = 0.05
"""Seconds; shorter sleeps are harmless."""
VERBS = ("get", "post", "put", "patch", "delete", "head", "request")
WAITING = frozenset(
    {f"{library}.{verb}" for library in ("requests", "httpx") for verb in VERBS}
    | {"urllib.request.urlopen", "urllib.request.urlretrieve"}
)
"""Calls that wait for a server; the duration of subprocesses is unknown."""
_CLOCKS = frozenset({"rclpy.clock.Clock", "rclpy.clock.ROSClock"})
WAITS = frozenset({"wait_for_service", "wait_for_server"})
_CALLER = (
    "from rclpy.node import Node\nfrom std_srvs.srv import Trigger\n\n\n"
    "class Caller(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('caller')\n"
    "        self.client = self.create_client(Trigger, 'report')\n"
    "        self.client.wait_for_service({})\n"
)
_NODE = (
    "import time\n\nfrom rclpy.node import Node\n\n\n"
    "class Talker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('talker')\n"
    "        self.create_timer(1.0, self.tick)\n\n"
    "    def tick(self):\n"
    "        {}\n"
)
_QUEUE = _NODE.replace("import time", "import queue").format("print(self.lines.get({1}))")
_QUEUE = _QUEUE.replace("        self.create", "        self.lines = {0}\n        self.create")
_GROUPS = (
    "import time\n\nimport rclpy\n"
    "from rclpy.callback_groups import MutuallyExclusiveCallbackGroup\n"
    "from rclpy.executors import MultiThreadedExecutor\nfrom rclpy.node import Node\n"
    "from std_msgs.msg import Empty\n\n\n"
    "class Talker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('talker')\n"
    "        slow = MutuallyExclusiveCallbackGroup()\n"
    "        fast = MutuallyExclusiveCallbackGroup()\n"
    "        self.create_timer(1.0, self.tick, callback_group=slow)\n"
    "        self.create_subscription(Empty, 'stop', self.stop, 1, callback_group={})\n\n"
    "    def tick(self):\n"
    "        time.sleep(1.0)\n\n"
    "    def stop(self, message):\n"
    "        pass\n\n\n"
    "def main():\n"
    "    rclpy.init()\n"
    "    executor = {}()\n"
    "    executor.add_node(Talker())\n"
    "    executor.spin()\n"
)
_QUEUES = frozenset(
    {"multiprocessing.Queue", "queue.LifoQueue", "queue.PriorityQueue", "queue.Queue"}
    | {"queue.SimpleQueue"}
)


class CallbackBlocks(RclpyRule):
    """A callback sleeps or waits for input, or waits for a server without a timeout.

    **Why.** One thread runs all callbacks: meanwhile no other callback of the node runs, and timers
    miss their period. A callback or constructor that waits for a server without a timeout hangs
    until the server is available, without an error.

    **Fix.** Use a timer instead of sleeping, and a separate thread for waiting. Pass
    ``timeout_sec`` to ``wait_for_service``, and log the missing server.

    **Source.** ROS 2 documentation, "Executors"; "Migrating a Python package example"; rclpy,
    ``Client.wait_for_service``.
    """

    code = "ND030"
    name = "callback-blocks"
    severity = Severity.WARNING
    effect = Effect.WRONG_BEHAVIOR
    examples = (
        Example("no wait", {"talker.py": _NODE.format("self.now = time.time()")}),
        Example(
            "a sleep of a clock",
            {
                "talker.py": _NODE.replace(
                    "import time\n", "from rclpy.duration import Duration"
                ).format("self.get_clock().sleep_for(Duration(seconds=5.0))")
            },
            "11:9: self.get_clock().sleep_for() blocks callback 'tick' and all other callbacks; "
            "use a timer or a thread of the node",
        ),
        Example("a harmlessly short sleep", {"talker.py": _NODE.format("time.sleep(0.001)")}),
        Example(
            "a sleep",
            {"talker.py": _NODE.format("time.sleep(1.0)")},
            "12:9: time.sleep(1) blocks callback 'tick' and all other callbacks; use a timer or a "
            "thread of the node",
        ),
        Example(
            "a server",
            {"talker.py": "import requests\n" + _NODE.format("requests.get('http://robot/state')")},
            "13:9: requests.get() blocks callback 'tick' and all other callbacks; use a timer or "
            "a thread of the node",
        ),
        Example(
            "a key press in a window",
            {"talker.py": "import cv2\n" + _NODE.format("cv2.waitKey(0)")},
            "13:9: cv2.waitKey(0) blocks callback 'tick' and all other callbacks; use a timer or "
            "a thread of the node",
        ),
        Example(
            "a short wait for a window",
            {"talker.py": "import cv2\n" + _NODE.format("cv2.waitKey(1)")},
        ),
        Example(
            "a queue that is empty, one with a timeout",
            {
                "talker.py": _QUEUE.format("queue.Queue()", ""),
                "other.py": _QUEUE.format("queue.Queue()", "timeout=0.1"),
                "own.py": _QUEUE.format("dict()", ""),
            },
            "talker.py:13:15: self.lines.get() without a timeout blocks callback 'tick' and all "
            "other callbacks; use a timer or a thread of the node",
        ),
        Example(
            "user input",
            {"talker.py": _NODE.format("input()")},
            "12:9: input() blocks callback 'tick' and all other callbacks; use a timer or a "
            "thread of the node",
        ),
        Example(
            "several threads and a separate callback group",
            {"talker.py": _GROUPS.format("fast", "MultiThreadedExecutor")},
        ),
        Example(
            "several threads and a callback group that others share",
            {"talker.py": _GROUPS.format("slow", "MultiThreadedExecutor")},
            "19:9: time.sleep(1) blocks callback 'tick' and all other callbacks; use a timer or a "
            "thread of its callback group",
        ),
        Example(
            "a separate callback group and one thread",
            {
                "talker.py": _GROUPS.format("fast", "SingleThreadedExecutor").replace(
                    "MultiThreaded", "SingleThreaded"
                )
            },
            "19:9: time.sleep(1) blocks callback 'tick' and all other callbacks; use a timer or a "
            "thread of the node",
        ),
        Example("with a timeout", {"caller.py": _CALLER.format("timeout_sec=1.0")}),
        Example(
            "without a timeout",
            {"caller.py": _CALLER.format("")},
            "9:9: wait_for_service() without timeout_sec blocks the constructor of Caller until "
            "the server is available",
        ),
    )

    def check_file(self, file: RclpyFile) -> Iterator[Diagnostic]:
        yield from self._check_server_waits(file)
        for executed in in_callbacks(file):
            for call in file.calls_in(executed.function):
                name = _blocking(file, call)
                if name and blocks_node(file, executed):
                    message = (
                        f"{name} blocks {executed.origin} and all other callbacks; use a "
                        f"timer or a thread"
                    )
                    at = file.module.location(call)
                    cause = f"blocking of {executed.origin} in {file.module.path}"
                    yield self.report(at, f"{message} of {_blocked(file)}", cause=cause)

    def _check_server_waits(self, file: RclpyFile) -> Iterator[Diagnostic]:
        seen: set[ast.AST] = set()
        for function, origin, _ in (*in_constructors(file), *in_callbacks(file)):
            for call in file.calls_in(function):
                match call:
                    case ast.Call(func=ast.Attribute(attr=name), args=[], keywords=[]):
                        if name in WAITS and call not in seen:
                            seen.add(call)
                            message = f"{name}() without timeout_sec blocks {origin} until the"
                            at = file.module.location(call)
                            yield self.report(at, f"{message} server is available")


def _blocked(file: RclpyFile) -> str:
    has_threads = names_other_executor(file) and not spins_in_one_thread(file)
    return "its callback group" if has_threads else "the node"


def _blocking(file: RclpyFile, call: ast.Call) -> str:
    """Return the name of a call that certainly blocks; empty for others."""
    name = file.module.qualified_name(call.func)
    if name == "time.sleep" and call.args:
        seconds = file.evaluator.evaluate(call.args[0])
        if isinstance(seconds, int | float) and seconds >= SHORT:
            return f"time.sleep({seconds:g})"
    if name in WAITING or _is_builtin_input(file, call):
        return f"{name or 'input'}()"
    if name == "cv2.waitKey":
        delays = [*call.args[:1], *(word.value for word in call.keywords)]
        delay = file.evaluator.number(delays[0]) if delays else 0
        return "cv2.waitKey(0)" if isinstance(delay, int | float) and delay <= 0 else ""
    if name == "matplotlib.pyplot.show" and not call.args and not call.keywords:
        return "" if file.module.mentions(".ion()") else "matplotlib.pyplot.show()"
    return _blocking_method(file, call)


def _blocking_method(file: RclpyFile, call: ast.Call) -> str:
    match call.func:
        case ast.Attribute(attr="sleep_for", value=clock) if class_of(file, clock) in _CLOCKS:
            return f"{file.module.text(call.func)}()"
        case ast.Attribute() as method if _is_queue_awaited(file, call, method):
            return f"{file.module.text(method)}() without a timeout"
    return ""


def _is_builtin_input(file: RclpyFile, call: ast.Call) -> bool:
    is_named = isinstance(call.func, ast.Name) and call.func.id == "input"
    return is_named and file.module.index.lookup("input", call.func) is None


def _is_queue_awaited(file: RclpyFile, call: ast.Call, method: ast.Attribute) -> bool:
    """Return whether a call waits for the next item of a queue, which another thread puts there."""
    if method.attr != "get" or call.args or call.keywords:
        return False
    made = file.evaluator.single_value(method.value)
    if not isinstance(made, ast.Call) or file.module.qualified_name(made.func) not in _QUEUES:
        return False
    function = file.function_of(call)
    text = file.module.text(function) if function is not None else ""
    queue = file.module.text(method.value)
    return not any(f"{queue}.{name}(" in text for name in ("empty", "put", "qsize", "full"))
