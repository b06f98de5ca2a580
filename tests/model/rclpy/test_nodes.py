"""Facts about rclpy code: nodes, their entities, parameters, quality of service, spinning."""

from __future__ import annotations

import ast
import importlib.util
import json
import subprocess
import sys
from collections.abc import Sequence
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from scaffold import distributions
from scaffold.model.package import Package
from scaffold.model.programs.publishing import publish_calls, publish_rates
from scaffold.model.python.evaluation.values import UNKNOWN, Unknown
from scaffold.model.python.module import PythonModule
from scaffold.model.rclpy.creation import _FILTERS, _SIGNATURES
from scaffold.model.rclpy.entities import Publisher, parameter_type
from scaffold.model.rclpy.file import RclpyFile, rclpy_file
from scaffold.model.rclpy.topics.qos import PROFILES, Qos
from scaffold.source import Location, NewerSyntaxError, ParseError, Source
from scaffold.types.stubs.libraries import library_stubs
from tests import PATIENCE

TALKER = '''\
"""Publish greetings."""

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, qos_profile_sensor_data, QoSProfile
from sensor_msgs.msg import Temperature
from std_msgs.msg import String
from std_srvs.srv import Trigger


class Talker(Node):

    def __init__(self):
        super().__init__('talker')
        self.declare_parameter('topic', 'chatter')
        self.declare_parameter('rate', 4.0)
        topic = self.get_parameter('topic').value
        self.publisher = self.create_publisher(String, topic, 10)
        self.temperature = self.create_publisher(
            Temperature, 'temperature', qos_profile_sensor_data)
        self.create_subscription(String, '~/in', self.on_text, QoSProfile(
            depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL))
        self.service = self.create_service(Trigger, 'report', self.on_report)
        self.client = self.create_client(srv_type=Trigger, srv_name='other')
        self.timer = self.create_timer(1.0 / self.get_parameter('rate').value, self.on_timer)

    def on_timer(self):
        self.publisher.publish(String(data='hello'))

    def on_text(self, msg):
        pass

    def on_report(self, request, response):
        return response


def main(args=None):
    try:
        rclpy.init(args=args)
        rclpy.spin(Talker())
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        rclpy.try_shutdown()


if __name__ == '__main__':
    main()
'''


def publish_rate(view: RclpyFile, publisher: Publisher) -> float | Unknown:
    """Return the rate in Hz, if it is known and there is a single one."""
    rates = publish_rates(view, publisher)
    return rates[0] if rates and len(rates) == 1 else UNKNOWN


def facts(text: str, path: str = "demo/talker.py") -> RclpyFile:
    return RclpyFile(PythonModule.parse(Source(path, text)))


def node(body: str, head: str = "") -> RclpyFile:
    """Return the facts of a node class whose constructor has these lines."""
    lines = "".join(f"        {line}\n" for line in body.splitlines())
    return facts(
        "import rclpy\nfrom rclpy.node import Node\nfrom std_msgs.msg import String\n"
        f"{head}\n\nclass Talker(Node):\n    def __init__(self):\n"
        f"        super().__init__('talker')\n{lines}"
    )


def place(at: Location) -> tuple[int, int, int, int]:
    return at.line, at.column, at.end_line, at.end_column


# -- nodes


def test_node_class() -> None:
    view = facts(TALKER)
    (talker,) = view.classes
    assert (talker.name, place(talker.location)) == ("Talker", (12, 7, 12, 13))
    assert (talker.node_name, place(talker.node_name_location)) == ("talker", (15, 26, 15, 34))
    assert talker.calls_super_init
    assert not talker.is_lifecycle
    assert talker.namespace is None
    assert not talker.declares_automatically
    assert list(talker.methods) == ["__init__", "on_timer", "on_text", "on_report"]
    assert [len(kind) for kind in (talker.publishers, talker.subscriptions, talker.timers)] == [
        2,
        1,
        1,
    ]
    assert view.objects == []


@pytest.mark.parametrize(
    ("head", "base", "lifecycle"),
    [
        ("from rclpy.node import Node", "Node", False),
        ("from rclpy.node import Node as N", "N", False),
        ("import rclpy.node", "rclpy.node.Node", False),
        ("import rclpy.node as rn", "rn.Node", False),
        ("from rclpy import node", "node.Node", False),
        ("from rclpy.lifecycle import LifecycleNode", "LifecycleNode", True),
        ("from rclpy.lifecycle import Node", "Node", True),
        ("import rclpy.lifecycle", "rclpy.lifecycle.Node", True),
        ("from rclpy.node import Node\nclass Base(Node): pass", "Base", False),
        ("from rclpy.lifecycle import Node\nclass A(Node): pass\nclass B(A): pass", "B", True),
        (
            "try:\n    from rclpy.node import Node\nexcept ImportError:\n    Node = object",
            "",
            False,
        ),
        ("from rclpy.node import Node\nclass Mixin: pass", "Mixin, Node", False),
    ],
)
def test_spellings_of_the_base_class(head: str, base: str, *, lifecycle: bool) -> None:
    view = facts(f"{head}\nclass Talker({base}):\n    pass\n")
    result = [(item.name, item.is_lifecycle) for item in view.classes]
    assert (("Talker", lifecycle) in result) is bool(base)


def test_class_that_inherits_from_itself_is_no_node() -> None:
    assert facts("class A(B): pass\nclass B(A): pass\nclass C(C): pass\n").classes == []


