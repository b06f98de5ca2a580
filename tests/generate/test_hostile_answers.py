"""`new` with hostile answers: one error line, or a package without findings."""

from __future__ import annotations

import ast
import json
import re
from collections.abc import Callable, Sequence
from contextlib import suppress
from itertools import cycle
from pathlib import Path
from typing import Any

import pytest
import yaml
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from lxml import etree

from scaffold.check.rules import registry
from scaffold.cli.main import main
from scaffold.configuration import content
from scaffold.errors import InputError
from scaffold.generate import checking, draft
from scaffold.generate.questions import questions
from scaffold.generate.questions.defaults import User
from scaffold.generate.questions.questions import Given
from scaffold.generate.templates import loading, template
from scaffold.generate.templates.template import PARTS, Question, Role
from scaffold.model.cmake.parser import parse as parse_cmake
from scaffold.source import Source
from scaffold.writing.plan import WritePlan
from tests import oracles
from tests.oracles import needs_system_linter

ROOTS = content.roots("templates")
TEMPLATES = loading.load(ROOTS)
RULES = registry.load(content.roots("rules"))
KINDS = [name for name, item in TEMPLATES.items() if item.role in PARTS]
BUILD_TYPES = template.of_role(TEMPLATES, Role.BUILD_TYPE)
EXTRAS = [name for name, item in TEMPLATES.items() if item.role is Role.EXTRA]
LONGEST_MESSAGE = 1000
"""Characters of a line that says what is wrong; some list every licence or every kind of part."""

