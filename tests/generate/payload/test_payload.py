"""The values that generated nodes put into messages, services and actions."""

# ruff: noqa: ANN401, S102, S307  messages of rclpy have no types, and the code is what is tested

from __future__ import annotations

import ast
import importlib
import os
import struct
import sys
import time
import zlib
from collections.abc import Callable, Iterable, Iterator
from importlib.util import find_spec
from pathlib import Path
from textwrap import indent
from typing import Any

import pytest

from scaffold.check.rules import registry
from scaffold.check.selection import Selection
from scaffold.check.session import Session
from scaffold.configuration import content
from scaffold.errors import InputError
from scaffold.generate import draft, payload
from scaffold.generate.payload import ActionPayload, Payload, SectionPayload, ServicePayload
from scaffold.generate.payload.message import MAX_LINES, MAX_LOG
from scaffold.generate.questions.defaults import User
from scaffold.generate.questions.questions import Given
from scaffold.generate.templates import loading
from scaffold.model.discovery import targets as discovery
from scaffold.model.interfaces.definitions import Definitions
from scaffold.model.interfaces.sources import PrefixSource
from scaffold.model.workspace.definitions import definitions_for
from scaffold.model.workspace.workspace import Workspace
from scaffold.smoke import environment
from scaffold.smoke.isolation import domain
from scaffold.writing.plan import WritePlan
from tests import oracles
from tests.generate.payload.publishing import Publisher, receive

ROOTS = content.roots("templates")
TEMPLATES = loading.load(ROOTS)
INSTALLED = Definitions([PrefixSource([sys.prefix])])
BUNDLED = definitions_for(prefixes=[])


def importable(kind: str) -> list[str]:
    """Return the importable interfaces of a kind."""
    return [
        name
        for name in INSTALLED.all_names()
        if f"/{kind}/" in name and find_spec(name.partition("/")[0]) is not None
    ]


MESSAGES, SERVICES, ACTIONS = importable("msg"), importable("srv"), importable("action")
COUNTS = (0, 1, 2, 51, 300, 70_000, 2**31 + 5)
"""Numbers of messages: the first ones, and those that would overflow something."""

needs_ros = pytest.mark.skipif(
    find_spec("rclpy") is None, reason="no ROS 2: install the extra 'ros' of this project"
)


def write(destination: Path, **answers: object) -> Path:
    """Write a package as `new` does; return its directory."""
    given = {
        "maintainer_name": "Ada Lovelace",
        "maintainer_email": "ada@example.org",
        "node_kind": "publisher",
        **answers,
    }
    asked = {name: Given(value, name) for name, value in given.items()}
    made = draft.draft(ROOTS, TEMPLATES, asked, User(str(destination)))
    directory = destination / made.name
    files = made.rendered.files
    WritePlan.of(directory, files, executable=made.rendered.executable).write()
    return directory


pytestmark = pytest.mark.filterwarnings("ignore:module 'sre_:DeprecationWarning")  # of lark

# -- real classes


class Node:
    """A minimal node with what generated statements use."""

    frame_id = "map"

    def __init__(self) -> None:
        from rclpy.clock import Clock

        self.count = 0
        self._clock = Clock()

    def get_clock(self) -> Any:
        return self._clock

    def get_name(self) -> str:
        return "node"

    def get_fully_qualified_name(self) -> str:
        return "/node"


@pytest.fixture
def names(monkeypatch: pytest.MonkeyPatch) -> dict[str, Any]:
    """Return names for code; setting a field of a message checks the value's type."""
    monkeypatch.setenv("ROS_PYTHON_CHECK_FIELDS", "1")
    return {"pytest": pytest, "struct": struct, "time": time}


def need_installed(packages: Iterable[str]) -> None:
    """Skip the test where a package is missing."""
    missing = [name for name in packages if find_spec(name) is None]
    if missing:
        pytest.skip(f"not installed: {', '.join(missing)}")


def method(names: dict[str, Any], head: str, lines: tuple[str, ...], result: str) -> Any:
    """Return a function with the given lines as its body."""
    body = indent("\n".join(lines), "    ")
    exec(f"def {head}:\n{body}\n    return {result}\n", names)
    return names[head.partition("(")[0]]


def round_trip(message: Any) -> Any:
    """Return a message after serialization and deserialization."""
    from rclpy.serialization import deserialize_message, serialize_message

    return deserialize_message(serialize_message(message), type(message))


