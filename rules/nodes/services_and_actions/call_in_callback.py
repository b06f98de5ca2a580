"""ND058: callbacks do not block on service calls."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, RclpyRule, fact
from scaffold.api.install import file_of
from scaffold.api.programs import (
    Executed,
    client_at,
    client_of,
    in_callbacks,
    in_constructors,
    in_tasks,
    may_run_meanwhile,
    names_other_executor,
    share_group,
    spins_elsewhere,
    spins_in_one_thread,
)
from scaffold.api.python import PythonModule
from scaffold.api.rclpy import Entity, RclpyFile, class_of

_NODE = (
    "from rclpy.node import Node\nfrom std_srvs.srv import Trigger\n\n\n"
    "class Caller(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('caller')\n"
    "        self.client = self.create_client(Trigger, 'reset')\n"
    "        self.create_timer(1.0, self.ask)\n\n"
    "    def ask(self):\n"
    "{}"
)
_IMPORTS = (
    "import rclpy\nfrom rclpy.callback_groups import MutuallyExclusiveCallbackGroup\n"
    "from rclpy.executors import MultiThreadedExecutor\n"
)
_CALL = _IMPORTS + _NODE.format("        self.client.call(Trigger.Request())\n")
_MAIN = (
    "\n\ndef main():\n    rclpy.init()\n    executor = MultiThreadedExecutor()\n"
    "    executor.add_node(Caller())\n    executor.spin()\n"
)
_OWN_GROUP = (_CALL + _MAIN).replace(
    "'reset')", "'reset', callback_group=MutuallyExclusiveCallbackGroup())"
)
_GOAL = (
    (_CALL + _MAIN)
    .replace("self.create_timer(1.0, self.ask)", "ActionServer(self, Count, 'count', self.ask)")
    .replace("import rclpy\n", "import rclpy\nfrom rclpy.action import ActionServer\n", 1)
)
_DONE = (
    "import rclpy\n"
    + _NODE.format("        future = self.client.call_async(Trigger.Request())\n")
    + "        future.add_done_callback(self.again)\n\n"
    "    def again(self, future):\n"
    "        self.client.call(Trigger.Request())\n\n\n"
    "def main():\n    rclpy.init()\n    rclpy.spin(Caller())\n"
)
_THREADS = (
    "\n\ndef main():\n    rclpy.init()\n    threading.Thread(target=print).start()\n"
    "    rclpy.spin(Caller())\n"
)
_BLOCKING = {
    "call": ("rclpy.client.Client", "a service response"),
    "send_goal": ("rclpy.action.client.ActionClient", "an action result"),
    "get_result": ("rclpy.action.client.ClientGoalHandle", "an action result"),
}


class CallInCallback(RclpyRule):
    """A callback or constructor calls a service and blocks until the response.

    **Why.** The executor waits for the callback, so it cannot receive the response: the node hangs
    forever, without an error.

    **Fix.** Use ``call_async`` with ``add_done_callback``, or an ``async`` callback that awaits.

    **Source.** ROS 2 documentation, "Synchronous vs. asynchronous service clients".
    """

    code = "ND058"
    name = "call-in-callback"
    examples = (
        Example(
            "asynchronous",
            {
                "caller.py": _NODE.format(
                    "        future = self.client.call_async(Trigger.Request())\n"
                    "        future.add_done_callback(print)\n"
                )
            },
        ),
        Example(
            "a call",
            {"caller.py": _NODE.format("        self.client.call(Trigger.Request())\n")},
            "12:9: waits for a service response in callback 'ask': deadlock, because the response "
            "cannot be received; use call_async()",
        ),
        Example(
            "a call in a thread that nothing spins",
            {"caller.py": "import threading\n\n" + _CALL + _THREADS},
            "17:9: waits for a service response in callback 'ask': deadlock, because the response "
            "cannot be received; use call_async()",
        ),
        Example(
            "several threads and one callback group",
            {"caller.py": _CALL + _MAIN},
            "15:9: waits for a service response in callback 'ask', which shares its callback "
            "group with the client: deadlock, because the response cannot be received; use "
            "call_async()",
        ),
        Example("several threads and a callback group for the client", {"caller.py": _OWN_GROUP}),
        Example(
            "a callback group for the client, and one thread",
            {"caller.py": _OWN_GROUP.replace("MultiThreaded", "SingleThreaded")},
            "15:9: waits for a service response in callback 'ask': deadlock, because the response "
            "cannot be received; use call_async()",
        ),
        Example(
            "in an execute callback, with one thread",
            {"caller.py": _GOAL.replace("MultiThreaded", "SingleThreaded")},
            "16:9: waits for a service response in callback 'ask': deadlock, because the response "
            "cannot be received; use call_async()",
        ),
        Example(
            "several threads that are not used",
            {"caller.py": _OWN_GROUP.replace("executor.spin()", "rclpy.spin(node)")},
            "15:9: waits for a service response in callback 'ask': deadlock, because the response "
            "cannot be received; use call_async()",
        ),
        Example("in an execute callback, with several threads", {"caller.py": _GOAL}),
        Example(
            "when a future is done",
            {"caller.py": _DONE},
            "17:9: waits for a service response in callback 'again': deadlock, because the "
            "response cannot be received; use call_async()",
        ),
        Example(
            "when a future is done, with several threads",
            {
                "caller.py": _IMPORTS
                + _DONE.removeprefix("import rclpy\n").partition("\n\n\ndef main")[0]
                + _MAIN
            },
        ),
        Example(
            "with a timeout",
            {"caller.py": _NODE.format("        self.client.call(0, timeout_sec=1.0)\n")},
        ),
        Example(
            "an action",
            {
                "caller.py": "from rclpy.action import ActionClient\n"
                + _NODE.format(
                    "        ActionClient(self, Count, 'count').send_goal(Count.Goal())\n"
                )
            },
            "13:9: waits for an action result in callback 'ask': deadlock, because the response "
            "cannot be received; use call_async()",
        ),
        Example(
            "a loop that ends after its first iteration",
            {
                "caller.py": _NODE.format(
                    "        future = self.client.call_async(Trigger.Request())\n"
                    "        while not future.done():\n"
                    "            try:\n                print(future.result())\n"
                    "            except Exception as error:\n                print(error)\n"
                    "            break\n"
                )
            },
        ),
        Example(
            "a loop while rclpy.ok()",
            {
                "caller.py": "import rclpy\n"
                + _NODE.format(
                    "        future = self.client.call_async(Trigger.Request())\n"
                    "        while rclpy.ok() and not future.done():\n            pass\n"
                )
            },
            "14:9: busy-waits for a future in callback 'ask': deadlock, because the response "
            "cannot be received; use call_async()",
        ),
        Example(
            "a loop",
            {
                "caller.py": _NODE.format(
                    "        future = self.client.call_async(Trigger.Request())\n"
                    "        while not future.done():\n            pass\n"
                )
            },
            "13:9: busy-waits for a future in callback 'ask': deadlock, because the response "
            "cannot be received; use call_async()",
        ),
        Example(
            "in a function of another module",
            {
                "package.xml": "<package><name>rover</name></package>\n",
                "rover/__init__.py": "",
                "rover/calls.py": "import time\n\n\n"
                "def call(client, request):\n"
                "    future = client.call_async(request)\n"
                "    while not future.done():\n        time.sleep(0.1)\n"
                "    return future.result()\n",
                "rover/caller.py": _NODE.format(
                    "        call(self.client, Trigger.Request())\n"
                ).replace(
                    "import Trigger\n", "import Trigger\n\nfrom rover.calls import call\n", 1
                ),
            },
            "rover/caller.py:14:9: waits for a response in call() in callback 'ask': deadlock, "
            "because the response cannot be received; use call_async()",
        ),
        Example(
            "clients in containers",
            {
                "saver.py": "import rclpy\nfrom rclpy.node import Node\n"
                "from std_msgs.msg import Bool\nfrom std_srvs.srv import SetBool\n\n\n"
                "class Saver(Node):\n"
                "    def __init__(self):\n"
                "        super().__init__('saver')\n"
                "        self.users = {x: self.create_client(SetBool, x) for x in ('a', 'b')}\n"
                "        self.lamps = []\n"
                "        for name in ('c', 'd'):\n"
                "            self.lamps.append(self.create_client(SetBool, name))\n"
                "        self.others = {'e': self.create_client(SetBool, 'e'), 'f': print}\n"
                "        self.create_subscription(Bool, 'low', self.on_low, 10)\n\n"
                "    def on_low(self, msg):\n"
                "        for name, client in self.users.items():\n"
                "            client.call(SetBool.Request(data=msg.data))\n"
                "        for lamp in self.lamps:\n"
                "            lamp.call(SetBool.Request(data=msg.data))\n"
                "        self.users['a'].call(SetBool.Request(data=msg.data))\n"
                "        for name in self.users:\n"
                "            name.call(msg)\n"
                "        for other in self.others.values():\n"
                "            other.call(msg)\n\n\n"
                "def main():\n"
                "    rclpy.init()\n"
                "    rclpy.spin(Saver())\n",
            },
            "19:13: waits for a service response in callback 'on_low': deadlock, because the "
            "response cannot be received; use call_async()",
            "21:13: waits for a service response in callback 'on_low': deadlock, because the "
            "response cannot be received; use call_async()",
            "22:9: waits for a service response in callback 'on_low': deadlock, because the "
            "response cannot be received; use call_async()",
        ),
    )

    def check_in(self, package: Package, file: RclpyFile) -> Iterator[Diagnostic]:
        seen: set[ast.AST] = set()
        executions = (*in_callbacks(file), *in_constructors(file), *in_tasks(file))
        for executed in executions:
            waits = (
                *_waits(file, executed.function),
                *_waits_elsewhere(package, file, executed.function),
            )
            for node, what, client in waits:
                if node in seen:
                    continue
                reason = _deadlock(file, executed, client)
                if reason:
                    seen.add(node)
                    message = f"{what} in {executed.origin}{reason}"
                    yield self.report(file.module.location(node), message)


def _deadlock(file: RclpyFile, executed: Executed, client: Entity | None) -> str:
    """Return why a wait never ends; empty if it may."""
    plain = ": deadlock, because the response cannot be received; use call_async()"
    is_same_node = executed.entity and client and executed.entity.owner is client.owner
    is_one_thread = spins_in_one_thread(file)
    if executed.is_task:
        return plain if is_same_node and is_one_thread else ""
    if executed.entity and client and is_same_node:
        shared = share_group(file, executed.entity, client)
        if shared:
            is_surprising = names_other_executor(file) and not is_one_thread
            shares = ", which shares its callback group with the client"
            return f"{shares}{plain}" if is_surprising else plain
        if shared is False:
            return plain if is_one_thread else ""
    if may_run_meanwhile(file, executed) or (not is_same_node and spins_elsewhere(file)):
        return ""
    return plain


def _waits(file: RclpyFile, function: ast.AST) -> Iterator[tuple[ast.AST, str, Entity | None]]:
    for node in file.module.below(function, ast.Call, ast.While):
        match node:
            case ast.Call(func=ast.Attribute(attr=method, value=asked)) if method in _BLOCKING:
                class_, what = _BLOCKING[method]
                if class_of(file, asked) == class_ and not _has_timeout(node):
                    is_of_goal = method == "get_result" and len(file.action_clients) == 1
                    client = file.action_clients[0] if is_of_goal else client_at(file, asked)
                    yield node, f"waits for {what}", client
            case ast.While(test=test) if not _ends_at_once(file.module, node):
                future = _awaited(file, test)
                if future is not None and "spin" not in ast.unparse(node):
                    yield node, "busy-waits for a future", client_of(file, future)


def _waits_elsewhere(
    package: Package, file: RclpyFile, function: ast.AST
) -> Iterator[tuple[ast.AST, str, Entity | None]]:
    """Yield calls of functions in other modules that wait for a client of this file."""
    for call in file.module.below(function, ast.Call):
        module, _, name = (file.module.qualified_name(call.func) or "").rpartition(".")
        if module and file.is_own_module(module):
            clients = [client_at(file, given) for given in call.args]
            path = file_of(package, module)
            if any(clients) and path and name in _waiting(package, path):
                yield call, f"waits for a response in {name}()", next(filter(None, clients))


@fact
def _waiting(package: Package, path: str) -> frozenset[str]:
    """Return the functions of a file that wait for the response to a passed client."""
    module = package.module(path)
    return frozenset(
        function.name
        for function in module.function_nodes
        for loop in module.below(function, ast.While)
        for asked in [_pending_future(loop.test)]
        if asked and not _ends_at_once(module, loop) and "spin" not in ast.unparse(loop)
        for assigned in module.below(function, ast.Assign)
        if ast.unparse(assigned.targets[0]) == asked
        for given in [arg.arg for arg in function.args.args]
        if ast.unparse(assigned.value).startswith(f"{given}.call_async(")
    )


def _pending_future(test: ast.expr) -> str:
    match test:
        case ast.UnaryOp(op=ast.Not(), operand=ast.Call(func=ast.Attribute(attr="done") as done)):
            return ast.unparse(done.value)
    return ""


def _ends_at_once(module: PythonModule, loop: ast.While) -> bool:
    """Return whether a loop ends in its first iteration."""
    leaves = any(isinstance(item, ast.Break | ast.Return | ast.Raise) for item in loop.body)
    return leaves and not any(module.below(loop, ast.Continue))


def _has_timeout(call: ast.Call) -> bool:
    return len(call.args) > 1 or any(word.arg in {"timeout_sec", None} for word in call.keywords)


def _awaited(file: RclpyFile, test: ast.expr) -> ast.expr | None:
    """Return the future in a loop condition: ``rclpy.ok() and not future.done()``."""
    match test:
        case ast.BoolOp(op=ast.And(), values=[*values, last]):
            is_plain = all(
                isinstance(x, ast.Call) and file.module.qualified_name(x.func) == "rclpy.ok"
                for x in values
            )
            return _awaited(file, last) if is_plain else None
        case ast.UnaryOp(
            op=ast.Not(), operand=ast.Call(func=ast.Attribute(attr="done", value=future))
        ) if class_of(file, future) == "rclpy.task.Future":
            return future
    return None