TEXTS = (
    *("{{ 7 * 7 }}", "{% raw %}", "{# x #}", "%}", "-->", "--", "]]>", "<!-- -->", "&amp; <b>"),
    *(
        '"',
        "'",
        '"""',
        "'''",
        "\\",
        "\\n",
        "ends in \\",
        "a 'b' \"c\" \\ d",
        "%s %(x)s %",
        "${X} $X @X@",
    ),
    *("- list", "# heading", "* item", "> quote", "1. one", "| a | b |", "`code`", "``", "[a](b)"),
    *(
        "null",
        "~",
        "yes",
        "on",
        "1e3",
        "0x10",
        ": value",
        "key: value",
        "!tag",
        "&anchor",
        "*alias",
    ),
    *(
        "two\nlines",
        "tab\there",
        "\r\n",
        " ",
        "",
        "\0",
        "\x1b[31m",
        "\u2028",
        "\u202eltr",
        "\ufeff",
    ),
    *("Zoë Ångström", "日本語", "🤖 robot", "مرحبا", "e\u0301", "\ud800", "\uffff", "\U000e0001"),
    *("x" * 10_000, "word " * 2_000, "TODO", "noqa", "# noqa: E501", "type: ignore", "#: hidden"),
    *("=====", "-----", "...", ".. note::", "|sub|", "_link_", "*star", "**", "Robots; or: not?"),
    *("A.", "Ends with a dot.", "lower", "f{x}", "{x}", "#]=]", "]==]", "a;b", "//", "/*", "*/"),
    *("See https://ros.org/" + "x" * 120, "x" * 97, "x " * 60, "'" * 99, '"' * 99, "\\" * 99),
)
PERSONS = (
    *(
        "O'Brien",
        "Ada Lovelace, Inc.",
        "Ann <ann@x.org>",
        "Müller & Söhne",
        "李小龍",
        "🤖",
        "\u202eAda",
    ),
    *(
        "Copyright",
        "(c) 2020",
        "2020",
        "2020 Ada",
        "All rights reserved.",
        "a" * 60,
        "{{ x }}",
        "%",
    ),
    *(
        "Ada #1",
        "Ada: boss",
        "ada.",
        "--",
        "e\u0301" * 30,
        "-",
        "# x",
        "noqa",
        "Ada; Bob",
        "Ada\u00a0B",
    ),
    *(
        "${CMAKE}",
        "[x](y)",
        "*x*",
        "_x_",
        "`x`",
        "<x>",
        "|x|",
        "Ada, Bob and the others of the lab",
    ),
    *("coding: latin-1", "Ada -*- coding: utf-16 -*-", "coding=none", "\u200b" * 60, "日" * 60),
    *("\U000e0001" * 60, "'" * 60, "*/", "# flake8: noqa", "&amp;", "👩\u200d👩\u200d👧 family"),
)
NAMES = (
    *("match", "type", "case", "print", "self", "cls", "node", "main", "rclpy", "math", "signal"),
    *(
        "timer",
        "time",
        "msg",
        "count",
        "string",
        "header",
        "std_msgs",
        "threading",
        "lambda",
        "none",
    ),
    *(
        "true",
        "nonlocal",
        "int",
        "len",
        "super",
        "publisher",
        "subscriber",
        "parameter",
        "qos",
        "rate",
    ),
    *(
        "talker",
        "robot",
        "minimal_publisher",
        "test_x",
        "x_test",
        "conftest",
        "setup",
        "a",
        "x" * 48,
    ),
    *(
        "a_" * 23 + "b",
        "x" * 49,
        "Talker",
        "1st",
        "a__b",
        "_a",
        "a_",
        "a-b",
        "a.b",
        "a/b",
        "../a",
        "ä",
    ),
    *(
        "",
        " ",
        "null",
        "on",
        "y",
        "node_node",
        "event",
        "future",
        "goal",
        "request",
        "response",
        "future",
    ),
    *(
        "context",
        "logger",
        "executor",
        "launch",
        "launch_ros",
        "init",
        "__init__",
        "async",
        "await",
    ),
    *("all", "test", "install", "clean", "pytest", "unittest", "rosidl", "parameters", "callback"),
    *("external_shutdown_exception", "string_msg", "ament_index_python", "lifecycle", "rclpy_node"),
    *(
        "log",
        "build",
        "resource",
        "config",
        "src",
        "include",
        "docs",
        "action",
        "srv",
        "example_interfaces",
    ),
)
INTERFACES = (
    *(
        "Status",
        "Drive",
        "String",
        "Int32",
        "Node",
        "A",
        "A" * 48,
        "A" * 49,
        "None",
        "True",
        "Type",
    ),
    *("URL", "HTTPServer", "X1", "A_B", "lower", "Ä", "", "Header", "Class", "Robot", "SetMode"),
    *("NULL", "EOF", "NAN", "SIGINT", "EAGAIN", "INT8", "False", "Vector", "Builder", "Metaclass"),
    *("GetTypeDescription", "X_Request", "DriveGoal", "DriveSendGoal", "SetModeRequest", "Event"),
)
TOPICS = (
    *(
        "on",
        "null",
        "~",
        "~/x",
        "/x",
        "x",
        "/",
        "~x",
        "~~/x",
        "a/b/c",
        "a//b",
        "/a/",
        "a__b",
        "_a",
        "1a",
    ),
    *(
        "/rosout",
        "rosout",
        "/parameter_events",
        "x" * 64,
        "x" * 65,
        "/" + "x" * 63,
        "~/" + "x" * 62,
    ),
    *(
        "~/" + "x" * 15,
        "a b",
        "a\nb",
        "ä",
        "{sub}",
        "{{ x }}",
        "a'b",
        'a"b',
        "",
        "true",
        "yes",
        "1e3",
    ),
    *(
        "A",
        "class",
        "example_topic",
        "processed_topic",
        "/talker/x",
        "x" * 30 + "/" + "y" * 30,
        "0x1",
    ),
    *("~/get_parameters", "~/transition_event", "/talker/set_parameters", "~/~", "parameters"),
)
MESSAGES = (
    *(
        "String",
        "std_msgs/msg/String",
        "std_msgs/String",
        "Header",
        "LaserScan",
        "Imu",
        "PointCloud2",
    ),
    *(
        "Image",
        "CompressedImage",
        "TFMessage",
        "DiagnosticArray",
        "JointTrajectory",
        "OccupancyGrid",
    ),
    *(
        "PoseWithCovarianceStamped",
        "Odometry",
        "Joy",
        "NavSatFix",
        "MultiArrayLayout",
        "UInt8MultiArray",
    ),
    *(
        "Marker",
        "MarkerArray",
        "InteractiveMarker",
        "Clock",
        "Log",
        "ParameterEvent",
        "Duration",
        "Time",
    ),
    *(
        "GoalStatusArray",
        "PointField",
        "Range",
        "BatteryState",
        "Empty",
        "ColorRGBA",
        "WString",
        "Byte",
    ),
    *("std_msgs/msg/Nope", "nope/msg/Nope", "nope", "", "a/b/c/d", "std_msgs/srv/String", "Srting"),
    *("Path", "Pose", "Char", "Float32MultiArray", "MagneticField", "test_msgs/msg/BasicTypes"),
    *("{{ x }}", "std_msgs/msg/String[]", "int32", "string", "/", "std_msgs/msg/", "../x", "\n"),
)
SERVICES = (
    *("AddTwoInts", "SetBool", "Trigger", "Empty", "std_srvs/srv/Empty", "SetParameters", "GetMap"),
    *("example_interfaces/srv/AddTwoInts", "SetCameraInfo", "GetPlan", "ListControllers", "nope"),
    *(
        "nav_msgs/srv/SetMap",
        "std_msgs/msg/String",
        "",
        "GetState",
        "ChangeState",
        "LoadMap",
        "Spawn",
    ),
)
ACTIONS = (
    *(
        "Fibonacci",
        "example_interfaces/action/Fibonacci",
        "LookupTransform",
        "FollowJointTrajectory",
    ),
    *("tf2_msgs/action/LookupTransform", "NavigateToPose", "nope", "", "std_msgs/msg/String"),
    *("FollowWaypoints", "Spin", "Wait", "GripperCommand", "PointHead", "SingleJointPosition"),
)
RATES: tuple[Any, ...] = (
    *(
        0.001,
        10000,
        1e-3,
        "nan",
        "inf",
        "-inf",
        "-1",
        0,
        "0.0",
        "1e4",
        "10000.0001",
        "1_000",
        " 5 ",
    ),
    *(
        "٣",
        "0x10",
        "1e400",
        "",
        "five",
        True,
        None,
        [],
        3.3333333333333335,
        "1e-3",
        0.1 + 0.2,
        7,
        29.97,
    ),
)
QUALITIES = (
    *(
        "10",
        "0",
        "1",
        "10000",
        "10001",
        "latched",
        "sensor_data",
        "system_default",
        "services_default",
    ),
    *(
        "best_effort,depth=5",
        "keep_all",
        "keep_all,depth=5",
        "sensor_data,reliable",
        "deadline=0.5",
    ),
    *(
        "lifespan=1000000",
        "lifespan=0",
        "deadline=1e3",
        "liveliness=manual_by_topic",
        "nan",
        "",
        ",",
    ),
    *(
        "best_effort,transient_local,deadline=0.1,lifespan=2,liveliness_lease_duration=3",
        "x=y",
        "=",
    ),
    *(
        "latched,depth=3",
        "parameters,volatile",
        "depth=٣",
        "default",
        "default,default",
        "5,6",
        5,
        2.5,
    ),
    *(
        "history=keep_last,liveliness=automatic,reliability=best_effort,durability=transient_local",
        True,
    ),
    *(
        "parameter_events,keep_all",
        "action_status_default,best_effort,lifespan=0.000000001",
        "{{ x }}",
    ),
)
FIELDS = (
    *(
        "float64 value",
        "string name",
        'string name "x"',
        "string name 'it''s'",
        "wstring w",
        "string<=5 s",
    ),
    *(
        "string<=5 s 'toolong'",
        "int32[3] a [1, 2, 3]",
        "int32[<=3] b",
        "int32[] c [1]",
        "bool on true",
    ),
    *(
        "std_msgs/Header header",
        "builtin_interfaces/Time stamp",
        "Status status",
        "Nope nope",
        "x/Y y",
    ),
    *(
        "uint8 VALID=1",
        "uint8 VALID = 300",
        'string NAME="a # b"',
        "float32 PI=3.14  # circle",
        "# only",
    ),
    *(
        "byte b",
        "char c 65",
        "float64 nan",
        "int32 class",
        "int32 from",
        "int32 x # {{ y }} -->",
        "int32",
    ),
    *(
        "int32 1x",
        "int32 X",
        "int32 x__y",
        "int32 x_",
        "float64 value",
        "int32 x 5 6",
        "int64[0] z",
        "---",
    ),
    *(
        "int32 x=",
        "geometry_msgs/PoseStamped[<=4] poses",
        "string[2] two ['a', 'b']",
        "int32 self",
        "",
    ),
    *(
        "string<=0 s",
        "wstring<=3[2] ws",
        "geometry_msgs/msg/Pose pose",
        "bool slots",
        "string check_fields",
    ),
    *(
        "int32 data\nint32 more",
        "float64 d 1e400",
        "int8 i 128",
        'string s "',
        "time t",
        "duration d",
        "a\\b c",
    ),
    *(
        "std_msgs/Nope n",
        "int32 " + "x" * 100,
        "uint64 big 18446744073709551615",
        "@verbatim x",
        "int32 é",
    ),
    *(
        "int32 a  # " + "long " * 100,
        "int32 tab\t# c",
        "int32[<=18446744073709551616] h",
        "float32 f .5",
    ),
    *("int32 a  # b\\", "int32 a  # */ ??/", "string s 'a\\\\#'  # c", "string<=4294967296 s"),
    *("int32 a  # \u202e", "# \u2066 x", "int32[4294967296] a", 'int32 a  # """ @(x) $'),
)
PACKAGES = (
    *(
        "std_msgs",
        "rclpy",
        "numpy",
        "python3-numpy",
        "",
        "a b",
        "a,b",
        "talker",
        "robot",
        "-x",
        "ament_cmake",
    ),
    *(
        "1a",
        "<x>",
        "rosidl_default_generators",
        "x" * 49,
        "python3-pytest",
        "a.b+c",
        "Talker",
        "rclpy rclpy",
    ),
    *(
        "ament_lint_auto",
        "ament_cmake_pytest",
        "rosidl_default_runtime",
        "launch",
        "setuptools",
        5,
        None,
    ),
)
ADDRESSES = (
    *(
        "ada@example.com",
        "a@b",
        "a b@c.de",
        "ada@x.org",
        "a'b@x.org",
        "<a@x.org>",
        "a%b+c-d@x-y.co.uk",
    ),
    *(
        "",
        "@",
        "user@todo.todo",
        "ä@x.org",
        "a" * 55 + "@x.org",
        "a@x.org\n",
        "a@x.org, b@x.org",
        "{{a}}@b.cc",
    ),
)

