"""MS021: both ends of a topic, a service or an action have the same name."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from difflib import SequenceMatcher
from itertools import product

from scaffold.api import Diagnostic, Example, Package, Rule, Severity
from scaffold.api.launch import code_of, markup_files, started_nodes
from scaffold.api.programs import (
    NamedEndpoint,
    is_private,
    is_remapped,
    named_endpoints,
    one_sided,
    topics_of,
)
from scaffold.api.python import UNKNOWN

_SHORTEST = 5
_CLOSE = 0.85
_USUAL = {
    "lifecycle_msgs/srv/ChangeState": "change_state",
    "lifecycle_msgs/srv/GetAvailableStates": "get_available_states",
    "lifecycle_msgs/srv/GetState": "get_state",
    "rcl_interfaces/srv/DescribeParameters": "describe_parameters",
    "rcl_interfaces/srv/GetParameters": "get_parameters",
    "rcl_interfaces/srv/ListParameters": "list_parameters",
    "rcl_interfaces/srv/SetParameters": "set_parameters",
}
"""The services that every node has, or every one with a lifecycle, by type."""
_NODE = (
    "from rclpy.node import Node\nfrom std_msgs.msg import String\n\n\n"
    "class Talker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('talker')\n"
    "        self.create_{}\n"
)
_LIFECYCLE = (
    "from lifecycle_msgs.srv import GetState\nfrom rclpy.node import Node\n\n\n"
    "class Keeper(Node):\n    def __init__(self):\n        super().__init__('keeper')\n"
    "        self.create_client(GetState, 'lidar/{}')\n"
)
_MAIN = "\n\ndef main():\n    Talker()\n"
_NODE_SERVICES = (
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
_CLASS = "\n\n\nclass"
_SERVER, _, _CLIENT = _NODE_SERVICES.partition(f"{_CLASS} Caller")
_SIMILAR = 0.75
"""The minimum similarity of the names of actions; few packages serve two of a type."""
_ALIKE = 4
"""The minimum length of a name for which one different letter counts as a typo."""

_WORD = re.compile(r"[^\W_]+")
_FILES = {
    "package.xml": "<package><name>demo</name></package>\n",
    "setup.py": "from setuptools import setup\n\nsetup(name='demo', packages=['demo'],\n"
    "      entry_points={'console_scripts': ['a = demo.a:main', 'b = demo.b:main']})\n",
    "demo/a.py": _NODE.format("publisher(String, '/chatter', 10)") + _MAIN,
    "demo/b.py": _NODE.format("subscription(String, 'chatter', print, 10)") + _MAIN,
}
_STARTING = (
    "from launch import LaunchDescription\nfrom launch_ros.actions import Node\n\n\n"
    "def generate_launch_description():\n    return LaunchDescription([\n"
    "        Node(package='demo', executable='a', namespace='{}'),\n"
    "        Node(package='demo', executable='b', namespace='left'),\n    ])\n"
)


class TopicNameDiffers(Rule):
    """One end of a topic, service or action differs from the other by a letter or a ``~/``.

    **Why.** No message arrives, or the client waits forever, without an error. ``~`` expands to the
    name of the node. A name is only reported if it has no counterpart in the package, but a similar
    name of the same type exists.

    **Fix.** Use the same name on both sides, preferably from one constant. Remove ``~/``, or write
    the name of the node: ``talker/chatter``.

    **Source.** ROS 2 documentation, "Understanding topics", "Understanding services"; ROS 2 design,
    "Topic and Service name mapping to DDS", private names.
    """

    code = "MS021"
    name = "topic-name-differs"
    severity = Severity.WARNING
    examples = (
        Example(
            "a service of every node with a lifecycle",
            {
                "keeper.py": _LIFECYCLE.format("getstate"),
                "other.py": _LIFECYCLE.format("get_state"),
            },
            "keeper.py:8:38: no node has the service 'lidar/getstate'; did you mean "
            "'lidar/get_state'?",
        ),
        Example(
            "a client that expects a namespace in which no launch file starts the server",
            {
                **_FILES,
                "demo/a.py": _SERVER + "\n" + _MAIN,
                "demo/b.py": f"{_SERVER.partition(_CLASS)[0]}{_CLASS} Caller"
                + _CLIENT.format("/left/report"),
                "launch/a.launch.py": _STARTING.replace(", namespace='{}'", "").replace(
                    ", namespace='left'", ""
                ),
            },
            "demo/b.py:8:51: no service '/left/report': launch/a.launch.py:7 starts the node of "
            "'report' (demo/a.py:8) in no namespace",
        ),
        Example(
            "same topic name",
            {
                "a.py": _NODE.format("publisher(String, 'chatter', 10)"),
                "b.py": _NODE.format("subscription(String, 'chatter', print, 10)"),
            },
        ),
        Example(
            "absolute and relative topic name in a namespace",
            {**_FILES, "launch/a.launch.py": _STARTING.format("left")},
            "demo/a.py:8:39: '/chatter' leaves the namespace that launch/a.launch.py:8 gives, "
            "where demo/b.py:8 has '/left/chatter': they never connect; write 'chatter'",
        ),
        Example(
            "absolute and relative topic name without a namespace",
            {**_FILES, "launch/a.launch.py": _STARTING.format("")},
        ),
        Example(
            "topic name with a missing letter",
            {
                "a.py": _NODE.format("publisher(String, 'chatter', 10)"),
                "b.py": _NODE.format("subscription(String, 'chater', print, 10)"),
            },
            "b.py:8:42: no publisher for 'chater'; did you mean 'chatter' (a.py:8)?",
        ),
        Example(
            "topic name with its words in another order",
            {
                "a.py": _NODE.format("publisher(String, 'scan_filtered', 10)"),
                "b.py": _NODE.format("subscription(String, 'filtered/scan', print, 10)"),
            },
            "b.py:8:42: no publisher for 'filtered/scan'; did you mean 'scan_filtered' (a.py:8)?",
        ),
        Example(
            "private name of the publisher",
            {
                "a.py": _NODE.format("publisher(String, '~/chatter', 10)"),
                "b.py": _NODE.format("subscription(String, 'chatter', print, 10)"),
            },
            "b.py:8:42: no publisher for 'chatter': a.py:8 publishes '~/chatter', and ~ expands "
            "to the node name",
        ),
        Example(
            "private name of the publisher, remapped in a launch file",
            {
                "a.py": _NODE.format("publisher(String, '~/chatter', 10)"),
                "b.py": _NODE.format("subscription(String, 'chatter', print, 10)"),
                "launch/talk.launch.py": "from launch_ros.actions import Node\n\n"
                "LISTENER = Node(package='talk', executable='b',\n"
                "                remappings=[('chatter', 'a/chatter')])\n",
            },
        ),
        Example(
            "private name of the subscription",
            {
                "a.py": _NODE.format("publisher(String, 'chatter', 10)"),
                "b.py": _NODE.format("subscription(String, '~/chatter', print, 10)"),
            },
            "b.py:8:42: no publisher for '~/chatter': a.py:8 publishes 'chatter', and ~ expands "
            "to the node name",
        ),
        Example(
            "filter of a topic with a private one of the same name",
            {
                "a.py": _NODE.format(
                    "publisher(String, '~/chatter', 10)\n"
                    "        self.create_subscription(String, 'chatter', print, 10)"
                )
            },
        ),
        Example("same service name", {"nodes.py": _NODE_SERVICES.format("report")}),
        Example(
            "misspelled service name",
            {"nodes.py": _NODE_SERVICES.format("reports")},
            "17:51: no service 'reports'; did you mean 'report' (nodes.py:8)?",
        ),
        Example(
            "misspelled action name",
            {
                "server.py": "from nav2_msgs.action import Spin\n"
                "from rclpy.action import ActionServer\n\n\n"
                "def serve(node):\n    return ActionServer(node, Spin, 'rotate_base', print)\n",
                "client.py": "from nav2_msgs.action import Spin\n"
                "from rclpy.action import ActionClient\n\n\n"
                "def ask(node):\n    return ActionClient(node, Spin, 'rotate_the_base')\n",
            },
            "client.py:6:37: no service 'rotate_the_base'; did you mean 'rotate_base' "
            "(server.py:6)?",
        ),
        Example(
            "private service that forwards to an absolute one",
            {
                "nodes.py": _NODE_SERVICES.format("/report").replace(
                    "Trigger, 'report'", "Trigger, '~/report'"
                )
            },
        ),
        Example(
            "private name of the service client",
            {"nodes.py": _NODE_SERVICES.format("~/report")},
            "17:51: no service '~/report'; did you mean 'report' (nodes.py:8)? ~ expands to the "
            "node name",
        ),
        Example(
            "the only service of its type has another name",
            {
                "package.xml": "<package><name>mixer</name></package>\n",
                **{
                    f"{name}.py": "from example_interfaces.srv import AddTwoInts\n"
                    "from rclpy.node import Node\nfrom std_srvs.srv import Trigger\n\n\n"
                    f"class {name.title()}(Node):\n"
                    "    def __init__(self):\n"
                    f"        super().__init__('{name}')\n"
                    + "".join(f"        self.{line}\n" for line in lines)
                    for name, lines in {
                        "pump": (
                            "create_service(AddTwoInts, 'pump/dose', print)",
                            "create_service(Trigger, 'pump/stop', print)",
                        ),
                        "order": (
                            "create_client(AddTwoInts, 'pump/dosing')",
                            "create_client(Trigger, 'lamp/off')",
                        ),
                    }.items()
                },
            },
            "order.py:9:40: no service 'pump/dosing': the only one of type "
            "example_interfaces/srv/AddTwoInts is 'pump/dose' (pump.py:9)",
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        yield from self._check_topics(package)
        yield from self._check_private(package)
        yield from self._check_absolute(package)
        yield from self._check_services(package)

    def _check_topics(self, package: Package) -> Iterator[Diagnostic]:
        sent, awaited = one_sided(package)
        for topic in awaited:
            for other in sent:
                subscription, publisher = topic.subscriptions[0], other.publishers[0]
                if topic.is_plain and other.is_plain and _is_slip(subscription, publisher):
                    place = f"{publisher.location.path}:{publisher.location.line}"
                    message = (
                        f"no publisher for {subscription.name!r}; did you mean "
                        f"{publisher.name!r} ({place})?"
                    )
                    yield self.report(subscription.name_location, message)
                    break

    def _check_absolute(self, package: Package) -> Iterator[Diagnostic]:
        """Report absolute names in a namespace, where another node has the relative name."""
        for topic in topics_of(package).values():
            for first, second in product(topic.publishers, topic.subscriptions):
                absolute, relative = sorted((first, second), key=lambda x: x.name[:1] != "/")
                if not absolute.name.startswith("/") or relative.name.startswith("/"):
                    continue
                places = _namespaces(package, relative)
                namespace = next(iter(places)) if len(places) == 1 else None
                is_same = namespace in _namespaces(package, absolute)
                if not isinstance(namespace, str) or not is_same or not namespace.strip("/"):
                    continue
                if _is_in_markup(package, relative) or any(
                    is_remapped(package, endpoint) for endpoint in (absolute, relative)
                ):
                    continue
                other = f"{relative.location.path}:{relative.location.line}"
                name = f"/{namespace.strip('/')}/{relative.name}"
                message = (
                    f"{absolute.name!r} leaves the namespace that {places[namespace]} gives, where "
                    f"{other} has {name!r}: they never connect; "
                    f"write {absolute.name.strip('/')!r}"
                )
                yield self.report(absolute.name_location, message)

    def _check_private(self, package: Package) -> Iterator[Diagnostic]:
        sent, awaited = one_sided(package)
        for private in named_endpoints(package):
            is_sent = private.kind == "Publisher"
            if not is_sent and private.kind != "Subscription":
                continue
            if not is_private(private) or is_remapped(package, private):
                continue
            for topic in awaited if is_sent else sent:
                other = topic.subscriptions[0] if is_sent else topic.publishers[0]
                # A filter of a topic publishes the result as a private one of the same name.
                is_filter = other.location.path == private.location.path
                is_same = topic.is_plain and _is_same_but_private(other, private)
                if is_same and not is_filter and not is_remapped(package, other):
                    subscription, publisher = (other, private) if is_sent else (private, other)
                    place = f"{publisher.location.path}:{publisher.location.line}"
                    message = (
                        f"no publisher for {subscription.name!r}: {place} publishes "
                        f"{publisher.name!r}, and ~ expands to the node name"
                    )
                    yield self.report(subscription.name_location, message)
                    break

    def _check_services(self, package: Package) -> Iterator[Diagnostic]:
        endpoints = list(named_endpoints(package))
        offered = [x for x in endpoints if x.kind in {"Service", "ActionServer"}]
        wanted = [x for x in endpoints if x.kind in {"Client", "ActionClient"}]
        served = {item.name for item in offered}
        clients = {item.name for item in wanted}
        for client in wanted:
            given, usual = client.name.rpartition("/")[2], _USUAL.get(client.interface or "", "")
            if client.name not in served and given != usual and _is_close(given, usual):
                name = f"{client.name.removesuffix(given)}{usual}"
                message = f"no node has the service {client.name!r}; did you mean {name!r}?"
                yield self.report(client.name_location, message)
            meant = _only_server(package, client, offered, clients)
            if client.name not in served and meant is not None:
                place = f"{meant.location.path}:{meant.location.line}"
                message = (
                    f"no service {client.name!r}: the only one of type {client.interface} is "
                    f"{meant.name!r} ({place})"
                )
                yield self.report(client.name_location, message)
                continue
            for service in offered if client.name not in served else ():
                launched = _launched_outside(package, client, service)
                if launched:
                    message = (
                        f"no service {client.name!r}: {launched} starts the node of "
                        f"{service.name!r} ({service.location.path}:{service.location.line}) in "
                        f"no namespace"
                    )
                    yield self.report(client.name_location, message)
                    break
                # A service with a client of its own is not a misspelling of another.
                if service.name not in clients and _is_slip_services(client, service):
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


def _namespaces(package: Package, endpoint: NamedEndpoint) -> dict[object, str]:
    """Return the namespaces in which launch files start a node, each with the place of a start."""
    result: dict[object, str] = {}
    for node in started_nodes(package):
        owner = node.owner(package)
        if owner is not None and owner.path == endpoint.location.path:
            namespace = UNKNOWN if node.is_scoped else node.namespace
            result[namespace] = f"{node.launch}:{node.location.line}"
    return result


def _is_close(name: str, other: str) -> bool:
    return bool(other) and SequenceMatcher(None, name.lower(), other).ratio() >= _CLOSE


def _launched_outside(package: Package, client: NamedEndpoint, service: NamedEndpoint) -> str:
    """Return the place that starts a server without the namespace that its client expects."""
    is_same = client.name.startswith("/") and client.name.endswith(f"/{service.name}")
    if not is_same or service.name[:1] in "/~" or client.name.strip("/") == service.name:
        return ""
    if client.interface is None or client.interface != service.interface:
        return ""
    if _is_in_markup(package, service) or any(
        is_remapped(package, endpoint) for endpoint in (client, service)
    ):
        return ""
    places = _namespaces(package, service)
    known = [place for place in places if place is None or str(place).strip("/") == ""]
    return places[known[0]] if known and len(known) == len(places) else ""


def _is_in_markup(package: Package, endpoint: NamedEndpoint) -> bool:
    """Return whether launch files in XML or YAML may start a node."""
    for node in (node for file in markup_files(package) for node in file.nodes):
        if node.package is None or node.executable is None:
            return True
        code = code_of(package, node.package.value, node.executable.value)
        if code is not None and code.path == endpoint.location.path:
            return True
    return False


def _is_slip(subscription: NamedEndpoint, publisher: NamedEndpoint) -> bool:
    """Return whether two names of the same type differ by one letter, in case or in word order."""
    name, other = subscription.name.strip("/"), publisher.name.strip("/")
    if (
        subscription.interface is None
        or subscription.interface != publisher.interface
        or name == other
    ):
        return False
    if sorted(_WORD.findall(name.lower())) == sorted(_WORD.findall(other.lower())):
        return True
    short, long = sorted((name, other), key=len)
    if len(short) < _SHORTEST or len(long) - len(short) > 1 or any(map(str.isdigit, name + other)):
        return False
    same = next((i for i, letter in enumerate(short) if letter != long[i]), len(short))
    rest = same if len(long) > len(short) else same + 1
    return short[rest:] == long[same + 1 :]


def _is_same_but_private(subscription: NamedEndpoint, publisher: NamedEndpoint) -> bool:
    """Return whether two names of the same type differ only by a ``~/`` before the second."""
    if subscription.interface is None or subscription.interface != publisher.interface:
        return False
    return subscription.name.strip("/") == publisher.name.removeprefix("~/")


def _only_server(
    package: Package, client: NamedEndpoint, offered: Sequence[NamedEndpoint], clients: set[str]
) -> NamedEndpoint | None:
    """Return the only service that a client can mean: of its type, and without a client.

    The type is one of the workspace, or both names have the same namespace. Names that differ only
    by namespaces, or that are nearly the same, are left to other checks.
    """
    services = [x for x in offered if x.interface == client.interface and x.interface is not None]
    if len(services) != 1 or services[0].name in clients or client.kind != "Client":
        return None
    service, (root, name), (above, last) = (
        services[0],
        client.name.rpartition("/")[::2],
        services[0].name.rpartition("/")[::2],
    )
    is_own = package.workspace.get((client.interface or "").partition("/")[0]) is not None
    if name == last or not (is_own or (root == above and root.strip("/"))):
        return None
    is_other = service.location.path == client.location.path or "~" in client.name + service.name
    if is_other or any(is_remapped(package, x) for x in (client, service)):
        return None
    return None if _is_slip_services(client, service) else service


def _is_slip_services(client: NamedEndpoint, service: NamedEndpoint) -> bool:
    """Return whether two names of the same type differ by one letter.

    Or only by ``~/``, which makes a name private.
    """
    name, other = client.name, service.name
    if client.interface is None or client.interface != service.interface:
        return False
    if name.startswith("~") is not other.startswith("~"):
        is_same = name.removeprefix("~").strip("/") == other.removeprefix("~").strip("/")
        # A relay calls a service with the name of its own one.
        is_relay = other.startswith("~") and client.location.path == service.location.path
        return is_same and not is_relay
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