@pytest.mark.parametrize(
    ("constructor", "calls", "name"),
    [
        ("super().__init__('a')", True, "a"),
        ("super(Talker, self).__init__('a')", True, "a"),
        ("super().__init__(node_name='a', namespace='b')", True, "a"),
        ("Node.__init__(self, 'a')", True, "a"),
        ("Other.__init__(self, 'b')\n        Node.__init__(self, 'a')", True, "a"),
        ("super().__init__('a' + suffix)", True, UNKNOWN),
        ("super().__init__(*args)", True, UNKNOWN),
        ("self.init()", False, UNKNOWN),
        ("def later():\n            super().__init__('a')", False, UNKNOWN),
    ],
)
def test_calls_of_the_base_constructor(constructor: str, name: object, *, calls: bool) -> None:
    view = facts(
        "from rclpy.node import Node\nclass Talker(Node):\n    def __init__(self, *args):\n"
        f"        {constructor}\n"
    )
    (talker,) = view.classes
    assert talker.calls_super_init is calls
    assert talker.node_name == name


def test_constructor_of_a_mixin_is_called_first() -> None:
    text = (
        "from rclpy.node import Node\nclass Mixin:\n    {}\n"
        "class Talker(Mixin, Node):\n    def __init__(self):\n        super().__init__('a')\n"
    )
    with_own = facts(text.format("def __init__(self, x): pass")).classes[0]
    without = facts(text.format("pass")).classes[0]
    assert (with_own.node_name, without.node_name) == (UNKNOWN, "a")


@pytest.mark.parametrize(
    ("signature", "calls", "expected"),
    [
        ("name", "Talker('a')", "a"),
        ("name", "Talker(name='a')", "a"),
        ("name='a'", "Talker()", "a"),
        ("*, name='a'", "Talker(name='b')", "b"),
        ("name", "Talker('a')\nTalker('a')", "a"),
        ("name", "Talker('a')\nTalker('b')", UNKNOWN),
        ("name='a'", "pass", UNKNOWN),
        ("name", "Talker(**options)", UNKNOWN),
        ("name", "Talker('a')\nmake(Talker)", UNKNOWN),
    ],
)
def test_name_through_the_constructor(signature: str, calls: str, expected: object) -> None:
    view = facts(
        f"from rclpy.node import Node\nclass Talker(Node):\n    def __init__(self, {signature}):\n"
        f"        super().__init__(name)\n{calls}\n"
    )
    assert view.classes[0].node_name == expected


def test_name_through_a_base_class() -> None:
    view = facts(
        "from rclpy.node import Node\nclass Base(Node):\n    def __init__(self, name):\n"
        "        super().__init__(name)\nclass A(Base):\n    def __init__(self):\n"
        "        super().__init__('a')\nclass B(Base):\n    def __init__(self, name):\n"
        "        super().__init__(name + '_b')\nclass C(A):\n    pass\nB('x')\n"
    )
    assert {item.name: item.node_name for item in view.classes} == {
        "Base": UNKNOWN,
        "A": "a",
        "B": "x_b",
        "C": "a",
    }


def test_base_class_in_another_file_of_the_package() -> None:
    base = (
        "from rclpy.lifecycle import LifecycleNode\nclass Base(LifecycleNode):\n"
        "    def __init__(self):\n        super().__init__('base')\n"
        "        self.declare_parameter('rate', 2.0)\n"
    )
    derived = (
        "from demo.base import Base\nclass Talker(Base):\n    def on(self):\n"
        "        self.create_timer(1 / self.get_parameter('rate').value, self.tick)\n"
    )
    package = Package.of({"demo/base.py": base, "demo/talker.py": derived})
    view = rclpy_file(package, "demo/talker.py")
    (talker,) = view.classes
    assert (talker.is_lifecycle, talker.node_name) == (True, "base")
    assert talker.base is not None
    assert talker.base.file is rclpy_file(package, "demo/base.py")
    assert [(timer.period, set(timer.from_parameters)) for timer in talker.timers] == [
        (0.5, {"rate"})
    ]


def test_relative_import_of_base_and_import_cycle() -> None:
    package = Package.of(
        {
            "demo/a.py": "from .b import B\nclass A(B): pass\n",
            "demo/b.py": "from .a import A\nclass B(A): pass\n",
            "demo/c.py": "from ..demo.d import D\nclass C(D): pass\n",
            "demo/d.py": "from rclpy.node import Node\nclass D(Node): pass\n",
        }
    )
    assert rclpy_file(package, "demo/a.py").classes == []
    assert [item.name for item in rclpy_file(package, "demo/c.py").classes] == ["C"]


def test_node_without_a_class() -> None:
    view = facts(
        "import rclpy\nfrom std_msgs.msg import String\n\n\ndef main():\n    rclpy.init()\n"
        "    node = rclpy.create_node('a', namespace='b')\n"
        "    publisher = node.create_publisher(String, 'chatter', 10)\n"
        "    node.create_timer(0.5, lambda: publisher.publish(String()))\n"
    )
    (item,) = view.objects
    assert (item.name, item.node_name, item.namespace) == ("node", "a", "b")
    assert place(item.node_name_location) == (7, 30, 7, 33)
    (publisher,) = item.publishers
    assert (publisher.topic, publisher.variable, publisher.attribute) == (
        "chatter",
        "publisher",
        None,
    )
    assert publisher.owner is item
    assert publish_rate(view, publisher) == 2.0


def test_node_kept_in_an_attribute() -> None:
    view = facts(
        "import rclpy\nfrom std_msgs.msg import String\nclass App:\n    def __init__(self):\n"
        "        self.node = None\n        self.node = rclpy.create_node('a')\n"
        "        self.node.create_publisher(String, 'b', 1)\n"
    )
    assert [item.name for item in view.objects] == ["node"]
    assert view.publishers[0].owner is view.objects[0]


def test_unknown_owner() -> None:
    view = facts("import rclpy\ndef f(node):\n    node.create_publisher(str, 'a', 1)\n")
    assert [(item.topic, item.owner) for item in view.publishers] == [("a", None)]


def test_same_methods_of_other_objects_are_ignored() -> None:
    assert facts("import boto3\nboto3.create_client('a', 'b')\n").entities == []


# -- endpoints


