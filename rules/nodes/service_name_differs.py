"""ND038: clients use the names of the services that the package offers."""

from __future__ import annotations

from collections.abc import Iterator
from difflib import SequenceMatcher

from scaffold.api import Diagnostic, Example, Package, Report, Rule, Severity
from scaffold.api.programs import NamedEndpoint, is_private, is_remapped, named_endpoints

_NODE = (
    "from rclpy.node import Node\nfrom std_srvs.srv import Trigger\n\n\n"
    "class Server(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('server')\n"
    "        self.create_service(Trigger, 'report', self.on_report)\n\n"
    "    def on_report(self, request, response):\n        return response\n\n\n"
    "class Caller(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('caller')\n"
    "        self.client = self.create_client(Trigger, '{}')\n"
)
_SIMILAR = 0.75
"""What the names of an action have in common: few packages serve two of a type."""
_ALIKE = 4
"""Length that a name needs before a different letter counts as a typo."""


class ServiceNameDiffers(Rule):
    """A client's service or action does not exist, but one of its type has almost the same name.

    **Why.** No response and no error: the client waits forever.

    **Fix.** Use the same name on both sides, preferably from one constant.

    **Source.** ROS 2 documentation, "Understanding services".
    """

    code = "ND038"
    name = "service-name-differs"
    severity = Severity.WARNING
    examples = (
        Example("the same name", {"nodes.py": _NODE.format("report")}),
        Example(
            "a typo",
            {"nodes.py": _NODE.format("reports")},
            Report("17:51", "no service 'reports'; did you mean 'report' (nodes.py:8)?"),
        ),
        Example(
            "an action",
            {
                "server.py": "from nav2_msgs.action import Spin\n"
                "from rclpy.action import ActionServer\n\n\n"
                "def serve(node):\n    return ActionServer(node, Spin, 'rotate_base', print)\n",
                "client.py": "from nav2_msgs.action import Spin\n"
                "from rclpy.action import ActionClient\n\n\n"
                "def ask(node):\n    return ActionClient(node, Spin, 'rotate_the_base')\n",
            },
            Report(
                "client.py:6:37",
                "no service 'rotate_the_base'; did you mean 'rotate_base' (server.py:6)?",
            ),
        ),
        Example(
            "private on one side",
            {"nodes.py": _NODE.format("~/report")},
            Report(
                "17:51",
                "no service '~/report'; did you mean 'report' (nodes.py:8)? ~ "
                "expands to the node name",
            ),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        endpoints = list(named_endpoints(package))
        offered = [x for x in endpoints if x.kind in {"Service", "ActionServer"}]
        wanted = [x for x in endpoints if x.kind in {"Client", "ActionClient"}]
        served = {item.name for item in offered}
        clients = {item.name for item in wanted}
        for client in wanted:
            for service in offered if client.name not in served else ():
                # A service with a client of its own is not a misspelling of another.
                if service.name not in clients and _is_slip(client, service):
                    if any(is_private(x) and is_remapped(package, x) for x in (client, service)):
                        continue
                    place = f"{service.location.path}:{service.location.line}"
                    message = (
                        f"no service {client.name!r}; did you mean {service.name!r} ({place})?"
                    )
                    if "~" in f"{client.name}{service.name}":
                        message += " ~ expands to the node name"
                    yield self.report(client.name_location, message)
                    break


def _is_slip(client: NamedEndpoint, service: NamedEndpoint) -> bool:
    """Return whether two names of the same type differ by one letter.

    Or only by ``~/``, which makes a name private.
    """
    name, other = client.name, service.name
    if client.interface is None or client.interface != service.interface:
        return False
    if name.startswith("~") is not other.startswith("~"):
        return name.removeprefix("~").strip("/") == other.removeprefix("~").strip("/")
    short, long = sorted((name, other), key=len)
    is_short = len(short) < _ALIKE or short.strip("/") == long.strip("/")
    if is_short or any(map(str.isdigit, name + other)):
        return False
    if client.kind == "ActionClient" and client.location.path != service.location.path:
        return SequenceMatcher(None, short, long).ratio() >= _SIMILAR
    if len(long) - len(short) > 1:
        return False
    same = next((i for i, letter in enumerate(short) if letter != long[i]), len(short))
    rest = same if len(long) > len(short) else same + 1
    return short[rest:] == long[same + 1 :]