FRAMES = (
    *("base_link", "map", "robot_1/base_link", "A", "_", "f" * 40, "true", "null", "on"),
    *("", "/", "/map", "map/", "a//b", "1a", "a b", "a-b", "ä", "f" * 41, "a\n", "{{ a }}", "a'b"),
)

DISTRIBUTIONS = (
    "humble",
    "jazzy,lyrical",
    "rolling",
    "jazz",
    "Jazzy",
    "jazzy,jazzy",
    ",",
    "foxy",
    "",
)

POOLS: dict[str, tuple[Any, ...]] = {
    "text": TEXTS,
    "person": PERSONS,
    "address": ADDRESSES,
    "package": (*NAMES, "robot", "talker", "my_robot", "robot_arm"),
    "node": NAMES,
    "program": NAMES,
    "interface": INTERFACES,
    "topic": TOPICS,
    "service_name": TOPICS,
    "action_name": TOPICS,
    "frame": FRAMES,
    "message": MESSAGES,
    "service": SERVICES,
    "action": ACTIONS,
    "qos": QUALITIES,
    "rate": RATES,
    "distributions": DISTRIBUTIONS,
}
ODD: tuple[Any, ...] = (
    *(True, None, 5, 2.5, [], ["a", 1], {"a": 1}, {}, "", b"x", [[]], float("nan")),
)
"""What a file of answers may hold where a text is wanted."""
NEIGHBORS = {
    Role.NODE: [name for name in KINDS if TEMPLATES[name].role is not Role.INTERFACE],
    Role.PROGRAM: KINDS,
    Role.INTERFACE: [name for name in KINDS if TEMPLATES[name].role is not Role.NODE],
}
"""The kinds that may be in a package with one of a role."""