def test_publishers() -> None:
    chatter, temperature = facts(TALKER).publishers
    assert (chatter.message_type, chatter.topic, chatter.from_parameter) == (
        "std_msgs/msg/String",
        "chatter",
        "topic",
    )
    assert (chatter.attribute, chatter.function and chatter.function.name) == (
        "publisher",
        "__init__",
    )
    assert place(chatter.location) == (19, 26, 19, 66)
    assert {name: place(item.location) for name, item in chatter.arguments.items()} == {
        "msg_type": (19, 48, 19, 54),
        "topic": (19, 56, 19, 61),
        "qos_profile": (19, 63, 19, 65),
    }
    assert (temperature.message_type, temperature.from_parameter) == (
        "sensor_msgs/msg/Temperature",
        None,
    )


def test_subscription_service_and_client() -> None:
    view = facts(TALKER)
    (subscription,) = view.subscriptions
    assert (subscription.topic, subscription.message_type) == ("~/in", "std_msgs/msg/String")
    assert subscription.callback is not None
    assert (subscription.callback.name, subscription.callback.is_bound) == ("on_text", True)
    (service,) = view.services
    assert (service.name, service.interface, service.attribute) == (
        "report",
        "std_srvs/srv/Trigger",
        "service",
    )
    assert service.callback is not None
    assert isinstance(service.callback.function, ast.FunctionDef)
    assert service.callback.function.name == "on_report"
    (client,) = view.clients
    assert (client.name, client.interface) == ("other", "std_srvs/srv/Trigger")
    assert client.name_argument is not None
    assert place(client.name_argument.location) == (25, 69, 25, 76)


def test_actions() -> None:
    view = node(
        "self.server = ActionServer(self, Fibonacci, 'fibonacci', self.execute)\n"
        "self.client = ActionClient(self, Fibonacci, action_name='other')",
        "from rclpy.action import ActionClient, ActionServer\n"
        "from example_interfaces.action import Fibonacci",
    )
    (talker,) = view.classes
    (server,) = talker.action_servers
    (client,) = talker.action_clients
    assert (server.name, server.interface) == ("fibonacci", "example_interfaces/action/Fibonacci")
    assert server.callback is not None
    assert server.callback.name == "execute"
    assert (client.name, client.attribute) == ("other", "client")


@pytest.mark.parametrize(
    ("head", "expression", "expected"),
    [
        ("import std_msgs.msg", "std_msgs.msg.String", "std_msgs/msg/String"),
        ("import std_msgs.msg as m", "m.String", "std_msgs/msg/String"),
        ("from std_msgs import msg", "msg.String", "std_msgs/msg/String"),
        ("from std_msgs.msg._string import String as S", "S", "std_msgs/msg/String"),
        ("from std_msgs.msg import String as S\nKIND = S", "KIND", "std_msgs/msg/String"),
        ("from demo.text import String as S", "S", None),
        ("", "'std_msgs/msg/String'", None),
        ("", "unknown", None),
    ],
)
def test_interface_types(head: str, expression: str, expected: str | None) -> None:
    view = node(f"self.create_publisher({expression}, 'a', 1)", head)
    assert view.publishers[0].message_type == expected


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        ("self.create_publisher(String, 'a/' + 'b', 1)", "a/b"),
        ("name = 'a'\nself.create_publisher(String, f'{name}/b', 1)", "a/b"),
        ("self.name = 'a'\nself.create_publisher(String, self.name, 1)", "a"),
        ("self.name = 'a'\nself.name = 'b'\nself.create_publisher(String, self.name, 1)", UNKNOWN),
        ("self.create_publisher(String, TOPIC, 1)", "constant"),
        ("self.create_publisher(String, self.KIND, 1)", UNKNOWN),
        ("self.create_publisher(String, Talker.TEXT, 1)", UNKNOWN),
        ("for name in names():\n    self.create_publisher(String, name, 1)", UNKNOWN),
        ("self.create_publisher(topic='a', msg_type=String, qos_profile=1)", "a"),
        ("self.create_publisher(*arguments)", UNKNOWN),
        ("self.name, other = 'a', 'b'\nself.create_publisher(String, self.name, 1)", "a"),
        ("self.name: str = 'a'\nself.create_publisher(String, self.name, 1)", "a"),
        ("self.create_publisher(String, self._name('a'), 1)", UNKNOWN),
    ],
)
def test_topic_of_publisher(body: str, expected: object) -> None:
    assert node(body, "TOPIC = 'constant'").publishers[0].topic == expected


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        ("for name in ('a', 'b'):\n    create(String, name, 1)", ["a", "b"]),
        ("self.all = [create(String, name, 1) for name in ('a', 'b')]", ["a", "b"]),
        ("for name, kind in TOPICS.items():\n    create(kind, name, 1)", ["a", "b"]),
        ("for name in ('a', 'b'):\n    if wanted(name):\n        create(String, name, 1)", []),
        (
            "for name in ('a', 'b'):\n    if not name:\n        break\n    create(String, name, 1)",
            [],
        ),
        ("self.all = [create(String, name, 1) for name in ('a', 'b') if name]", []),
        ("if self.all:\n    for name in ('a', 'b'):\n        create(String, name, 1)", []),
        ("for name in self.declare_parameter('n', ['a']).value:\n    create(String, name, 1)", []),
        ("for name, kind in (('a', String), *MORE):\n    create(kind, name, 1)", []),
    ],
)
def test_topics_of_a_table(body: str, expected: Sequence[str]) -> None:
    view = node(
        body.replace("create", "self.create_publisher"), "TOPICS = {'a': String, 'b': String}"
    )
    assert [item.topic for item in view.publishers if not item.is_conditional] == expected


def test_topic_from_class_constant() -> None:
    text = (
        "import rclpy\nfrom rclpy.node import Node\nclass Talker(Node):\n    TOPIC = 'a'\n"
        "    def __init__(self):\n        super().__init__('t')\n"
        "        self.create_publisher(str, self.TOPIC, 1)\n"
    )
    assert facts(text).publishers[0].topic == "a"
    assert facts(text + "def f(node):\n    node.TOPIC = 'b'\n").publishers[0].topic == UNKNOWN
    assert facts(text + "class Other:\n    TOPIC = 'b'\n").publishers[0].topic == "a"
    assert facts(text + "class Sub(Talker):\n    TOPIC = 'b'\n").publishers[0].topic == UNKNOWN