@needs_ros
@pytest.mark.parametrize("name", MESSAGES)
def test_every_message_can_be_filled(name: str, names: dict[str, Any]) -> None:
    filled = payload.payload(name, INSTALLED)
    need_installed(filled.packages)
    exec("\n".join([*filled.imports, *filled.constants]), names)
    message_type = names[filled.name]
    lines = (f"msg = {filled.name}()", *filled.statements)
    publish = method(names, "publish(self)", lines, f"msg, f'{filled.log}'")
    node = Node()
    received = []
    for node.count in COUNTS:
        message, log = publish(node)
        assert len(log) < 100
        received.append(round_trip(message))
    if filled.is_changing:
        assert str(received[0]) != str(received[1])
        assert any(message != message_type() for message in received)
    else:
        assert name.rpartition("/")[2] in {"Constants", "Empty", "ParameterType"}
    for check in filled.checks:
        for message in received:
            assert eval(check, {**names, "message": message}), check


@needs_ros
@pytest.mark.parametrize("name", SERVICES)
def test_every_service_can_be_filled(name: str, names: dict[str, Any]) -> None:
    filled = payload.service(name, INSTALLED)
    exec(filled.import_line, names)
    service = names[filled.name]
    node = Node()
    for node.count in (0, 1, 2, 51):
        request = run(filled.request, names, node, request=service.Request())["request"]
        answer = run(filled.response, names, node, request=request, response=service.Response())
        for check in filled.response.checks:
            assert eval(check, {**names, **answer}), check
        for check in filled.request.checks:
            assert eval(check, {**names, "request": request}), check


@needs_ros
@pytest.mark.parametrize("name", ACTIONS)
def test_every_action_can_be_filled(name: str, names: dict[str, Any]) -> None:
    filled = payload.action(name, INSTALLED)
    exec(filled.import_line, names)
    action = names[filled.name]
    node = Node()
    goal = run(filled.goal, names, node, goal=action.Goal())["goal"]
    assert not (filled.refused and eval(filled.refused, {"goal": goal}))
    feedback = action.Feedback()
    exec("\n".join(filled.start), {**names, "feedback": feedback, "goal": goal})
    seen = []
    for step in eval(filled.steps, {"goal": goal}):
        scope = run(filled.feedback, names, node, feedback=feedback, goal=goal, step=step)
        seen.append(str(scope["feedback"]))
    assert len(seen) > 1
    assert len(set(seen)) == len(seen) or not filled.feedback.statements
    scope = run(filled.result, names, node, result=action.Result(), goal=goal, feedback=feedback)
    for check in filled.result.checks:
        assert eval(check, {**names, **scope}), check


def run(section: SectionPayload, names: dict[str, Any], node: Node, **scope: Any) -> dict[str, Any]:
    """Run the statements of a section; return its scope with the message after a round trip."""
    exec("\n".join([*section.imports, *section.constants]), names)
    head = f"fill({', '.join(['self', *scope])})"
    own = section.statements and method(names, head, section.statements, f"f'{section.log}'")
    if own:
        assert len(own(node, **scope)) < 200
    name = next(item for item in ("result", "response", *scope) if item in scope)
    return {**scope, name: round_trip(scope[name])}


@needs_ros
def test_a_compressed_image_is_a_png(names: dict[str, Any]) -> None:
    filled = payload.payload("CompressedImage", INSTALLED)
    exec("\n".join([*filled.imports, *filled.constants]), names)
    lines = ("msg = CompressedImage()", *filled.statements)
    data = bytes(method(names, "publish(self)", lines, "msg")(Node()).data)
    assert data[:8] == b"\x89PNG\r\n\x1a\n"
    kinds, pixels, at = [], b"", 8
    while at < len(data):
        size = int.from_bytes(data[at : at + 4], "big")
        kind, body = data[at + 4 : at + 8], data[at + 8 : at + 8 + size]
        checksum = data[at + 8 + size : at + 12 + size]
        assert int.from_bytes(checksum, "big") == zlib.crc32(kind + body)
        kinds.append(kind)
        pixels += zlib.decompress(body) if kind == b"IDAT" else b""
        at += 12 + size
    assert kinds == [b"IHDR", b"IDAT", b"IEND"]
    assert len(pixels) == 48 * (1 + 64)


# -- what the code looks like