def pool(question: Question) -> tuple[Any, ...]:
    """Return hostile answers to a question."""
    if question.type == "fields":
        return (*FIELDS, *ODD)
    if question.type == "dependencies":
        return (*PACKAGES, *ODD)
    if question.choices:
        return (*question.choices, "nope", *ODD)
    return (*POOLS[question.type], *ODD)


def accepted(question: Question) -> list[Any]:
    """Return the hostile answers that are valid on their own."""
    result: list[Any] = []
    for value in pool(question):
        with suppress(InputError):
            questions.parse(question, Given(value, "--x"))
            result.append(value)
    return result


def answers_to(question: Question) -> st.SearchStrategy[Any]:
    """Return a strategy for answers to a question, mostly valid ones."""
    good = st.sampled_from(accepted(question))
    if question.type in {"fields", "dependencies"}:
        return st.lists(st.sampled_from([item for item in accepted(question) if item]), max_size=5)
    if question.type in {"text", "person"} and not question.choices:
        return st.one_of(
            good, st.text(max_size=80), st.tuples(good, good).map("{0[0]} {0[1]}".format)
        )
    return good


@st.composite
def requests(draw: st.DrawFn, kind: str) -> dict[str, Any]:
    """Return a strategy for answers with up to three parts, the first of a given kind."""
    base = {item.name: item for item in TEMPLATES["package"].questions}
    result: dict[str, Any] = {"package": draw(answers_to(base["package"]))}
    for name in sorted(base.keys() - {"package", "add", "extras", "node_kind"}):
        if draw(st.booleans()):
            result[name] = draw(answers_to(base[name]))
    if TEMPLATES[kind].build_types:
        result.pop("build_type", None)
    others = [
        item
        for item in NEIGHBORS[TEMPLATES[kind].role]
        if result.get("build_type", "ament_cmake")
        in (TEMPLATES[item].build_types or template.of_role(TEMPLATES, Role.BUILD_TYPE))
    ]
    result["add"] = []
    for item in [kind, *draw(st.lists(st.sampled_from(others), max_size=2))]:
        entry: dict[str, Any] = {"kind": item}
        for question in TEMPLATES[item].questions:
            if question.name.endswith("_name") or draw(st.booleans()):
                entry[question.name] = draw(answers_to(question))
        result["add"].append(entry)
    result["extras"] = draw(st.lists(st.sampled_from(EXTRAS), max_size=3, unique=True))
    return result