def test_argument_of_a_private_helper() -> None:
    text = (
        "import rclpy\nfrom rclpy.node import Node\nclass Talker(Node):\n    def __init__(self):\n"
        "        super().__init__('t')\n        self.{0}('a')\n{1}"
        "    def {0}(self, topic):\n        self.create_publisher(str, topic, 1)\n"
    )
    assert facts(text.format("_make", "")).publishers[0].topic == "a"
    assert facts(text.format("make", "")).publishers[0].topic is UNKNOWN
    twice = text.format("_make", "        self._make('b')\n")
    assert facts(twice).publishers[0].topic is UNKNOWN


def test_missing_and_unknown_arguments() -> None:
    view = node("self.create_publisher(String, 'a')\nself.create_publisher(String, *more, **even)")
    first, second = view.publishers
    assert (first.qos, first.has_unknown_arguments) == (None, False)
    assert (second.qos, second.has_unknown_arguments) == (None, True)


def test_swapped_arguments_are_kept_as_written() -> None:
    view = node("self.create_publisher('a', String, 1)\nself.create_timer(self.tick, 0.5)")
    (publisher,) = view.publishers
    assert publisher.type_argument is not None
    assert publisher.type_argument.value == "a"
    assert (publisher.message_type, publisher.topic) == (None, UNKNOWN)
    (timer,) = view.timers
    callback = timer.argument("callback")
    assert callback is not None
    assert (timer.period, callback.value) == (UNKNOWN, 0.5)


@pytest.mark.parametrize(
    ("body", "conditional"),
    [
        ("self.create_timer(1, f)", False),
        ("with lock:\n    self.create_timer(1, f)", False),
        ("try:\n    self.create_timer(1, f)\nfinally:\n    pass", False),
        ("if wanted:\n    self.create_timer(1, f)", True),
        ("for _ in range(2):\n    self.create_timer(1, f)", True),
        ("timers = [self.create_timer(1, f) for f in functions]", True),
        ("later = lambda: self.create_timer(1, f)", True),
        ("try:\n    pass\nexcept OSError:\n    self.create_timer(1, f)", True),
    ],
)
def test_conditional_entities(body: str, *, conditional: bool) -> None:
    assert node(body).timers[0].is_conditional is conditional


# -- quality of service


@pytest.mark.parametrize(
    ("expression", "expected"),
    [
        ("10", (None, 10, "KEEP_LAST", "RELIABLE", "VOLATILE")),
        ("DEPTH", (None, 3, "KEEP_LAST", "RELIABLE", "VOLATILE")),
        ("qos.qos_profile_sensor_data", ("sensor_data", 5, "KEEP_LAST", "BEST_EFFORT", "VOLATILE")),
        (
            "qos.QoSPresetProfiles.PARAMETERS.value",
            ("parameters", 1000, "KEEP_LAST", "RELIABLE", "VOLATILE"),
        ),
        (
            "qos.QoSPresetProfiles.get_from_short_key('sensor_data')",
            ("sensor_data", 5, "KEEP_LAST", "BEST_EFFORT", "VOLATILE"),
        ),
        ("qos.QoSProfile(depth=4)", (None, 4, "KEEP_LAST", "RELIABLE", "VOLATILE")),
        (
            "qos.QoSProfile(depth=1, durability=qos.QoSDurabilityPolicy.TRANSIENT_LOCAL)",
            (None, 1, "KEEP_LAST", "RELIABLE", "TRANSIENT_LOCAL"),
        ),
        (
            "qos.QoSProfile(depth=1, reliability=qos.ReliabilityPolicy.BEST_EFFORT)",
            (None, 1, "KEEP_LAST", "BEST_EFFORT", "VOLATILE"),
        ),
        (
            "qos.QoSProfile(reliability=qos.ReliabilityPolicy.RMW_QOS_POLICY_RELIABILITY_BEST_EFFORT)",
            (None, None, "KEEP_LAST", "BEST_EFFORT", "VOLATILE"),
        ),
        (
            "qos.QoSProfile(durability=qos.DurabilityPolicy.VOLATILE)",
            (None, None, "KEEP_LAST", "RELIABLE", "VOLATILE"),
        ),
        (
            "qos.QoSProfile(history=qos.HistoryPolicy.KEEP_ALL)",
            (None, 10, "KEEP_ALL", "RELIABLE", "VOLATILE"),
        ),
        ("qos.QoSProfile(depth=depth())", (None, UNKNOWN, "KEEP_LAST", "RELIABLE", "VOLATILE")),
        ("qos.QoSProfile(**options)", (None, UNKNOWN, UNKNOWN, UNKNOWN, UNKNOWN)),
        ("make_qos()", (None, UNKNOWN, UNKNOWN, UNKNOWN, UNKNOWN)),
        ("PROFILE", (None, 7, "KEEP_LAST", "RELIABLE", "VOLATILE")),
    ],
)
def test_qos_of_publisher(expression: str, expected: Sequence[object]) -> None:
    view = node(
        f"self.create_publisher(String, 'a', {expression})",
        "from rclpy import qos\nDEPTH = 3\nPROFILE = qos.QoSProfile(depth=7)",
    )
    assert tuple(view.publishers[0].qos or ())[1:] == expected


def qos_after(body: str) -> Qos:
    result = node(body, "from rclpy.qos import DurabilityPolicy, QoSProfile").publishers[0].qos
    assert result is not None
    return result


def test_qos_changed_before_the_use() -> None:
    result = qos_after(
        "qos = QoSProfile(depth=1)\nqos.depth = 5\n"
        "qos.durability = DurabilityPolicy.TRANSIENT_LOCAL\n"
        "self.create_publisher(String, 'a', qos)"
    )
    assert (result.depth, result.durability) == (5, "TRANSIENT_LOCAL")


