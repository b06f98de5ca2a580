"""ND038: a client asks for the service that its package offers."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Report, Rule, Severity
from scaffold.api.programs import is_private, is_remapped
from scaffold.api.rclpy import Endpoint, rclpy_files

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
_ALIKE = 4
"""Letters that a name needs before one letter more or less is a slip."""


class ServiceNameDiffers(Rule):
    """A client's service is offered nowhere, but one with almost the same name and type is.

    **Why.** Nothing answers, and nothing says so: the client waits for ever.

    **Fix.** Use one name on both sides, best from one constant.

    **Source.** ROS 2 documentation, "Understanding services".
    """

    code = "ND038"
    name = "service-name-differs"
    severity = Severity.WARNING
    examples = (
        Example("one name", {"nodes.py": _NODE.format("report")}),
        Example(
            "a slip",
            {"nodes.py": _NODE.format("reports")},
            reports=(
                Report("nodes.py:17:51", "nobody offers 'reports'; nodes.py:8 offers 'report'"),
            ),
        ),
        Example(
            "private on one side",
            {"nodes.py": _NODE.format("~/report")},
            reports=(
                Report(
                    "nodes.py:17:51",
                    "nobody offers '~/report'; nodes.py:8 offers 'report': ~ stands for "
                    "the name of each node itself",
                ),
            ),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        files = list(rclpy_files(package))
        offered = [one for facts in files for one in (*facts.services, *facts.action_servers)]
        wanted = [one for facts in files for one in (*facts.clients, *facts.action_clients)]
        served = {item.name for item in offered}
        clients = {item.name for item in wanted}
        for client in wanted:
            for service in offered if client.name not in served else ():
                # A service that has its own client is no misspelling of another one.
                if service.name not in clients and _is_slip(client, service):
                    if any(
                        is_private(one) and is_remapped(package, one) for one in (client, service)
                    ):
                        continue
                    at = client.name_argument.location if client.name_argument else client.location
                    place = f"{service.location.path}:{service.location.line}"
                    message = f"nobody offers {client.name!r}; {place} offers {service.name!r}"
                    if "~" in f"{client.name}{service.name}":
                        message += ": ~ stands for the name of each node itself"
                    yield self.report(at, message)
                    break


def _is_slip(client: Endpoint, service: Endpoint) -> bool:
    """Tell whether two names of one type differ by one letter, dropped, added or changed.

    Or by ``~/`` alone, which makes a name private.
    """
    one, other = client.name, service.name
    if not isinstance(one, str) or not isinstance(other, str):
        return False
    if client.interface is None or client.interface != service.interface:
        return False
    if one.startswith("~") is not other.startswith("~"):
        return one.removeprefix("~").strip("/") == other.removeprefix("~").strip("/")
    short, long = sorted((one, other), key=len)
    if len(short) < _ALIKE or len(long) - len(short) > 1 or any(map(str.isdigit, one + other)):
        return False
    if short.strip("/") == long.strip("/"):
        return False
    same = next((i for i, letter in enumerate(short) if letter != long[i]), len(short))
    rest = same if len(long) > len(short) else same + 1
    return short[rest:] == long[same + 1 :]
