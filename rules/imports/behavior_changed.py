"""IM052: calls that mean something else after a move to another distribution."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, PythonRule, Report, Severity
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


class BehaviorChanged(PythonRule):
    """A call does something else on the target than on the distribution that the code comes from.

    Only ``migrate`` reports it: it knows where the code comes from.

    **Why.** Nothing fails when the program starts: a default, or the way to report a failure, is
    another.

    **Fix.** Pass the value that the program relies on, or handle both behaviors.

    **Source.** The pull requests that ``scaffold/data/changes.toml`` names.
    """

    code = "IM052"
    name = "behavior-changed"
    severity = Severity.WARNING
    examples = (
        Example("not moved", {"counter.py": _SERVER.format("")}, distro="lyrical"),
        Example(
            "an explicit value",
            {"counter.py": _SERVER.format(", result_timeout=900")},
            distro="lyrical",
            moved_from="jazzy",
        ),
        Example(
            "a default",
            {"counter.py": _SERVER.format("")},
            Report(
                "9:23",
                "from Kilted on, a result is kept for 10 s, not for 900: a "
                "client that asks later gets none; pass result_timeout=900 to "
                "keep it as long (rclpy 1171)",
            ),
            distro="lyrical",
            moved_from="jazzy",
        ),
    )

    def check_file(self, module: PythonModule) -> Iterator[Diagnostic]:
        for use in changed_calls(module):
            changed = use.change.changed
            title = changed.title if changed is not None else ""
            yield self.report(
                use.location, f"from {title} on, {use.change.advice} ({use.change.source})"
            )