def test_qos_changed_after_use_or_conditionally() -> None:
    after = qos_after(
        "qos = QoSProfile(depth=1)\nself.create_publisher(String, 'a', qos)\nqos.depth = 5"
    )
    perhaps = qos_after(
        "qos = QoSProfile(depth=1)\nif many:\n    qos.depth = 5\n"
        "self.create_publisher(String, 'a', qos)"
    )
    other = qos_after(
        "qos = QoSProfile(depth=1)\nother = QoSProfile(depth=2)\nother.depth = 5\n"
        "self.create_publisher(String, 'a', qos)"
    )
    assert (after.depth, perhaps.depth, other.depth) == (1, UNKNOWN, 1)


# -- timers and parameters


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        ("self.create_timer(0.5, self.f)", 0.5),
        ("self.create_timer(timer_period_sec=2, callback=self.f)", 2),
        ("period = 1 / 4\nself.create_timer(period, self.f)", 0.25),
        ("self.rate = 10.0\nself.create_timer(1.0 / self.rate, self.f)", 0.1),
        ("self.create_timer(period(), self.f)", UNKNOWN),
        ("self.create_timer(True, self.f)", UNKNOWN),
        ("self.create_timer('1', self.f)", UNKNOWN),
    ],
)
def test_timer_periods(body: str, expected: object) -> None:
    assert node(body).timers[0].period == expected


@pytest.mark.parametrize(
    ("body", "expected"),
    [
        ("self.declare_parameter('p', 2.0)\nx = self.get_parameter('p').value", 2.0),
        ("x = self.declare_parameter('p', 2.0).value", 2.0),
        (
            (
                "self.declare_parameter('p', 2.0)\n"
                "x = self.get_parameter('p').get_parameter_value().double_value"
            ),
            2.0,
        ),
        (
            (
                "self.declare_parameter('p', 2)\n"
                "x = self.get_parameter('p').get_parameter_value().double_value"
            ),
            UNKNOWN,
        ),
        (
            (
                "self.declare_parameters(namespace='', parameters=[('p', 2.0), ('q', 'a')])\n"
                "x = self.get_parameter('p').value"
            ),
            2.0,
        ),
        (
            "self.declare_parameters('n', [('p', 2.0)])\nx = self.get_parameter('n.p').value",
            2.0,
        ),
        ("p = self.declare_parameter('p', 2.0)\nx = p.value", 2.0),
        ("self.p = self.declare_parameter('p', 2.0)\nx = self.p.value", 2.0),
        ("self.declare_parameter('p', 2.0)\nx = float(self.get_parameter(name='p').value)", 2.0),
        ("self.declare_parameter('p')\nx = self.get_parameter('p').value", UNKNOWN),
        ("x = self.get_parameter('p').value", UNKNOWN),
        (
            (
                "self.declare_parameter('p', 2.0)\nself.declare_parameter('p', 3.0)\n"
                "x = self.get_parameter('p').value"
            ),
            UNKNOWN,
        ),
        ("self.declare_parameter('p', 2.0)\nx = self.get_parameter('p')", UNKNOWN),
        ("self.declare_parameter(self.get_parameter('p').value, 2.0)\nx = 1 / 2", 0.5),
    ],
)
def test_parameter_values(body: str, expected: object) -> None:
    view = node(f"{body}\nself.create_timer(x, self.f)")
    assert view.timers[0].period == expected
    depends = expected is not UNKNOWN and "x = 1 / 2" not in body
    assert bool(view.timers[0].from_parameters) is depends


def test_parameters_of_another_node_are_ignored() -> None:
    view = facts(
        "import rclpy\nfrom rclpy.node import Node\nclass A(Node):\n    def __init__(self):\n"
        "        super().__init__('a')\n        self.declare_parameter('p', 1.0)\n"
        "class B(Node):\n    def __init__(self):\n        super().__init__('b')\n"
        "        self.create_timer(self.get_parameter('p').value, self.f)\n"
    )
    assert view.timers[0].period is UNKNOWN


def test_declared_parameters() -> None:
    view = node(
        "self.declare_parameter('a', 1.0)\nself.declare_parameter('b')\n"
        "self.declare_parameter('c', Parameter.Type.STRING_ARRAY)\n"
        "self.declare_parameters('n', [('d', []), ('e', f())])\n"
        "self.declare_parameter(name(), value='x', descriptor=d)",
        "from rclpy.parameter import Parameter",
    )
    assert [
        (item.name, item.default, item.default_node is not None, item.type)
        for item in view.parameters
    ] == [
        ("a", 1.0, True, "double"),
        ("b", UNKNOWN, False, None),
        ("c", UNKNOWN, True, "string_array"),
        ("n.d", [], True, "byte_array"),
        ("n.e", UNKNOWN, True, None),
        (UNKNOWN, "x", True, "string"),
    ]
    assert [place(item.name_location) for item in view.parameters[3:5]] == [
        (12, 40, 12, 43),
        (12, 51, 12, 54),
    ]


def test_parameter_reads() -> None:
    view = node("self.get_parameter('a')\nself.get_parameter_or('b', None)\nself.has_parameter(c)")
    assert [(item.method, item.name) for item in view.parameter_reads] == [
        ("get_parameter", "a"),
        ("get_parameter_or", "b"),
        ("has_parameter", UNKNOWN),
    ]


@pytest.mark.parametrize(
    ("value", "expected"),
    [
        (True, "bool"),
        (1, "integer"),
        (1.0, "double"),
        ("a", "string"),
        ([1, 2], "integer_array"),
        ([True], "bool_array"),
        ([1, 2.0], None),
        ([], "byte_array"),
        (None, None),
        (UNKNOWN, None),
        ({}, None),
    ],
)
def test_parameter_type(value: object, expected: str | None) -> None:
    assert parameter_type(value) == expected


