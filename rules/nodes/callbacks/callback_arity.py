"""ND003: callbacks take the arguments that rclpy passes."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, RclpyRule
from scaffold.api.python import UNKNOWN, conditions_on
from scaffold.api.rclpy import (
    ActionServer,
    Callback,
    Entity,
    RclpyFile,
    Service,
    Subscription,
    Synchronizer,
    Timer,
    alternatives,
    numbers_taken,
)

from ._function_tables import calls_of_tables

_NODE_OF_TABLE = (
    "from rclpy.node import Node\nfrom std_msgs.msg import String\n\n\n"
    "class Listener(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('listener')\n"
    "        self.commands = {{'start': self.start, 'stop': self.stop}}\n"
    "        self.create_subscription(String, 'command', self.hear, 10)\n\n"
    "    def hear(self, msg):\n"
    "        {}\n\n"
    "    def start(self):\n"
    "        pass\n\n"
    "    def stop(self, now=False):\n"
    "        pass\n"
)
_NODE = (
    "from rclpy.node import Node\nfrom std_msgs.msg import String\n\n\n"
    "class Listener(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('listener')\n"
    "        self.create_subscription(String, 'chatter', self.hear, 10)\n\n"
    "    def hear(self{}):\n"
    "        pass\n"
)
_TABLE = (
    "        for topic, callback in [('a', self.hear), ('b', self.log)]:\n"
    "            self.create_subscription(String, topic, callback, 10)\n\n"
)
_ROWS = (
    "from rclpy.node import Node\nfrom std_msgs.msg import String\n\n\n"
    "class Listener(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('listener')\n"
    "        table = {{'a': (String, self.log), 'b': (String, self.hear)}}\n"
    "        self.subscriptions_ = [\n"
    "            self.create_subscription(kind, topic, callback, 10)\n"
    "            for topic, (kind, callback) in table.items()]\n"
    "        for row in [(String, 'c', self.end)]:\n"
    "            self.create_subscription(row[0], row[1], row[2], 10)\n"
    "        rows = [{{'topic': 'd', 'callback': self.stop}}]\n"
    "        for number, row in enumerate(rows):\n"
    "            self.create_subscription(String, row['topic'], row['callback'], number)\n\n"
    "    def log(self, message):\n        pass\n\n"
    "    def hear(self{0}):\n        pass\n\n"
    "    def end(self{0}):\n        pass\n\n"
    "    def stop(self{0}):\n        pass\n"
)
_ASKING = (
    "from rclpy.node import Node\nfrom std_srvs.srv import Trigger\n\n\n"
    "class Asking(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('asking')\n"
    "        self.client = self.create_client(Trigger, 'report')\n"
    "        future = self.client.call_async(Trigger.Request({}))\n"
    "        future.add_done_callback(self.log)\n"
    "        future.add_done_callback(self.end)\n\n"
    "    def log(self{}):\n"
    "        pass\n\n"
    "    def end(self{}):\n"
    "        pass\n"
).replace("def end(self{})", "def end(self, future{})")
_SERVER = (
    "from example_interfaces.action import Fibonacci\nfrom rclpy.action import ActionServer\n"
    "from rclpy.node import Node\nfrom std_srvs.srv import Trigger\n\n\n"
    "class Server(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('server')\n"
    "        self.create_timer(1.0, self.tick)\n"
    "        self.create_service(Trigger, 'report', self.report)\n"
    "        self.server = ActionServer(self, Fibonacci, 'count', self.execute)\n\n"
    "    def tick(self, event):\n        pass\n\n"
    "    def report(self, request):\n        pass\n\n"
    "    def execute(self):\n        pass\n"
)
_PARTIAL = (
    "from functools import partial\n\n"
    "from rclpy.node import Node\nfrom std_srvs.srv import SetBool\n\n\n"
    "class Lamps(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('lamps')\n"
    "        self.create_service(SetBool, 'left', partial(self.switch, 'left'))\n\n"
    "    def switch(self, {}):\n"
    "        return response\n"
)
_VIEWER = (
    "from message_filters import Subscriber, TimeSynchronizer\n"
    "from rclpy.node import Node\nfrom sensor_msgs.msg import CameraInfo, Image\n\n\n"
    "class Viewer(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('viewer')\n"
    "        self.image = Subscriber(self, Image, 'image')\n"
    "        self.info = Subscriber(self, CameraInfo, 'info')\n"
    "        self.sync = TimeSynchronizer([self.image, self.info], 10)\n"
    "        self.sync.registerCallback(self.view)\n\n"
    "    def view(self{}):\n"
    "        pass\n"
)


class CallbackArity(RclpyRule):
    """A callback does not accept the arguments that rclpy passes.

    **Why.** rclpy rejects the callback of a subscription at once; other callbacks raise
    ``TypeError`` when they are first called, which ends the node.

    **Fix.** A subscription passes the message (and optionally its info), a service the request and
    the response, a timer nothing, an action server the goal handle, a synchronizer one message for
    each topic.

    **Source.** ``rclpy/subscription.py``, ``rclpy/service.py``, ``rclpy/executors.py``.
    """

    code = "ND003"
    name = "callback-arity"
    examples = (
        Example(
            "a table of methods, called with the arguments that they take",
            {"listener.py": _NODE_OF_TABLE.format("self.commands[msg.data]()")},
        ),
        Example(
            "tables of methods, called with an argument too many",
            {
                "a.py": _NODE_OF_TABLE.format("self.commands[msg.data](True)"),
                "b.py": _NODE_OF_TABLE.format(
                    "command = self.commands.get(msg.data)\n"
                    "        if command is not None:\n            command(msg)"
                ),
                "c.py": _NODE_OF_TABLE.format(
                    "if msg.data == 'stop':\n            self.commands[msg.data](True)\n"
                    "        else:\n            self.commands[msg.data]()"
                ),
            },
            "a.py:8:35: callback 'start' takes 0 arguments, but line 12 passes 1: TypeError",
            "b.py:8:35: callback 'start' takes 0 arguments, but line 14 passes 1: TypeError",
        ),
        Example(
            "replaced in a class of another module, by methods with and without a parameter",
            {
                "package.xml": "<package><name>rover</name></package>\n",
                "rover/__init__.py": "",
                "rover/base.py": _NODE.format(", msg").replace("Listener", "Base"),
                **{
                    f"rover/{name}.py": "import rclpy\nfrom rover.base import Base\n\n\n"
                    f"class Robot(Base):\n    def hear(self{parameters}):\n        pass\n"
                    for name, parameters in {"deaf": "", "robot": ", msg"}.items()
                },
            },
            "rover/deaf.py:6:5: callback 'hear' takes 0 arguments, but a subscription passes the "
            "message: RuntimeError",
        ),
        Example(
            "a timer that partial passes something to",
            {
                "ticker.py": "from functools import partial\n\nfrom rclpy.node import Node\n\n\n"
                "class Ticker(Node):\n"
                "    def __init__(self):\n"
                "        super().__init__('ticker')\n"
                "        self.create_timer(1.0, partial(self.tick, 'a'))\n"
                "        self.create_timer(1.0, partial(self.tock, 'a'))\n\n"
                "    def tick(self):\n        pass\n\n"
                "    def tock(self, name='b'):\n        pass\n"
            },
            "9:32: callback 'tick' gets 1 too many by partial(): TypeError",
        ),
        Example("the future", {"listener.py": _ASKING.format("", ", future", "")}),
        Example(
            "no parameter, two parameters",
            {"listener.py": _ASKING.format("", "", ", future, other")},
            "10:34: callback 'log' takes 0 arguments, but a future passes itself: TypeError",
            "11:34: callback 'end' takes 3 arguments, but a future passes itself: TypeError",
        ),
        Example(
            "a function in a table that the call of the table is not for",
            {
                "listener.py": _NODE_OF_TABLE.format(
                    "if msg.data == 'stop':\n            self.stop(True)\n        else:\n"
                    "            self.commands[msg.data]()"
                ).replace("now=False", "now")
            },
        ),
        Example(
            "chosen by a condition, or from a table",
            {
                "listener.py": _NODE.format(", message")
                .replace("self.hear,", "self.hear if self.verbose else self.log,")
                .replace(
                    "    def hear",
                    _TABLE + "    def log(self, message):\n        pass\n\n    def hear",
                )
            },
        ),
        Example(
            "chosen by a condition, or from a table, without a parameter",
            {
                "listener.py": _NODE.format("")
                .replace("self.hear,", "self.hear if self.verbose else self.log,")
                .replace(
                    "    def hear",
                    _TABLE + "    def log(self, message):\n        pass\n\n    def hear",
                )
            },
            "8:53: callback 'hear' takes 0 arguments, but a subscription passes the message: "
            "RuntimeError",
            "10:39: callback 'hear' takes 0 arguments, but a subscription passes the message: "
            "RuntimeError",
        ),
        Example(
            "rows of tables, by name, index and key",
            {"listener.py": _ROWS.format(", message")},
        ),
        Example(
            "rows of tables, by name, index and key, without a parameter",
            {"listener.py": _ROWS.format("")},
            "8:57: callback 'hear' takes 0 arguments, but a subscription passes the message: "
            "RuntimeError",
            "12:35: callback 'end' takes 0 arguments, but a subscription passes the message: "
            "RuntimeError",
            "14:44: callback 'stop' takes 0 arguments, but a subscription passes the message: "
            "RuntimeError",
        ),
        Example(
            "functions that a method returns",
            {
                "listener.py": _NODE.format(", word")
                .replace("self.hear,", "self.hear('said'),")
                .replace("        pass", "        def log():\n            print(word)\n")
                + "        return log\n",
                "right.py": _NODE.format(", word")
                .replace("self.hear,", "self.hear('said'),")
                .replace("        pass", "        return lambda message: print(word, message)"),
            },
            "listener.py:8:53: callback 'log' takes 0 arguments, but a subscription passes the "
            "message: RuntimeError",
        ),
        Example("the message", {"listener.py": _NODE.format(", message")}),
        Example(
            "no parameter",
            {"listener.py": _NODE.format("")},
            "8:53: callback 'hear' takes 0 arguments, but a subscription passes the message: "
            "RuntimeError",
        ),
        Example(
            "a timer, a service, an action server",
            {"server.py": _SERVER},
            "10:32: callback 'tick' takes 1 argument, but a timer passes none: TypeError",
            "11:48: callback 'report' takes 1 argument, but a service passes the request and the "
            "response: TypeError",
            "12:62: callback 'execute' takes 0 arguments, but an action server passes the goal "
            "handle: the goal is aborted",
        ),
        Example(
            "partial",
            {"lamps.py": _PARTIAL.format("side, request, response")},
        ),
        Example(
            "partial with too many arguments",
            {"lamps.py": _PARTIAL.format("request, response")},
            "10:46: callback 'switch' takes 1 more argument, but a service passes the request and "
            "the response: TypeError",
        ),
        Example("a message of each topic", {"viewer.py": _VIEWER.format(", image, info")}),
        Example(
            "a message of one topic",
            {"viewer.py": _VIEWER.format(", image")},
            "12:36: callback 'view' takes 1 argument, but the synchronizer passes 2 messages: "
            "TypeError",
        ),
        Example(
            "a keyword argument of partial, after and before the message",
            {
                "bumper.py": "from functools import partial\n\nfrom rclpy.node import Node\n"
                "from std_msgs.msg import Empty, String\n\n\n"
                "class Bumper(Node):\n"
                "    def __init__(self):\n"
                "        super().__init__('bumper')\n"
                "        hear = partial(self.hear, side='left')\n"
                "        self.create_subscription(String, 'a', partial(self.hear, side='a'), 10)\n"
                "        self.create_subscription(String, 'b', partial(self.see, side='b'), 10)\n"
                "        switches = {'on': lambda: None, 'off': lambda _: hear}\n"
                "        for topic, switch in switches.items():\n"
                "            self.create_subscription(Empty, topic, switch, 10)\n\n"
                "    def hear(self, msg, side):\n        return msg, side\n\n"
                "    def see(self, side, msg):\n        return msg, side\n"
            },
            "12:47: callback 'see' has parameters after one that is passed by name, but a "
            "subscription passes the message: RuntimeError",
            "13:27: this callback takes 0 arguments, but a subscription passes the message: "
            "RuntimeError",
        ),
        Example(
            "a method without self",
            {
                "talker.py": "from rclpy.node import Node\n\n\n"
                "class Talker(Node):\n"
                "    def __init__(self):\n"
                "        super().__init__('talker')\n"
                "        self.create_timer(1.0, self.work)\n\n"
                "    def work():\n        print('work')\n"
            },
            "7:32: callback 'work' lacks 'self': TypeError",
        ),
        Example(
            "the future of a client in a class that gets a node",
            {
                "remote.py": "from std_srvs.srv import Trigger\n\n\n"
                "class Remote:\n"
                "    def __init__(self, node):\n"
                "        self.client = node.create_client(Trigger, 'fire')\n\n"
                "    def fire(self):\n"
                "        future = self.client.call_async(Trigger.Request())\n"
                "        future.add_done_callback(self.fired)\n\n"
                "    def fired(self):\n        print('fired')\n"
            },
            "10:34: callback 'fired' takes 0 arguments, but a future passes itself: TypeError",
        ),
    )

    def check_file(self, file: RclpyFile) -> Iterator[Diagnostic]:
        for given, callback in _given_callbacks(file):
            takes = numbers_taken(callback)
            if takes is None or any(n in takes for n in given[0]):
                continue
            if not takes:
                message = f"{_shown(callback)} has parameters after one that is passed by name"
                yield self.report(callback, f"{message}, but {given[1]}")
                continue
            least, most = takes.start, takes.stop - 1
            if least < 0 and callback.is_partial:
                message = f"{_shown(callback)} gets {-least} too many by partial(): TypeError"
                yield self.report(callback, message)
                continue
            if least < 0:
                yield self.report(callback, f"{_shown(callback)} lacks 'self': TypeError")
                continue
            has = str(least) if least == most else f"{least} to {most}"
            noun = "argument" if has == "1" else "arguments"
            more = " more" if callback.is_partial else ""
            message = f"{_shown(callback)} takes {has}{more} {noun}, but {given[1]}"
            yield self.report(callback, message, cause=f"{file.module.path}: {given[1]}")


def _shown(callback: Callback) -> str:
    return f"callback {callback.name!r}" if callback.name else "this callback"


def _given_callbacks(file: RclpyFile) -> Iterator[tuple[tuple[tuple[int, ...], str], Callback]]:
    """Yield the callbacks of a file, each with the arguments it gets."""
    for entity, callback in file.callbacks:
        given = _argument_counts(entity)
        if given is not None:
            yield from ((given, item) for item in alternatives(file, callback))
    for entity, callback in file.inherited_callbacks:
        given = _argument_counts(entity)
        if given is not None:
            yield given, callback
    yield from _called_from_tables(file)
    for call, _ in file.module.method_calls("add_done_callback"):
        match call:
            case ast.Call(args=[passed], keywords=[]):
                if not file.module.mentions("def add_done_callback"):
                    yield ((1,), "a future passes itself: TypeError"), file.callback(passed)


def _called_from_tables(
    file: RclpyFile,
) -> Iterator[tuple[tuple[tuple[int, ...], str], Callback]]:
    """Yield the functions in tables, each with the arguments it gets."""
    for table, calls in calls_of_tables(file):
        if any(isinstance(part, ast.Starred) for call in calls for part in call.args):
            continue
        if any(call.keywords for call in calls):
            continue
        for key, value in zip(table.keys, table.values, strict=True):
            reaching = [call for call in calls if not _asks_for(file, call, key)]
            if reaching:
                counts = tuple({len(call.args) for call in reaching})
                passes = f"line {reaching[0].lineno} passes {counts[0] or 'none'}: TypeError"
                yield (counts, passes), file.callback(value)


def _asks_for(file: RclpyFile, call: ast.Call, key: ast.expr | None) -> bool:
    """Return whether a condition on a call asks for a key, which may be called elsewhere."""
    wanted = file.evaluator.evaluate(key) if key is not None else UNKNOWN
    return any(
        isinstance(node, ast.Constant) and node.value == wanted
        for test in conditions_on(file.module, call)
        for node in ast.walk(test)
    )


def _argument_counts(entity: Entity) -> tuple[tuple[int, ...], str] | None:
    """Return the possible numbers of arguments of a callback, and their description."""
    if isinstance(entity, Subscription):
        return (1, 2), "a subscription passes the message: RuntimeError"
    if isinstance(entity, Synchronizer):
        number = len(entity.inputs or ())
        passes = f"the synchronizer passes {number} messages: TypeError"
        return ((number,), passes) if entity.inputs else None
    if isinstance(entity, Timer):
        return (0,), "a timer passes none: TypeError"
    if isinstance(entity, Service):
        return (2,), "a service passes the request and the response: TypeError"
    if isinstance(entity, ActionServer):
        return (1,), "an action server passes the goal handle: the goal is aborted"
    return None
