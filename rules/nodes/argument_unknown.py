"""ND040: functions of rclpy get only arguments that they take."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from difflib import get_close_matches

from scaffold.api import Diagnostic, Edit, Example, Fix, RclpyRule, Report
from scaffold.api.rclpy import Excess, RclpyFile, excess_arguments, is_tried

_CODE = (
    "import sys\n\nimport rclpy\nfrom rclpy.node import Node\n"
    "from std_srvs.srv import Trigger\n\n\n"
    "class Server(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('server')\n"
    "        self.create_service(Trigger, 'reset', print{})\n"
    "        self.create_timer(0.1, print{})\n\n\n"
    "def main():\n"
    "    rclpy.init({}sys.argv)\n"
    "    rclpy.spin_once(Server(){})\n"
)
_RIGHT = _CODE.format("", "", "args=", ", timeout_sec=0.1")


class ArgumentUnknown(RclpyRule):
    """A function of rclpy gets an argument that it does not take.

    **Why.** ``TypeError: init() takes 0 positional arguments but 1 was given`` as soon as the
    call is made. Many arguments of rclpy are keyword-only, unlike in ROS 1 or C++.

    **Fix.** Pass the argument as a keyword, or remove it.

    **Source.** ``rclpy/__init__.py``, ``rclpy/node.py``, ``rclpy/qos.py`` of Jazzy.
    """

    code = "ND040"
    name = "argument-unknown"
    examples = (
        Example("as keywords", {"server.py": _RIGHT}),
        Example(
            "positional",
            {"server.py": _CODE.format("", "", "", ", 0.1")},
            Report(
                "16:16",
                "rclpy.init() takes no positional arguments: TypeError; as "
                "keywords: args, context, domain_id, signal_handler_options",
                fix="pass it as args=",
            ),
            Report(
                "17:31",
                "rclpy.spin_once() takes at most 1 positional argument: TypeError; "
                "as keywords: executor, timeout_sec",
                fix="pass it as timeout_sec=",
            ),
            fixed={"server.py": _RIGHT},
        ),
        Example(
            "a depth for a service, and a keyword of ROS 1",
            {"server.py": _CODE.format(", 10", ", oneshot=True", "args=", "")},
            Report(
                "11:54",
                "create_service() takes at most 3 positional arguments: TypeError; "
                "as keywords: callback_group, qos_profile",
            ),
            Report("12:47", "create_timer() has no argument 'oneshot': TypeError"),
        ),
        Example(
            "tried, and asked for: an older distribution is kept",
            {
                "server.py": "import inspect\n\nfrom rclpy.node import Node\n"
                "from std_srvs.srv import Trigger\n\n\n"
                "class Server(Node):\n"
                "    def serve(self):\n"
                "        try:\n"
                "            self.create_service(Trigger, 'a', print, introspection=True)\n"
                "        except TypeError:\n"
                "            self.create_service(Trigger, 'a', print)\n"
                "        try:\n"
                "            self.b = self.create_service(Trigger, 'b', print, lazy=True)\n"
                "        except Exception:\n"
                "            self.b = self.create_service(Trigger, 'b', print)\n"
                "        if 'lazy' in inspect.signature(self.create_service).parameters:\n"
                "            self.create_service(Trigger, 'c', print, lazy=True)\n"
            },
        ),
        Example(
            "a failure that a handler of anything hides",
            {
                "server.py": "from rclpy.node import Node\n"
                "from std_srvs.srv import Trigger\n\n\n"
                "class Server(Node):\n"
                "    def serve(self):\n"
                "        try:\n"
                "            self.create_service(Trigger, 'a', print, lazy=True)\n"
                "        except Exception as error:\n"
                "            self.get_logger().error(str(error))\n"
            },
            Report("8:59", "create_service() has no argument 'lazy': TypeError"),
        ),
        Example(
            "a misspelled keyword of a client",
            {
                "server.py": _RIGHT.replace(
                    "self.create_timer(0.1, print)",
                    "self.create_client(Trigger, 'a').wait_for_service(timeout=1.0)",
                )
            },
            Report(
                "12:67",
                "wait_for_service() has no argument 'timeout': TypeError; did you "
                "mean 'timeout_sec'?",
            ),
        ),
        Example(
            "the keyword of ROS 1 for the depth of the queue",
            {
                "server.py": _RIGHT.replace(
                    "self.create_timer(0.1, print)",
                    "self.create_publisher(Trigger, 'a', queue_size=10)",
                )
            },
            Report(
                "12:56",
                "create_publisher() has no argument 'queue_size': TypeError; write "
                "qos_profile=, which takes a depth as well",
                fix="write qos_profile=",
            ),
            fixed={
                "server.py": _RIGHT.replace(
                    "self.create_timer(0.1, print)",
                    "self.create_publisher(Trigger, 'a', qos_profile=10)",
                )
            },
        ),
        Example(
            "a message for the getter of the logger",
            {"server.py": _RIGHT.replace("super().__init__('server')", "self.get_logger('up')")},
            Report("10:25", "get_logger() takes no positional arguments: TypeError"),
        ),
    )

    def check_file(self, file: RclpyFile) -> Iterator[Diagnostic]:
        for excess in excess_arguments(file):
            if is_tried(file.module, excess.call, excess.keyword):
                continue
            fix = _fix(file, excess)
            yield self.report(file.module.location(excess.node), _message(excess), fix)


def _message(excess: Excess) -> str:
    signature = excess.signature
    if excess.keyword:
        names = sorted({*signature.positional, *signature.keywords})
        closest = get_close_matches(excess.keyword, names, n=1)
        hint = f"; did you mean {closest[0]!r}?" if closest else ""
        if _is_queue_size(excess):
            hint = "; write qos_profile=, which takes a depth as well"
        return f"{excess.function}() has no argument {excess.keyword!r}: TypeError{hint}"
    count = len(signature.positional)
    most = f"at most {count}" if count else "no"
    plural = "" if count == 1 else "s"
    by_name = sorted(signature.keywords)
    hint = f"; as keywords: {', '.join(by_name)}" if by_name else ""
    return f"{excess.function}() takes {most} positional argument{plural}: TypeError{hint}"


def _fix(file: RclpyFile, excess: Excess) -> Fix | None:
    """Return the fix that names an argument, where the name is obvious."""
    if _is_queue_size(excess) and type(file.evaluator.evaluate(excess.node)) is int:
        start, _ = file.module.span(_keyword(excess))
        edit = Edit(file.module.path, start, start + len(excess.keyword), "qos_profile")
        return Fix("write qos_profile=", (edit,))
    if excess.keyword or excess.node is not excess.call.args[-1]:
        return None
    name = ""
    if excess.function == "rclpy.init" and _is_command_line(file, excess.node):
        name = "args"
    elif excess.function == "rclpy.spin_once":
        value = file.evaluator.evaluate(excess.node)
        name = "timeout_sec" if type(value) in {int, float} else ""
    if not name or any(word.arg in {name, None} for word in excess.call.keywords):
        return None
    start, _ = file.module.span(excess.node)
    return Fix(f"pass it as {name}=", (Edit(file.module.path, start, start, f"{name}="),))


def _is_queue_size(excess: Excess) -> bool:
    """Tell whether a publisher or a subscription has the depth of its queue as ROS 1 names it."""
    given = {word.arg for word in excess.call.keywords}
    given.update(excess.signature.positional[: len(excess.call.args)])
    takes_profile = "qos_profile" in {*excess.signature.positional, *excess.signature.keywords}
    return excess.keyword == "queue_size" and takes_profile and "qos_profile" not in given


def _keyword(excess: Excess) -> ast.keyword:
    return next(word for word in excess.call.keywords if word.arg == excess.keyword)


def _is_command_line(file: RclpyFile, node: ast.expr) -> bool:
    if isinstance(node, ast.Name) and node.id in {"args", "argv"}:
        return True
    return file.module.qualified_name(node) == "sys.argv"