@pytest.mark.parametrize(
    "argument",
    [
        "allow_undeclared_parameters=True",
        "automatically_declare_parameters_from_overrides=flag",
        "**options",
    ],
)
def test_automatic_parameter_declaration(argument: str) -> None:
    view = facts(
        "from rclpy.node import Node\nclass A(Node):\n    def __init__(self):\n"
        f"        super().__init__('a', {argument})\n"
    )
    assert view.classes[0].declares_automatically


# -- callbacks


@pytest.mark.parametrize(
    ("expression", "name", "line", "called", "bound", "partial"),
    [
        ("self.tick", "tick", 9, False, True, False),
        ("self.tick()", "tick", None, True, True, False),
        ("self.give()", "give", None, False, True, False),
        ("self.still", "still", 13, False, False, False),
        ("tick", "tick", 15, False, False, False),
        ("partial(self.tick, 1)", "tick", 9, False, True, True),
        ("functools.partial(tick)", "tick", 15, False, False, True),
        ("lambda: None", None, 8, False, False, False),
        ("self.missing", "missing", None, False, False, False),
        ("table['a']", None, None, False, False, False),
    ],
)
def test_callback_of_timer(
    expression: str, name: str | None, line: int | None, *, called: bool, bound: bool, partial: bool
) -> None:
    view = facts(
        "import functools\nfrom functools import partial\nimport rclpy\n"
        "from rclpy.node import Node\nclass Talker(Node):\n    def __init__(self):\n"
        f"        super().__init__('t')\n        self.create_timer(1, {expression})\n"
        "    def tick(self):\n        pass\n    def give(self): return self.tick\n"
        "    @staticmethod\n    def still(): pass\n\ndef tick(): pass\n"
    )
    result = view.timers[0].callback
    assert result is not None
    assert result.name == name
    assert (result.function.lineno if result.function else None) == line
    assert (result.is_called, result.is_bound, result.is_partial) == (called, bound, partial)
    assert place(result.location) == (8, 30, 8, 30 + len(expression))


def test_functions_called_by_a_callback() -> None:
    view = facts(
        "import rclpy\nfrom rclpy.node import Node\nclass Talker(Node):\n    def __init__(self):\n"
        "        super().__init__('t')\n        self.create_timer(1, self.a)\n"
        "    def a(self):\n        self.b()\n        helper()\n"
        "    def b(self): self.a()\n    def c(self): pass\n"
        "def helper(): later = lambda: deepest()\ndef deepest(): pass\n"
    )
    ((entity, callback),) = view.callbacks
    assert entity is view.timers[0]
    assert callback.function is not None
    names = [getattr(item, "name", "lambda") for item in view.reached(callback.function)]
    assert names == ["a", "b", "helper"]
    assert [view.module.text(call) for call in view.calls_in(callback.function)] == [
        "self.b()",
        "helper()",
    ]


# -- running


def test_calls_of_init_spin_and_shutdown() -> None:
    view = facts(TALKER)
    assert [(call.name, place(call.location)) for call in view.rclpy_calls] == [
        ("init", (40, 9, 40, 30)),
        ("spin", (41, 9, 41, 29)),
        ("try_shutdown", (45, 9, 45, 29)),
    ]
    (spin,) = view.spin_calls
    assert spin.handlers == {"KeyboardInterrupt", "rclpy.executors.ExternalShutdownException"}
    assert spin.catches_keyboard_interrupt
    assert spin.function is not None
    assert spin.function.name == "main"
    (shutdown,) = view.shutdown_calls
    assert shutdown.in_finally
    assert not shutdown.handlers


@pytest.mark.parametrize(
    ("body", "keyboard", "external"),
    [
        ("rclpy.spin(n)", False, False),
        ("try:\n    rclpy.spin(n)\nexcept KeyboardInterrupt:\n    pass", True, False),
        ("try:\n    rclpy.spin(n)\nexcept:\n    pass", True, True),
        ("try:\n    rclpy.spin(n)\nexcept Exception:\n    pass", False, True),
        ("try:\n    rclpy.spin(n)\nexcept BOTH:\n    pass", True, True),
        ("with suppress(KeyboardInterrupt):\n    rclpy.spin(n)", True, False),
        ("try:\n    pass\nexcept KeyboardInterrupt:\n    rclpy.spin(n)", False, False),
        (
            "try:\n    try:\n        rclpy.spin(n)\n    finally:\n        x()\nexcept:\n    pass",
            True,
            True,
        ),
    ],
)
def test_exception_handlers_around_spin(body: str, *, keyboard: bool, external: bool) -> None:
    lines = "".join(f"    {line}\n" for line in body.splitlines())
    view = facts(
        "import rclpy\nfrom contextlib import suppress\n"
        "from rclpy.executors import ExternalShutdownException\n"
        f"BOTH = (KeyboardInterrupt, ExternalShutdownException)\ndef main():\n{lines}"
    )
    (spin,) = view.spin_calls
    assert spin.catches_keyboard_interrupt is keyboard
    names = {"rclpy.executors.ExternalShutdownException", "Exception", "BaseException"}
    assert (not spin.handlers.isdisjoint(names)) is external


def test_exception_handlers_around_callers_of_spin() -> None:
    text = (
        "import rclpy\ndef run(): rclpy.spin(1)\n"
        "def main():\n    try:\n        run()\n    except KeyboardInterrupt:\n        pass\n"
    )
    (spin,) = facts(text).spin_calls
    assert not spin.handlers
    assert spin.outer_handlers == {"KeyboardInterrupt"}
    (twice,) = facts(text + "run()\n").spin_calls
    assert twice.outer_handlers == set()