def checked_package(wanted: dict[str, Any]) -> draft.Draft | None:
    """Return a package without findings, or `None` if the answers are rejected."""
    asked = {name: Given(value, f"--{name.replace('_', '-')}") for name, value in wanted.items()}
    try:
        made = draft.draft(ROOTS, TEMPLATES, asked, User("."))
    except InputError as error:
        assert_one_line(str(error))
        return None
    if made.conflicts:
        assert_one_line(made.conflicts[0])
        return None
    output = [
        f"{finding.location.path}:{finding.location.line} {finding.code} {finding.message}"
        for finding in checking.defects(made, RULES)
    ]
    assert not output, output
    for path, text in made.rendered.files.items():
        assert_parsable(path, text)
    return made


def assert_one_line(message: str) -> None:
    assert len(message.splitlines()) == 1, message
    assert len(message) <= LONGEST_MESSAGE, message
    assert message.isprintable(), message


def assert_parsable(path: str, text: str) -> None:
    """Fail if parsers of its format cannot read a file."""
    if path.endswith(".py"):
        compile(text, path, "exec", ast.PyCF_ONLY_AST)
    elif path.endswith((".yaml", ".yml")):
        yaml.safe_load(text)
    elif path.endswith(".json"):
        json.loads(text)
    elif path.endswith(".xml"):
        etree.fromstring(text.encode())
    elif path == "CMakeLists.txt":
        assert parse_cmake(Source(path, text)).errors == []
    text.encode()


ASKED = [
    (kind, question)
    for kind in ["package", *KINDS]
    for question in TEMPLATES[kind].questions
    if question.type not in {"parts", "several"} and question.name != "node_kind"
]
FEW = 2
"""Answers for the second and later kinds that ask the same: all of them would take minutes."""

SHARE = 4
"""One in so many answers is tried here, all of them by ``make nightly``."""


