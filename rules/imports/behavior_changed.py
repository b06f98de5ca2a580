"""IM052: calls behave the same after a migration to another distribution."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Effect, Example, PythonRule, Report, Severity
from scaffold.api.python import PythonModule
from scaffold.api.rclpy import changed_calls

_SERVER = (
    "from rclpy.action import ActionServer\nfrom rclpy.node import Node\n"
    "from example_interfaces.action import Fibonacci\n\n\n"
    "class Counter(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('counter')\n"
    "        self.server = ActionServer(self, Fibonacci, 'count', self.run{})\n\n"
    "    def run(self, handle):\n"
    "        handle.succeed()\n"
    "        return Fibonacci.Result()\n"
)
_SUBCLASS = (
    "from rclpy.action import ActionServer\n"
    "from example_interfaces.action import Fibonacci\n\n\n"
    "class Counting(ActionServer):\n"
    "    def __init__(self, node, run):\n"
    "        self.runs = 0\n"
    "        super().__init__(node, Fibonacci, 'count', run{})\n"
)
_CLIENT = (
    "from rclpy.node import Node\nfrom std_srvs.srv import Trigger\n\n\n"
    "class Asker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('asker')\n"
    "        self.reset = self.create_client(Trigger, 'reset')\n\n"
    "    def ask(self):\n"
    "{}"
)
_CALL = "        return self.reset.call(Trigger.Request(), {})\n"
_TRIED = (
    "        try:\n"
    "            return self.reset.call(Trigger.Request(), timeout_sec=1.0)\n"
    "        except TimeoutError:\n"
    "            return None\n"
)
_ANY = (
    "        try:\n"
    "            answer = self.reset.call(Trigger.Request(), timeout_sec=1.0)\n"
    "        except Exception:\n"
    "            {}\n"
    "        return answer\n"
)
_PASSED = (
    _CLIENT.format(_CALL.format("timeout_sec=1.0"))
    .replace("class Asker(Node)", "class Asker")
    .replace("(self)", "(self, node: Node)", 1)
    .replace("super().__init__('asker')", "self.node = node")
    .replace("self.create_client", "self.node.create_client")
)
_WORKER = (
    "from multiprocessing import Process\n\nfrom rclpy.node import Node\n\n\n"
    "class Worker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('worker')\n"
    "        self.process = None\n"
    "        Process(target={}).start()\n\n"
    "    def work(self):\n"
    "        self.process = 1\n"
)
_LATER = "from Kilted on, a timeout raises TimeoutError instead of returning None: handle both"


class BehaviorChanged(PythonRule):
    """A call behaves differently on the target distribution than on the previous one.

    Only ``migrate`` reports it, because it knows the previous distribution.

    **Why.** The program starts without an error, but a default, or the way that a failure is
    reported, has changed.

    **Fix.** Pass the value explicitly, or handle both behaviors.

    **Source.** The pull requests that ``scaffold/data/changes.toml`` lists.
    """

    code = "IM052"
    name = "behavior-changed"
    severity = Severity.WARNING
    effect = Effect.WRONG_BEHAVIOR
    is_about_moves = True
    examples = (
        Example("no migration", {"counter.py": _SERVER.format("")}, distro="lyrical"),
        Example(
            "an explicit value",
            {"counter.py": _SERVER.format(", result_timeout=900")},
            distro="lyrical",
            moved_from="jazzy",
        ),
        Example(
            "a default",
            {"counter.py": _SERVER.format("")},
            "9:23: from Kilted on, a result is kept for 10 s, not for 900: a client that requests "
            "it later gets none; pass result_timeout=900 to keep it as long (rclpy 1171)",
            distro="lyrical",
            moved_from="jazzy",
        ),
        Example(
            "a default of the base class",
            {"counter.py": _SUBCLASS.format("")},
            "8:9: from Kilted on, a result is kept for 10 s, not for 900: a client that requests "
            "it later gets none; pass result_timeout=900 to keep it as long (rclpy 1171)",
            distro="lyrical",
            moved_from="jazzy",
        ),
        Example(
            "an explicit value for the base class",
            {"counter.py": _SUBCLASS.format(", result_timeout=900")},
            distro="lyrical",
            moved_from="jazzy",
        ),
        Example(
            "a timeout, as a keyword",
            {"asker.py": _CLIENT.format(_CALL.format("timeout_sec=1.0"))},
            Report("11:16", f"{_LATER} (rclpy 1271)"),
            distro="lyrical",
            moved_from="jazzy",
        ),
        Example(
            "a timeout, by its position",
            {"asker.py": _CLIENT.format(_CALL.format("1.0"))},
            Report("11:16", f"{_LATER} (rclpy 1271)"),
            distro="lyrical",
            moved_from="jazzy",
        ),
        Example(
            "a client of a node that is passed",
            {"asker.py": _PASSED},
            "11:16: from Kilted on, a timeout raises TimeoutError instead of returning None: "
            "handle both (rclpy 1271)",
            distro="lyrical",
            moved_from="jazzy",
        ),
        Example(
            "no timeout",
            {"asker.py": _CLIENT.format(_CALL.format("timeout_sec=None"))},
            distro="lyrical",
            moved_from="jazzy",
        ),
        Example(
            "a timeout that is caught",
            {"asker.py": _CLIENT.format(_TRIED)},
            distro="lyrical",
            moved_from="jazzy",
        ),
        Example(
            "a timeout that a handler for any exception handles",
            {
                "asker.py": _CLIENT.format(_ANY.format("return None")),
                "other.py": _CLIENT.format("        answer = None\n" + _ANY.format("pass")),
            },
            distro="lyrical",
            moved_from="jazzy",
        ),
        Example(
            "a timeout that a handler for any exception raises again or ignores",
            {
                "asker.py": _CLIENT.format(_ANY.format("raise")),
                "other.py": _CLIENT.format(_ANY.format("print('none')")),
            },
            Report("asker.py:12:22", f"{_LATER} (rclpy 1271)"),
            Report("other.py:12:22", f"{_LATER} (rclpy 1271)"),
            distro="lyrical",
            moved_from="jazzy",
        ),
        Example(
            "an array that must not be copied",
            {
                "area.py": "import numpy as np\n\n\ndef area(values):\n"
                "    first = np.array(values, copy=False)\n"
                "    return first, np.array(values, copy=True), np.asarray(values)\n"
            },
            "5:13: from Lyrical on, copy=False raises ValueError if a copy is needed, as for a "
            "list, instead of copying: use numpy.asarray (NumPy 2.0)",
            distro="lyrical",
            moved_from="jazzy",
        ),
        Example(
            "a process that gets a node",
            {
                "work.py": _WORKER.format("self.work"),
                "function.py": _WORKER.format("work"),
                "forked.py": "from multiprocessing import set_start_method\n"
                + _WORKER.format("self.work")
                + "\nset_start_method('fork')\n",
            },
            "work.py:10:9: from Lyrical on, the target of a process is pickled, and a node cannot "
            "be pickled: TypeError; use a function that takes what it needs, or "
            "multiprocessing.get_context('fork').Process (CPython 84559)",
            distro="lyrical",
            moved_from="jazzy",
        ),
        Example(
            "migration from a distribution without the argument",
            {"asker.py": _CLIENT.format(_CALL.format("timeout_sec=1.0"))},
            distro="lyrical",
            moved_from="humble",
        ),
        Example(
            "accepted, and no longer migrated",
            {"counter.py": _SERVER.format("").replace("run)", "run)  # noqa: IM052")},
            distro="lyrical",
        ),
    )

    def check_file(self, module: PythonModule) -> Iterator[Diagnostic]:
        for use in changed_calls(module):
            changed = use.change.changed
            title = changed.title if changed is not None else ""
            yield self.report(
                use.location, f"from {title} on, {use.change.advice} ({use.change.source})"
            )