def test_executors_and_init_as_context_manager() -> None:
    view = facts(
        "import rclpy\nfrom rclpy.executors import MultiThreadedExecutor\n"
        "def main():\n    with rclpy.init(args=None) as context:\n"
        "        executor = MultiThreadedExecutor()\n        executor.spin()\n"
        "        other.spin()\n    if rclpy.ok():\n        rclpy.shutdown()\n"
    )
    assert [(call.name, call.in_with, call.asks_ok) for call in view.rclpy_calls] == [
        ("init", True, False),
        ("executor.spin", True, False),
        ("shutdown", False, True),
    ]


# -- rate of publishing


def rate(methods: str, constructor: str = "") -> object:
    view = facts(
        "import rclpy\nfrom rclpy.node import Node\nfrom std_msgs.msg import String\n\n\n"
        "class Talker(Node):\n    def __init__(self):\n        super().__init__('talker')\n"
        "        self.pub = self.create_publisher(String, 'a', 1)\n"
        "        self.timer = self.create_timer(0.5, self.tick)\n"
        + "".join(f"        {line}\n" for line in constructor.splitlines())
        + "".join(f"    {line}\n" for line in methods.splitlines())
    )
    return publish_rate(view, view.publishers[0])


@pytest.mark.parametrize(
    "methods",
    [
        "def tick(self):\n    self.pub.publish(String())",
        "def tick(self):\n    self.send()\ndef send(self):\n    self.pub.publish(String())",
        "def tick(self):\n    with self.lock:\n        self.pub.publish(String())",
        (
            "def tick(self):\n    if self.pub.get_subscription_count():\n        pass\n"
            "    self.pub.publish(String())"
        ),
        "def tick(self):\n    self.pub.publish(String())\n    return",
        "def tick(self):\n    def inner():\n        return 1\n    self.pub.publish(String())",
        (
            "def tick(self):\n    self.pub.publish(String())\n"
            "def other(self):\n    self.timer.is_ready()"
        ),
    ],
)
def test_publish_rate(methods: str) -> None:
    assert rate(methods) == 2.0


@pytest.mark.parametrize(
    ("methods", "constructor"),
    [
        ("def tick(self):\n    if self.on:\n        self.pub.publish(String())", ""),
        (
            "def tick(self):\n    if not self.on:\n        return\n    self.pub.publish(String())",
            "",
        ),
        ("def tick(self):\n    self.on and self.pub.publish(String())", ""),
        ("def tick(self):\n    for m in self.all:\n        self.pub.publish(m)", ""),
        ("def tick(self):\n    self.pub.publish(1)\n    self.pub.publish(2)", ""),
        (
            "def tick(self):\n    self.pub.publish(1)\ndef on_text(self):\n    self.pub.publish(2)",
            "",
        ),
        ("def tick(self):\n    self.pub.publish(1)\n    self.timer.cancel()", ""),
        ("def tick(self):\n    helper(self.pub)", ""),
        (
            "def tick(self):\n    self.a()\n    self.a()\ndef a(self):\n    self.pub.publish(1)",
            "",
        ),
        ("def tick(self):\n    pass", ""),
        ("def tick(self):\n    self.pub.publish(1)", "self.create_timer(1, self.tick)"),
        ("def tick(self):\n    self.pub.publish(1)", "self.pub = None"),
        ("def tick(self):\n    self.pub.publish(1)", "self.call_later(self.tick)"),
        (
            "def tick(self):\n    try:\n        x()\n        self.pub.publish(1)\n    except E: x",
            "",
        ),
        ("def tick(self):\n    self.pub.publish(1)\ndef tick(self):\n    pass", ""),
    ],
)
def test_unknown_publish_rate(methods: str, constructor: str) -> None:
    assert rate(methods, constructor) is UNKNOWN


def test_publish_rate_of_conditional_timer_or_lifecycle_publisher() -> None:
    view = node(
        "self.pub = self.create_publisher(String, 'a', 1)\nif slow:\n"
        "    self.create_timer(1, lambda: self.pub.publish(String()))"
    )
    assert publish_rate(view, view.publishers[0]) is UNKNOWN
    view = node(
        "self.pub = self.create_lifecycle_publisher(String, 'a', 1)\n"
        "self.create_timer(1, lambda: self.pub.publish(String()))"
    )
    assert publish_rate(view, view.publishers[0]) is UNKNOWN


def test_calls_that_publish() -> None:
    view = facts(TALKER)
    chatter, temperature = view.publishers
    assert [view.module.text(call) for call in publish_calls(view, chatter) or ()] == [
        "self.publisher.publish(String(data='hello'))"
    ]
    assert publish_calls(view, temperature) == []
    assert publish_rate(view, chatter) == 4.0
    assert publish_rate(view, temperature) is UNKNOWN


# -- rclpy itself


ASK_RCLPY = """
import inspect, json
from rclpy import qos
from rclpy.action import ActionClient, ActionServer
from rclpy.node import Node
methods = {name: getattr(Node, name) for name in dir(Node)}
methods.update(ActionServer=ActionServer.__init__, ActionClient=ActionClient.__init__)
positional = {
    name: [
        p.name for p in inspect.signature(method).parameters.values()
        if p.kind is p.POSITIONAL_OR_KEYWORD and p.name != 'self'
    ]
    for name, method in methods.items() if inspect.isfunction(method)
}
profiles = {
    name.removeprefix('qos_profile_'):
        [p.depth, p.history.name, p.reliability.name, p.durability.name]
    for name, p in vars(qos).items() if name.startswith('qos_profile_')
}
print(json.dumps({'positional': positional, 'profiles': profiles}))
"""


@pytest.fixture(scope="module")
def rclpy_data() -> Any:  # noqa: ANN401  JSON
    if importlib.util.find_spec("rclpy") is None:
        pytest.skip("rclpy is not installed")
    done = subprocess.run(
        [sys.executable, "-c", ASK_RCLPY],
        check=True,
        capture_output=True,
        text=True,
        timeout=PATIENCE,
    )
    return json.loads(done.stdout)


def test_signatures_equal_those_of_rclpy(rclpy_data: Any) -> None:  # noqa: ANN401
    positional = rclpy_data["positional"]
    for name, parameters in _SIGNATURES.items():
        if name != "create_lifecycle_publisher":  # takes *args and hands them on
            assert positional[name] == list(parameters), name