def answers(kind: str, question: Question) -> list[Any]:
    """Return all hostile answers for the first kind with a question, some for the others."""
    values = list(pool(question))
    if kind == next(other for other, item in ASKED if item.name == question.name):
        return values
    start = KINDS.index(kind) % len(values)
    return [values[(start + step * len(values) // FEW) % len(values)] for step in range(FEW)]


@pytest.mark.parametrize(
    ("kind", "question"), [pytest.param(*item, id=f"{item[0]}-{item[1].name}") for item in ASKED]
)
def test_each_hostile_answer_alone(kind: str, question: Question) -> None:
    check_alone(kind, question, answers(kind, question)[::SHARE])


def check_alone(kind: str, question: Question, values: Sequence[Any]) -> None:
    """Check a package for each of several answers to a question."""
    for value in values:
        wanted: dict[str, Any] = {"package": "talker"}
        if kind == "package":
            wanted[question.name] = value
        else:
            wanted["add"] = [{"kind": kind, question.name: value}]
        checked_package(wanted)


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("distro", ["humble", "rolling"])
def test_tutorial_comments_fit_every_distribution(kind: str, distro: str) -> None:
    part = {"kind": kind}
    assert checked_package(
        {"package": "talker", "comments": "tutorial", "distro": distro, "add": [part]}
    )


@pytest.mark.parametrize("kind", [name for name in KINDS if TEMPLATES[name].role is Role.NODE])
def test_node_named_like_an_imported_class(kind: str) -> None:
    made = checked_package({"package": "talker", "add": [{"kind": kind, "node_name": "first"}]})
    assert made is not None
    module = ast.parse(made.rendered.files["talker/first.py"])
    imported = {
        alias.name
        for statement in ast.walk(module)
        if isinstance(statement, ast.ImportFrom)
        for alias in statement.names
        if alias.name[0].isupper()
    }
    assert imported
    for name in sorted(imported):
        words = re.sub(r"(?<=[a-z0-9])(?=[A-Z])", "_", name).lower()
        checked_package({"package": "talker", "add": [{"kind": kind, "node_name": words}]})


@pytest.mark.parametrize("kind", KINDS)
@settings(max_examples=3, suppress_health_check=list(HealthCheck))
@given(data=st.data())
def test_random_combinations_of_hostile_answers(kind: str, data: st.DataObject) -> None:
    checked_package(data.draw(requests(kind)))


SURVIVORS = 40


@pytest.fixture(scope="module")
def hostile_packages(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Write packages of valid hostile answers, each answer once."""
    root = tmp_path_factory.mktemp("hostile_packages")
    turns = {question.name: cycle(typable_answers(question)) for _, question in ASKED}
    base = [question for kind, question in ASKED if kind == "package"]
    number = 0
    for kind in cycle(KINDS):
        part = {item.name: next(turns[item.name]) for name, item in ASKED if name == kind}
        wanted = {item.name: next(turns[item.name]) for item in base if item.name != "build_type"}
        wanted["package"] = f"hostile_{number}"
        wanted["build_type"] = (TEMPLATES[kind].build_types or BUILD_TYPES)[-(number % 2)]
        wanted["add"], wanted["extras"] = [{"kind": kind, **part}], EXTRAS[number % 3 :]
        with suppress(InputError):
            asked = {name: Given(value, f"--{name}") for name, value in wanted.items()}
            made = draft.draft(ROOTS, TEMPLATES, asked, User("."))
            plan = WritePlan.of(root / made.name, made.rendered.files)
            plan.write()
            number += 1
        if number == SURVIVORS:
            return root
    raise AssertionError


def typable_answers(question: Question) -> list[Any]:
    """Return the valid answers that can be typed on a command line."""
    values = [item for item in accepted(question) if isinstance(item, str) and item]
    return values or accepted(question)


@pytest.mark.parametrize(
    "linter",
    [
        oracles.ament_flake8,
        oracles.ament_pep257,
        pytest.param(oracles.ament_copyright, marks=needs_system_linter("ament_copyright")),
        pytest.param(oracles.ament_lint_cmake, marks=needs_system_linter("ament_lint_cmake")),
        pytest.param(oracles.ament_xmllint, marks=needs_system_linter("ament_xmllint")),
    ],
)
def test_ament_linters_accept_packages_of_hostile_answers(
    hostile_packages: Path, linter: Callable[[Path], set[oracles.Finding]]
) -> None:
    assert len(list(hostile_packages.glob("*/package.xml"))) == SURVIVORS
    assert linter(hostile_packages) == set()


@pytest.mark.parametrize(
    ("wanted", "message"),
    [
        ({"dependencies": ["numpy"]}, "no key 'numpy'; its key is python3-numpy"),
        ({"dependencies": ["rosidl_default_generators"]}, "is a build tool"),
        ({"add": [{"kind": "timer", "name": "launch"}]}, "would shadow the Python module launch"),
        (
            {"add": [{"kind": "message", "fields": ["int32 class"]}]},
            "'int32 class': 'class' is a keyword of C or C\\+\\+: .*; choose another name",
        ),
        (
            {
                "add": [
                    {"kind": "message", "name": "HTTPServer"},
                    {"kind": "message", "name": "HttpServer"},
                ]
            },
            "'HTTPServer' and 'HttpServer' are too similar: .* http_server.hpp",
        ),
        ({"copyright_holder": "Ada coding: latin-1"}, "would be read as an encoding declaration"),
        (
            {"maintainer_name": "\u202eAda"},
            r"contains the character U\+202E, which changes the direction of text",
        ),
        ({"add": [{"kind": "message", "name": "True"}]}, "'True' is a keyword of Python"),
        ({"add": [{"kind": "message", "name": "NULL"}]}, "'NULL' is a macro of C"),
        (
            {"add": [{"kind": "message", "fields": "int32 a  # C:\\new"}]},
            "rosidl reads a backslash as the start of an escape sequence",
        ),
        (
            {"add": [{"kind": "message", "fields": "string s 'a # b'"}]},
            "the string is not closed; a '#' inside starts a comment",
        ),
        (
            {"add": [{"kind": "message", "fields": "int32[<=4294967296] a"}]},
            "4294967296 is too large; the limit is 4294967295",
        ),
        (
            {
                "node_kind": "publisher",
                "message_type": "builtin_interfaces/msg/Duration",
                "qos": "lifespan=2",
            },
            "--qos: Duration of rclpy.duration and Duration of builtin_interfaces.msg",
        ),
        (
            {
                "node_kind": "publisher_subscriber",
                "message_type": "std_msgs/msg/String",
                "input_type": "example_interfaces/msg/String",
            },
            "--input-type: String of example_interfaces.msg and String of std_msgs.msg",
        ),
        (
            {"add": [{"kind": "service_server", "name": "a", "service": "/a/get_parameters"}]},
            "--service: '/a/get_parameters' is a service that ROS itself gives each node",
        ),
        (
            {
                "add": [
                    {"kind": "service_server", "name": "a", "service_type": "std_srvs/srv/Empty"},
                    {"kind": "service_client", "name": "b", "service": "empty"}
                    | {"service_type": "example_interfaces/srv/AddTwoInts"},
                ]
            },
            "the service /empty is std_srvs/srv/Empty in a, but example_interfaces/srv/",
        ),
    ],
)
def test_answers_that_would_break_the_package_are_rejected(
    wanted: dict[str, Any], message: str
) -> None:
    asked = {name: Given(value, f"--{name}") for name, value in wanted.items()}
    with pytest.raises(InputError, match=message):
        draft.draft(ROOTS, TEMPLATES, {"package": Given("talker", "PACKAGE"), **asked}, User("."))


@pytest.mark.parametrize(
    ("first", "second", "message"),
    [
        (
            "publisher:eye topic=a message_type=Image",
            "subscriber:ear topic=/a message_type=String",
            "topic /a is sensor_msgs/msg/Image in eye, but std_msgs/msg/String in ear: they do not",
        ),
        (
            "publisher:eye topic=a qos=sensor_data",
            "subscriber:ear topic=a qos=10",
            "topic /a is published best effort by eye, but the subscription of ear is reliable: ",
        ),
        (
            "publisher:eye topic=a message_type=LaserScan",
            "image_pipeline:ear input_topic=a",
            "topic /a is sensor_msgs/msg/LaserScan in eye, but sensor_msgs/msg/Image in ear: they",
        ),
        (
            "lifecycle:eye topic=a qos=10",
            "publisher_subscriber:ear input_topic=a topic=b input_qos=latched",
            "topic /a is published volatile by eye, but the subscription of ear is transient local",
        ),
    ],
)
def test_parts_with_conflicting_types_are_rejected(
    first: str, second: str, message: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    words = ["--add", first, "--add", second, "--destination-directory", str(tmp_path)]
    assert main(["new", "talker", *words]) == 2
    assert f"ros2-scaffold: error: the {message}" in capsys.readouterr().err
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("name", ["parameter", "params", "ros_params", "ros_parameters"])
def test_node_named_parameters(name: str) -> None:
    part = {"kind": "publisher", "node_name": name}
    assert checked_package({"package": "talker", "add": [part], "extras": ["launch"]}) is not None


@pytest.mark.parametrize("name", ["none", "true", "value_error", "node", "exception"])
def test_node_classes_do_not_shadow_imports(name: str) -> None:
    made = checked_package({"package": "talker", "add": [{"kind": "timer", "node_name": name}]})
    assert made is not None
    words = "".join(word.capitalize() for word in name.split("_"))
    assert f"class {words}Node(" in made.rendered.files[f"talker/{name}.py"]