def payloads_of(name: str) -> Iterator[Payload | SectionPayload]:
    """Yield all payloads of a bundled interface."""
    kind = name.split("/")[1]
    if kind == "msg":
        yield payload.payload(name, BUNDLED)
    elif kind == "srv":
        service = payload.service(name, BUNDLED)
        yield from (service.request, service.response)
    else:
        action = payload.action(name, BUNDLED)
        yield from (action.goal, action.feedback, action.result)


@pytest.mark.parametrize("name", BUNDLED.all_names())
def test_generated_code_is_short(name: str) -> None:
    for part in payloads_of(name):
        assert len(part.statements) <= MAX_LINES
        assert all(len(line) <= 91 for line in part.statements)
        assert len(part.log) <= MAX_LOG
        assert "\n" not in part.summary
        for check in part.checks:
            ast.parse(check)
        assert not any("numpy" in line for line in part.imports)


def package(name: str) -> str:
    return name.replace("/msg/", "_").lower()[:48]


@pytest.fixture(scope="module")
def packages(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Write a package with a publisher for every message."""
    root = tmp_path_factory.mktemp("packages")
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("AMENT_PREFIX_PATH", sys.prefix)
        # A package that is installed counts, and may be older than the bundle.
        known = definitions_for(prefixes=[sys.prefix]).all_names()
        for name in sorted({*MESSAGES, *(name for name in known if "/msg/" in name)}):
            write(root, package=package(name), message_type=name, node_name="talker")
    return root


def test_every_publisher_passes_every_rule(packages: Path) -> None:
    session = Session(registry.load(content.roots("rules")), Selection())
    results = list(session.run(discovery.find([str(packages)])))
    assert len(results) == len(os.listdir(packages))
    assert [finding for result in results for finding in result.diagnostics] == []


def test_every_publisher_passes_ament_flake8(packages: Path) -> None:
    assert oracles.ament_flake8(packages) == set()


def test_every_publisher_passes_ament_pep257(packages: Path) -> None:
    assert oracles.ament_pep257(packages) == set()


SAMPLE = (
    "diagnostic_msgs/msg/DiagnosticArray",
    "nav_msgs/msg/Odometry",
    "sensor_msgs/msg/Image",
    "sensor_msgs/msg/LaserScan",
    "sensor_msgs/msg/MultiEchoLaserScan",
    "visualization_msgs/msg/MarkerArray",
)


@needs_ros
def test_messages_are_received_in_another_process(tmp_path: Path) -> None:
    variables = {
        **environment.select(os.environ).variables,
        "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
        "ROS_LOG_DIR": str(tmp_path),
    }
    wanted = []
    for name in SAMPLE:
        directory = write(tmp_path, package=package(name), message_type=name, node_name="talker")
        script = directory / directory.name / "talker.py"
        filled = payload.payload(name, BUNDLED)
        wanted.append(Publisher(filled, script, f"/{directory.name}"))
    with domain.reserved() as number:
        variables["ROS_DOMAIN_ID"] = str(number)
        received = list(receive(wanted, variables, tmp_path, jobs=len(wanted)))
    assert [item for item in received if not item.is_good] == []
    assert len(received) == len(SAMPLE)


# -- messages of users

Fill = Callable[..., Payload]
"""Takes the text of a message, its name, and the texts of others by name."""


@pytest.fixture
def own(tmp_path: Path) -> Fill:
    """Return a function that fills a message defined by the user."""

    def fill(text: str, name: str = "Sample", **others: str) -> Payload:
        directory = tmp_path / "robot_msgs"
        (directory / "msg").mkdir(parents=True, exist_ok=True)
        (directory / "package.xml").write_text("<package><name>robot_msgs</name></package>")
        files = {name: text, **others}
        listed = " ".join(f'"msg/{item}.msg"' for item in files)
        (directory / "CMakeLists.txt").write_text(
            f"project(robot_msgs)\nrosidl_generate_interfaces(${{PROJECT_NAME}} {listed})\n"
        )
        for item, lines in files.items():
            (directory / "msg" / f"{item}.msg").write_text(lines)
        targets = discovery.find([str(tmp_path)])
        workspace = Workspace([target.package for target in targets])
        return payload.payload(f"robot_msgs/{name}", definitions_for(workspace, prefixes=[]))

    return fill


def test_units_are_inferred_from_names_and_comments(own: Fill) -> None:
    filled = own("float64 motor_temperature\nfloat32 speed # m/s, forward\nfloat64 range_mm\n")
    assert filled.statements == (
        "wave = math.sin(self.count / 10.0)  # -1.0 to 1.0",
        "msg.motor_temperature = 20.0 + 2.0 * wave  # degrees Celsius",
        "msg.speed = 0.5 + 0.5 * wave  # m/s, forward",
        "msg.range_mm = 1.0 + 0.5 * wave  # millimeters",
    )
    assert filled.imports == ("import math", "from robot_msgs.msg import Sample")
    assert filled.type == "robot_msgs/msg/Sample"


def test_enum_fields_use_their_constants(own: Fill) -> None:
    filled = own(
        "uint8 STATE_UNKNOWN=0\nuint8 STATE_DRIVING=1\nuint8 state\n"
        "uint8 GEAR_PARK=0\nuint8 GEAR_FORWARD=1\nuint8 gear\n"
        "uint8 MAX_SPEED=9\nuint8 speed\n"
    )
    assert filled.statements == (
        "msg.state = Sample.STATE_DRIVING",
        "msg.gear = Sample.GEAR_PARK",
        "msg.speed = self.count % 100",
    )
    assert filled.checks == (
        "message.state == Sample.STATE_DRIVING",
        "message.gear == Sample.GEAR_PARK",
    )


def test_message_with_only_an_enum_changes(own: Fill) -> None:
    assert own("uint8 OFF=0\nuint8 ON=1\nuint8 mode\n").statements == (
        "every_mode = [Sample.OFF, Sample.ON]",
        "msg.mode = every_mode[self.count % 2]",
    )


def test_bounds_are_kept(own: Fill) -> None:
    filled = own("string<=4 code\nfloat32[<=2] gains\nint8[5] cells\nstring<=3[<=8] tags\n")
    assert filled.statements == (
        "msg.code = str(self.count % 1000)",
        "msg.gains = [math.sin(self.count / 10.0)] * 2",
        "msg.cells = [(self.count + index) % 100 for index in range(5)]",
        "msg.tags = ['1', '2', '3']",
    )


def test_arrays_of_messages_are_filled_in_a_loop(own: Fill) -> None:
    filled = own("geometry_msgs/Point[] corners\nWheel[4] wheels\n", Wheel="float32 speed\n")
    assert filled.statements == (
        "for count in range(self.count, self.count + 3):",
        "    corner = Point()",
        "    angle = count / 10.0  # radians",
        "    corner.x = math.cos(angle)  # meters",
        "    corner.y = math.sin(angle)",
        "    msg.corners.append(corner)",
        "for count, wheel in enumerate(msg.wheels, self.count):",
        "    wheel.speed = 0.5 + 0.5 * math.sin(count / 10.0)  # meters per second",
    )
    assert filled.packages == ("geometry_msgs", "robot_msgs")


def test_arrays_of_nested_messages_have_matching_lengths(own: Fill) -> None:
    filled = own("sensor_msgs/Image left\nsensor_msgs/Image right\nstd_msgs/Float32 gain\n")
    assert filled.constants == ("WIDTH = 64  # pixels", "HEIGHT = 48")
    assert "msg.left.data = HEIGHT * row" in filled.statements
    assert "msg.right.header = msg.left.header" in filled.statements
    assert filled.statements[-1] == "msg.gain.data = math.sin(self.count / 10.0)"
    assert filled.is_stamped


def test_deeply_nested_fields_get_a_local_variable(own: Fill) -> None:
    filled = own("Rig rig\n", Rig="sensor_msgs/LaserScan scan\n")
    assert filled.statements[:4] == (
        "msg.rig.scan.header.stamp = self.get_clock().now().to_msg()",
        "msg.rig.scan.header.frame_id = self.frame_id",
        "scan = msg.rig.scan",
        "scan.angle_min = -math.pi  # radians",
    )
    assert filled.frame == "laser"


def test_long_field_names_do_not_exceed_the_line_length(own: Fill) -> None:
    name = "polygons_of_the_areas_that_nobody_may_enter"
    inner = "corners_of_the_polygon_as_they_are_drawn"
    filled = own(f"Area {name}\n", Area=f"geometry_msgs/Polygon {inner}\nfloat64 {name}_now\n")
    assert filled.statements == (
        "wave = math.sin(self.count / 10.0)  # -1.0 to 1.0",
        f"drawn = msg.{name}.{inner}  # noqa: E501",
        "side = 2.0 + wave  # meters",
        "corners = [(0.0, 0.0), (side, 0.0), (side, side), (0.0, side)]",
        "drawn.points = [Point32(x=x, y=y) for x, y in corners]",
        f"msg.{name}.{name}_now = wave  # noqa: E501",
    )


def test_headers_of_array_elements_are_filled(own: Fill) -> None:
    filled = own("std_msgs/Header header\nstd_msgs/Header[2] seen\n")
    assert filled.statements[2:] == (
        "for header in msg.seen:",
        "    header.stamp = msg.header.stamp",
        "    header.frame_id = self.frame_id",
    )


@pytest.mark.parametrize(
    ("field", "value"),
    [
        ("uint64 timestamp", "self.get_clock().now().nanoseconds"),
        ("uint64 timestamp_us", "self.get_clock().now().nanoseconds // 1000"),
        ("uint64 timestamp # in microseconds", "self.get_clock().now().nanoseconds // 1000"),
        ("int64 timestamp_ms", "self.get_clock().now().nanoseconds // 1_000_000"),
    ],
)
def test_timestamps_use_the_unit_in_their_name(own: Fill, field: str, value: str) -> None:
    assert own(field + "\n").statements[0].partition(" = ")[2].partition("  #")[0] == value


def test_checks_have_imports(own: Fill) -> None:
    filled = own("visualization_msgs/InteractiveMarkerControl control\nfloat64 math\n")
    assert filled.checks[0] == (
        "message.control.interaction_mode == InteractiveMarkerControl.MOVE_AXIS"
    )
    assert filled.check_imports == ("from visualization_msgs.msg import InteractiveMarkerControl",)


def test_frame_is_only_set_where_it_is_usual(own: Fill) -> None:
    filled = own("sensor_msgs/JointState joints\ngeometry_msgs/WrenchStamped wrench\n")
    assert "msg.joints.header.frame_id = self.frame_id" not in filled.statements
    assert "msg.wrench.header.frame_id = self.frame_id" in filled.statements
    assert filled.frame == "tool0"


def test_poses_use_the_map_frame(own: Fill) -> None:
    assert own("std_msgs/Header header\ngeometry_msgs/Pose[] poses\n").frame == "map"
    assert payload.service("nav_msgs/srv/GetPlan", BUNDLED).request.frame == "map"


def test_classes_with_equal_names_are_imported_with_an_alias(own: Fill) -> None:
    filled = own("geometry_msgs/Point[] points\n", name="Point")
    assert "    point = GeometryMsgsPoint()" in filled.statements
    assert filled.imports == (
        "import math",
        "from geometry_msgs.msg import Point as GeometryMsgsPoint",
        "from robot_msgs.msg import Point",
    )


def test_message_named_like_the_base_class(own: Fill) -> None:
    filled = own(
        "uint8 STATE_ON=1\nuint8 STATE_OFF=0\nuint8 state\nNode[] nodes\n",
        name="Graph",
        Node="float32 load\n",
    )
    assert "    node = RobotMsgsNode()" in filled.statements
    assert filled.imports[-1] == "from robot_msgs.msg import Graph, Node as RobotMsgsNode"
    filled = own("uint8 ON=1\nuint8 OFF=0\nuint8 state\nstring text\n", name="Node")
    assert (filled.name, filled.type) == ("RobotMsgsNode", "robot_msgs/msg/Node")
    assert filled.import_line == "from robot_msgs.msg import Node as RobotMsgsNode"
    assert filled.statements[0] == "msg.state = RobotMsgsNode.ON"
    assert filled.class_names == ("Node", "RobotMsgsNode")


def test_many_imports_are_wrapped(own: Fill) -> None:
    others = {f"MessageWithALongName{number}": "float32 load\n" for number in range(5)}
    filled = own("".join(f"{name}[] m{name[-1]}\n" for name in others), **others)
    assert len(filled.imports) == 3
    assert all(len(line) <= 99 for line in filled.imports)


def test_local_names_do_not_shadow_modules(own: Fill) -> None:
    filled = own("unique_identifier_msgs/UUID[] uuids\ngeometry_msgs/Point[] maths\n")
    assert "    uuid_ = UUID()" not in filled.statements
    assert "    point = Point()" in filled.statements
    assert "    element = UUID()" in filled.statements


def test_defaults_are_kept(own: Fill) -> None:
    assert own("float64 gain 0.5\nint32 number\n").statements == ("msg.number = self.count % 1000",)


def test_remaining_fields_of_long_messages_keep_defaults(own: Fill) -> None:
    filled = own("".join(f"float64 field_{number}\n" for number in range(60)))
    assert len(filled.statements) <= MAX_LINES
    assert filled.statements[-1] == "# the other 48 fields keep their defaults"


def test_message_without_fields(own: Fill) -> None:
    filled = own("uint8 ONE=1\n")
    assert (filled.statements, filled.checks, filled.is_changing) == ((), (), False)
    assert filled.log == "an empty message"


# -- what users write


@pytest.mark.parametrize(
    ("text", "type_"),
    [
        ("sensor_msgs/msg/LaserScan", "sensor_msgs/msg/LaserScan"),
        ("sensor_msgs/LaserScan", "sensor_msgs/msg/LaserScan"),
        ("sensor_msgs.msg.LaserScan", "sensor_msgs/msg/LaserScan"),
        ("LaserScan", "sensor_msgs/msg/LaserScan"),
        ("String", "std_msgs/msg/String"),
    ],
)
def test_accepted_spellings_of_types(text: str, type_: str) -> None:
    assert payload.payload(text, BUNDLED).type == type_


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("laserscan", "unknown message type 'laserscan'; did you mean sensor_msgs/msg/LaserScan?"),
        (
            "KeyValue",
            (
                "'KeyValue' may be diagnostic_msgs/msg/KeyValue, geographic_msgs/msg/KeyValue or "
                "type_description_interfaces/msg/KeyValue; use the full name"
            ),
        ),
        ("std_srvs/srv/Trigger", "'std_srvs/srv/Trigger' is a type of services, not of messages"),
        ("nothing_like_it/msg/Qwertz", "unknown message type 'nothing_like_it/msg/Qwertz'"),
        ("", "unknown message type ''"),
        ("//", "unknown message type '//'"),
    ],
)
def test_rejected_spellings_of_types(text: str, message: str) -> None:
    with pytest.raises(InputError) as raised:
        payload.payload(text, BUNDLED)
    assert str(raised.value) == message


def test_services_and_actions_by_short_name() -> None:
    assert payload.service("AddTwoInts", BUNDLED).type == "example_interfaces/srv/AddTwoInts"
    assert payload.service("SetBool", BUNDLED).type == "std_srvs/srv/SetBool"
    assert payload.action("Fibonacci", BUNDLED).type == "example_interfaces/action/Fibonacci"
    with pytest.raises(InputError, match="did you mean std_srvs/srv/Trigger"):
        payload.service("Triger", BUNDLED)
    with pytest.raises(InputError, match="did you mean example_interfaces/action/Fibonacci"):
        payload.action("fibonaci", BUNDLED)


def test_broken_definition_is_reported_with_its_line(own: Fill, tmp_path: Path) -> None:
    file = tmp_path / "robot_msgs" / "msg" / "Sample.msg"
    with pytest.raises(InputError) as raised:
        own("int32 good\nint33 bad\n")
    assert str(raised.value).startswith(f"robot_msgs/msg/Sample: {file}:2: 'int33' is neither")
    with pytest.raises(InputError) as raised:
        own("int32 good\nWheel[] wheels\n", Wheel="float32 Speed\n")
    wheel = file.with_name("Wheel.msg")
    assert f"{file}:2: the field 'wheels' cannot be filled: " in str(raised.value)
    assert f"{wheel}:1: 'Speed' is not a valid field name" in str(raised.value)
    with pytest.raises(InputError) as raised:
        own("geometry_msgs/Pont place\n")
    assert f"{file}:1: " in str(raised.value)
    assert "did you mean geometry_msgs/msg/Point" in str(raised.value)


def test_cyclic_definition_is_reported_with_its_line(own: Fill, tmp_path: Path) -> None:
    directory = tmp_path / "robot_msgs" / "msg"
    with pytest.raises(InputError) as raised:
        own("int32 number\nTree[] children\n", name="Tree")
    assert str(raised.value) == (
        f"{directory / 'Tree.msg'}:2: the field 'children' makes a message contain itself: "
        "robot_msgs/msg/Tree -> robot_msgs/msg/Tree"
    )
    with pytest.raises(InputError) as raised:
        own("B b\n", name="A", B="\nA a\n")
    assert str(raised.value) == (
        f"{directory / 'B.msg'}:2: the field 'a' makes a message contain itself: "
        "robot_msgs/msg/A -> robot_msgs/msg/B -> robot_msgs/msg/A"
    )


def test_interfaces_of_the_surrounding_workspace(tmp_path: Path) -> None:
    package = tmp_path / "src" / "robot_msgs"
    (package / "msg").mkdir(parents=True)
    (package / "package.xml").write_text("<package><name>robot_msgs</name></package>")
    (package / "CMakeLists.txt").write_text(
        'project(robot_msgs)\nrosidl_generate_interfaces(robot_msgs "msg/Wheel.msg")\n'
    )
    (package / "msg" / "Wheel.msg").write_text("float32 speed\n")
    for directory in (tmp_path, tmp_path / "src"):
        known = payload.definitions(str(directory))
        assert payload.payload("Wheel", known).type == "robot_msgs/msg/Wheel"
    with pytest.raises(InputError, match="unknown message type 'Wheel'"):
        payload.payload("Wheel", payload.definitions(str(tmp_path.parent)))


# -- services and actions, as people write them


def test_add_two_ints_recipe() -> None:
    filled = payload.service("AddTwoInts", BUNDLED)
    assert filled.request.statements == ("request.a = self.count", "request.b = 2")
    assert filled.response.statements == ("response.sum = request.a + request.b",)
    assert filled.packages == ("example_interfaces",)
    assert filled.import_line == "from example_interfaces.srv import AddTwoInts"


def test_set_bool_recipe() -> None:
    filled = payload.service("std_srvs/srv/SetBool", BUNDLED)
    assert isinstance(filled, ServicePayload)
    assert filled.response.statements == (
        "response.success = True",
        "response.message = 'switched on' if request.data else 'switched off'",
    )


def test_fibonacci_recipe() -> None:
    filled = payload.action("Fibonacci", BUNDLED)
    assert isinstance(filled, ActionPayload)
    assert filled.start == ("feedback.sequence = [0, 1]",)
    assert (filled.steps, filled.refused) == ("range(1, goal.order)", "not 1 <= goal.order <= 46")
    assert filled.result.statements == ("result.sequence = feedback.sequence",)


def test_result_codes_mean_success() -> None:
    response = payload.service("nav_msgs/srv/LoadMap", BUNDLED).response
    assert response.statements[-1] == "response.result = LoadMap.Response.RESULT_SUCCESS"
    response = payload.service("action_msgs/srv/CancelGoal", BUNDLED).response
    assert "response.return_code = CancelGoal.Response.ERROR_NONE" in response.statements


def test_interfaces_named_like_other_classes(tmp_path: Path) -> None:
    package = tmp_path / "src" / "robot_msgs"
    (package / "srv").mkdir(parents=True)
    (package / "action").mkdir()
    (package / "package.xml").write_text("<package><name>robot_msgs</name></package>")
    (package / "CMakeLists.txt").write_text(
        "project(robot_msgs)\n"
        'rosidl_generate_interfaces(robot_msgs "srv/Client.srv" "action/Event.action")\n'
    )
    (package / "srv" / "Client.srv").write_text("uint8 ON=1\nuint8 mode\n---\nbool success\n")
    (package / "action" / "Event.action").write_text(
        "actionlib_msgs/GoalStatus status\n---\n---\nfloat32 progress\n"
    )
    known = payload.definitions(str(tmp_path))
    service = payload.service("robot_msgs/Client", known)
    assert service.import_line == "from robot_msgs.srv import Client as RobotMsgsClient"
    assert service.type == "robot_msgs/srv/Client"
    assert service.request.statements == ("request.mode = RobotMsgsClient.Request.ON",)
    action = payload.action("robot_msgs/Event", known)
    assert action.import_line == "from robot_msgs.action import Event as RobotMsgsEvent"
    assert action.type == "robot_msgs/action/Event"
    assert "goal.status.status = ActionlibMsgsGoalStatus.ACTIVE" in action.goal.statements


def test_recipes_refer_to_existing_interfaces() -> None:
    from scaffold.generate.payload import recipes

    for file in Path(str(recipes.__file__)).parent.glob("[!_]*.py"):
        module = importlib.import_module(f"{recipes.__name__}.{file.stem}")
        for kind, table in (("msg", "RECIPES"), ("srv", "SERVICES"), ("action", "ACTIONS")):
            known = BUNDLED.names(file.stem, kind) or ()
            assert set(getattr(module, table, {})) <= set(known)