@pytest.mark.parametrize("class_", sorted(_FILTERS))
def test_signatures_of_message_filters_equal_those_of_the_stubs(class_: str) -> None:
    tree = ast.parse(library_stubs(distributions.JAZZY)["message_filters/__init__.pyi"])
    (definition,) = (x for x in ast.walk(tree) if isinstance(x, ast.ClassDef) and x.name == class_)
    (constructor,) = (
        x for x in definition.body if isinstance(x, ast.FunctionDef) and x.name == "__init__"
    )
    arguments = [*constructor.args.posonlyargs, *constructor.args.args]
    assert [argument.arg for argument in arguments[1:]] == list(_FILTERS[class_])


def test_qos_profiles_equal_those_of_rclpy(rclpy_data: Any) -> None:  # noqa: ANN401
    output = rclpy_data["profiles"]
    del output["unknown"]
    assert {name: tuple(profile) for name, profile in output.items()} == PROFILES


# -- anything


LINES = st.lists(
    st.sampled_from(
        [
            "self.p = self.create_publisher(String, topic, qos)",
            "self.p = self.create_publisher(*self.p)",
            "topic = self.get_parameter(topic).value",
            "topic = topic + self.topic",
            "self.topic = topic",
            "self.topic += 'a'",
            "self.declare_parameter(self.topic, self.get_parameter('a').value)",
            "self.declare_parameters('', [(topic, self.topic), *topic])",
            "qos = QoSProfile(depth=self.topic)",
            "qos.depth = qos.depth",
            "qos = self.qos = qos",
            "self.create_timer(self.topic, self.create_timer)",
            "self.create_timer(1, lambda: self.p.publish(self.tick()))",
            "self.create_subscription(String, 'a', self.__init__, 1)",
            "self.tick = self.tick()",
            "self.__init__(topic)",
            "Talker(self.topic)",
            "super().__init__(self.topic)",
            "self = Talker(topic)",
            "rclpy.spin(self)",
            "with suppress(self.topic) as qos: pass",
        ]
    ),
    max_size=10,
)


@given(LINES, LINES)
def test_facts_of_any_code_never_raise(first: list[str], second: list[str]) -> None:
    text = (
        "import rclpy\nfrom contextlib import suppress\nfrom rclpy.node import Node\n"
        "from rclpy.qos import QoSProfile\nfrom std_msgs.msg import String\n"
        "class Talker(Node):\n    def __init__(self, topic='a'):\n        pass\n"
        + "".join(f"        {line}\n" for line in first)
        + "    def tick(self, topic, qos=1):\n        pass\n"
        + "".join(f"        {line}\n" for line in second)
    )
    try:
        view = facts(text)
    except (ParseError, NewerSyntaxError):
        return
    assert [item.name for item in view.classes] == ["Talker"]
    names = [item.node_name for item in view.nodes]
    assert all(name is UNKNOWN or isinstance(name, str) for name in names)
    for publisher in view.publishers:
        result = publish_rate(view, publisher)
        assert result is UNKNOWN or result > 0
    for _, callback in view.callbacks:
        if callback.function is not None:
            assert callback.function in view.reached(callback.function)
    assert len(view.rclpy_calls) <= text.count("rclpy.spin")


HOSTILE = {
    "bases in the order of the text": "".join(
        f"class A{n}({f'A{n - 1}' if n else 'Node'}):\n    pass\n" for n in range(2000)
    ),
    "bases in the opposite order": "".join(
        f"class A{n}({f'A{n + 1}' if n < 1999 else 'Node'}):\n    pass\n" for n in range(2000)
    ),
    "functions that call each other": "".join(
        f"def f{n}():\n    f{n + 1}()\n    rclpy.spin(f{n})\n" for n in range(1000)
    ),
    "functions that all call all": "".join(
        f"def f{n}():\n    rclpy.spin(0)\n" + "".join(f"    f{m}()\n" for m in range(40))
        for n in range(40)
    ),
    "parameters from parameters": "class A(Node):\n    def __init__(self):\n"
    + "".join(
        f"        self.declare_parameter('p{n}', self.get_parameter('p{n + 1}').value)\n"
        for n in range(500)
    )
    + "        self.create_timer(self.get_parameter('p0').value, self.f)\n",
    "arguments from arguments": "".join(
        f"class A{n}(Node):\n    def __init__(self, a):\n        super().__init__(a)\n"
        f"        self._f(a)\n    def _f(self, b):\n        A{n + 1}(b)\n"
        for n in range(500)
    ),
    "attributes from attributes": "class A(Node):\n    def f(self):\n"
    + "".join(f"        self.a{n} = self.a{n + 1} + self.a{n + 1}\n" for n in range(500))
    + "        self.create_publisher(String, self.a0, self.a1)\n",
    "timers that call each other": "class A(Node):\n    def f0(self):\n"
    "        self.p = self.create_publisher(String, 'a', 1)\n"
    + "".join(
        f"        self.create_timer(1, self.f{n})\n    def f{n + 1}(self):\n"
        f"        self.p.publish(1)\n        self.f{n}()\n        self.f{n + 2}()\n"
        for n in range(300)
    ),
}


@pytest.mark.parametrize("text", HOSTILE.values(), ids=HOSTILE)
def test_hostile_code_is_analyzed_quickly(text: str) -> None:
    view = facts(f"import rclpy\nfrom rclpy.node import Node\n{text}")
    assert all(item.node_name is UNKNOWN for item in view.nodes)
    assert all(call.outer_handlers == set() for call in view.rclpy_calls)
    assert all(publish_rate(view, item) is UNKNOWN for item in view.publishers)
    assert all(timer.period in {1, UNKNOWN} for timer in view.timers)
    assert all(
        callback.function is None or view.reached(callback.function)
        for _, callback in view.callbacks[:5]
    )
