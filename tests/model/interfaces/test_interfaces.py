"""Interface definitions: parsed like rosidl_adapter does, with exact locations."""

from __future__ import annotations

import contextlib
import io
import os
from collections.abc import Sequence
from pathlib import Path
from types import ModuleType

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from scaffold.cli.main import main
from scaffold.errors import InputError
from scaffold.model.contents.interface_files import generations
from scaffold.model.interfaces.definitions import Definitions, Interface, render, spell
from scaffold.model.interfaces.sources import BundleSource, PrefixSource
from scaffold.model.interfaces.syntax import (
    Definition,
    ProblemKind,
    parse,
    suggest_constant_name,
    suggest_field_name,
    suggest_type_name,
)
from scaffold.model.interfaces.types import FieldType, is_constant_name, is_field_name, is_type_name
from scaffold.model.package import Package
from scaffold.model.workspace.definitions import definitions_for
from scaffold.model.workspace.workspace import Workspace
from scaffold.source import Source

Reading = list[tuple[list[tuple[str, str, str]], list[tuple[str, str, str]]]] | None
"""Fields and constants of each section as text, or ``None`` for a file that is refused."""


def definition(text: str, kind: str = "msg", name: str = "Thing") -> Definition:
    return parse(Source(f"{kind}/{name}.{kind}", text), "own_msgs", kind, name)


def places(text: str, kind: str = "msg", name: str = "Thing") -> list[tuple[str, int, int, int]]:
    return [
        (problem.kind.value, at.line, at.column, at.end_column)
        for problem in definition(text, kind, name).problems
        for at in [problem.location]
    ]


# -- what is read


def test_fields_have_types_defaults_comments_and_locations() -> None:
    text = (
        "# A thing.\n#\n# Of two lines.\n\nstd_msgs/Header header\n"
        'float64[<=3]   speeds [1.5, -2]  # in m/s\nstring<=5 name "a b"\n\tOther[] others\n'
    ).replace("\t", "")
    (section,) = definition(text).sections
    assert section.comment == "A thing.\n\nOf two lines."
    header, speeds, name, others = section.fields
    assert header.type == FieldType("Header", "std_msgs")
    assert header.type.full_name == "std_msgs/msg/Header"
    assert speeds.type == FieldType("float64", is_array=True, array_size=3, is_upper_bound=True)
    assert (speeds.default, speeds.comment) == ((1.5, -2.0), "in m/s")
    assert speeds.location == ("msg/Thing.msg", 6, 16, 6, 22)
    assert speeds.type_location == ("msg/Thing.msg", 6, 1, 6, 13)
    assert (name.type, name.default) == (FieldType("string", text_bound=5), "a b")
    assert others.type == FieldType("Other", "own_msgs", is_array=True)
    assert section.field("name") is name
    assert section.field("nobody") is None


def test_constants_have_values_and_locations() -> None:
    (section,) = definition(
        "uint8   MAX = 0xff  # all\nstring TEXT='it\\'s'\nbool ON=TRUE\n"
    ).sections
    result = [(str(c.type), c.name, c.value, c.comment) for c in section.constants]
    assert result == [
        ("uint8", "MAX", 255, "all"),
        ("string", "TEXT", "it's", ""),
        ("bool", "ON", True, ""),
    ]
    assert section.constants[0].location == ("msg/Thing.msg", 1, 9, 1, 12)
    assert section.constant("ON") is section.constants[2]
    assert section.constant("OFF") is None


def test_services_and_actions_have_sections() -> None:
    service = definition("int32 a\n---\nint32 b\n", "srv")
    assert [s.name for s in service.sections] == ["request", "response"]
    assert [[f.name for f in s.fields] for s in service.sections] == [["a"], ["b"]]
    assert service.sections[1].fields[0].location[1:3] == (3, 7)
    action = definition("---\n---\nint32 c\n", "action")
    assert [len(s.fields) for s in action.sections] == [0, 0, 1]
    assert not service.problems
    assert not action.problems


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("int32 a", []),
        ("\n\n  # only comments\n", []),
        ("int32 Speed\n", [("field name", 1, 7, 12)]),
        ("int32 _a\nint32 b_\n", [("field name", 1, 7, 9), ("field name", 2, 7, 9)]),
        ("int32 b__c\n", [("field name", 1, 7, 11)]),
        ("int32 max=1\n", [("constant name", 1, 7, 10)]),
        ("int32 a\nfloat32 a\n", [("duplicate", 2, 9, 10)]),
        ("int32 A=1\nint32 A=2\n", [("duplicate", 2, 7, 8)]),
        ("int32\n", [("syntax", 1, 1, 6)]),
        ("  int32 a\n", [("syntax", 1, 3, 8)]),
        ("\tint32 a\n", [("syntax", 1, 2, 7)]),
        ("\ufeffint32 a\n", [("syntax", 1, 1, 1)]),
        ("---\n", [("separator", 1, 1, 4)]),
        ("int a\n", [("type", 1, 1, 4)]),
        ("std_msgs/msg/String a\n", [("type", 1, 1, 20)]),
        ("time stamp\n", [("type", 1, 1, 5)]),
        ("int32[0] a\n", [("type", 1, 1, 9)]),
        ("int32] a\n", [("type", 1, 1, 7)]),
        ("string<=0 a\n", [("type", 1, 1, 10)]),
        ("int32<=5 a\n", [("type", 1, 1, 9)]),
        ("string <= 5 a\n", [("constant name", 1, 8, 9)]),
        ("string<=5 A=x\n", [("type", 1, 1, 10)]),
        ("std_msgs/Header H=x\n", [("type", 1, 1, 16)]),
        ("uint8 a 256\n", [("value", 1, 9, 12)]),
        ("uint8 A=-1\n", [("value", 1, 9, 11)]),
        ("int8 A=1.5\n", [("value", 1, 8, 11)]),
        ("bool a yes\n", [("value", 1, 8, 11)]),
        ("float32 a 1,5\n", [("value", 1, 11, 14)]),
        ("int32[2] a [1, 2, 3]\n", [("value", 1, 12, 21)]),
        ("int32[<=2] a [1, 2, 3]\n", [("value", 1, 14, 23)]),
        ("int32[2] a 1\n", [("value", 1, 12, 13)]),
        ("string<=2 a 'abc'\n", [("value", 1, 13, 18)]),
        ("string a 'it's'\n", [("value", 1, 10, 16)]),
        ("std_msgs/Header a 1\n", [("value", 1, 19, 20)]),
        ("int32 A\r\nint32 B\r\n", [("field name", 1, 7, 8), ("field name", 2, 7, 8)]),
        ("int32 a\x0cint32 B\n", [("field name", 1, 15, 16)]),
    ],
)  # fmt: skip
def test_problems_of_a_message(text: str, expected: list[tuple[str, int, int, int]]) -> None:
    assert places(text) == expected


@pytest.mark.parametrize(
    ("kind", "text", "expected"),
    [
        ("srv", "int32 a\n", [("separator", 1, 1, 1)]),
        ("srv", "---\n---\n", [("separator", 2, 1, 4)]),
        ("srv", "---  \n", [("separator", 1, 1, 4)]),
        ("action", "---\n", [("separator", 1, 1, 1)]),
        ("action", "---\n---\n---\n", [("separator", 3, 1, 4)]),
        ("srv", "int32 a\n---\nint32 a\n", []),
    ],
)
def test_problems_of_separators(
    kind: str, text: str, expected: list[tuple[str, int, int, int]]
) -> None:
    assert places(text, kind) == expected


def test_all_problems_are_reported_at_once() -> None:
    text = "int32 A\nint b\n---\nuint8 c 300\n---\n"
    assert [kind for kind, *_ in places(text, "action", "do_it")] == [
        ProblemKind.TYPE_NAME.value,
        ProblemKind.FIELD_NAME.value,
        ProblemKind.TYPE.value,
        ProblemKind.VALUE.value,
    ]


@pytest.mark.parametrize(
    ("given_name", "type_name", "field_name", "constant_name"),
    [
        ("do_it", "DoIt", "do_it", "DO_IT"),
        ("maxSpeed", "MaxSpeed", "max_speed", "MAX_SPEED"),
        ("IMUData", "IMUData", "imu_data", "IMU_DATA"),
        ("2nd-try_", "NdTry", "nd_try", "ND_TRY"),
        ("--", "", "", ""),
    ],
)
def test_suggested_names(
    given_name: str, type_name: str, field_name: str, constant_name: str
) -> None:
    assert suggest_type_name(given_name) == type_name
    assert suggest_field_name(given_name) == field_name
    assert suggest_constant_name(given_name) == constant_name


@given(st.text(alphabet="aB1_-é "))
def test_suggested_names_are_valid(text: str) -> None:
    for suggest, is_valid in (
        (suggest_type_name, is_type_name),
        (suggest_field_name, is_field_name),
        (suggest_constant_name, is_constant_name),
    ):
        name = suggest(text)
        assert not name or is_valid(name)


# -- the oracle


@pytest.fixture(scope="module")
def adapter() -> ModuleType:
    reason = "the oracle needs ros-jazzy-rosidl-adapter (extra `test`)"
    module: ModuleType = pytest.importorskip("rosidl_adapter.parser", reason=reason)
    return module


def adapter_reading(adapter: ModuleType, kind: str, name: str, text: str) -> Reading:
    """Return how rosidl_adapter reads a file; it may raise any exception."""
    read = {
        "msg": adapter.parse_message_string,
        "srv": adapter.parse_service_string,
        "action": adapter.parse_action_string,
    }[kind]
    try:
        with contextlib.redirect_stderr(io.StringIO()):
            spec = read("own_msgs", name, text)
    except Exception:  # noqa: BLE001  IndexError and NotImplementedError are verdicts, too
        return None
    parts = {
        "msg": lambda: [spec],
        "srv": lambda: [spec.request, spec.response],
        "action": lambda: [spec.goal, spec.result, spec.feedback],
    }[kind]()
    types = [element.type for part in parts for element in (*part.fields, *part.constants)]
    if {str(t).partition("[")[0] for t in types} & {"time", "duration"}:
        return None  # read "for compatibility only", then refused when the IDL is written
    return [
        (
            [(str(f.type), f.name, _value_text(f.default_value)) for f in part.fields],
            [(c.type, c.name, _value_text(c.value)) for c in part.constants],
        )
        for part in parts
    ]


def own_reading(kind: str, name: str, text: str) -> Reading:
    read = definition(text, kind, name)
    if read.problems:
        return None
    return [
        (
            [(str(f.type), f.name, _value_text(f.default)) for f in section.fields],
            [(str(c.type), c.name, _value_text(c.value)) for c in section.constants],
        )
        for section in read.sections
    ]


def _value_text(value: object) -> str:
    return repr(list(value) if isinstance(value, tuple) else value)


PIECES = """
int32 uint8 float64 bool string wstring char time String A b own a_b a__b A_B A_ 1 300 -1 0x1F 1_0
std_msgs/Header std_msgs/msg/Header 1e3 nan true TRUE 'x' 'a\\'b' ' " [3] [<=2] [] [ ] [,] <=3 <= =
["a\\"b",c] # --- - , é Sample_ _Request
"""
WORDS = st.sampled_from(
    [*PIECES.split(), '"x y"', "[1, 2]", "['a', \"b\"]", "# c", " ", "  ", "\t"]
)
LINES = st.lists(st.one_of(WORDS, st.just(" ")), max_size=7).map("".join)
TEXTS = st.lists(st.one_of(LINES, st.just("---")), max_size=5).flatmap(
    lambda lines: st.sampled_from(["\n", "\r\n", "\x0c", "\u2028"]).map(lambda end: end.join(lines))
)


@settings(max_examples=1500, deadline=None)
@given(st.sampled_from(["msg", "srv", "action"]), TEXTS)
@example("msg", 'string[] a ["x\\"y\\"z", \'q\']')
@example("msg", "string[2] a ['a', ]")
@example("msg", "string[<=2] a [ 'a' 'b' ]")
@example("msg", "string[] a [\"a\"'b', c]")
@example("msg", 'string A="x # y"')
@example("msg", "string a x=y")
@example("msg", "Sample_Foo_Request a")
@example("srv", "--- \n---")
def test_rosidl_adapter_agrees(adapter: ModuleType, kind: str, text: str) -> None:
    assert own_reading(kind, "Thing", text) == adapter_reading(adapter, kind, "Thing", text)


@settings(max_examples=300, deadline=None)
@given(st.text(alphabet="Aa1_-.", max_size=12))
@example("Foo_Request")
@example("Sample_Foo_Goal_Result")
def test_rosidl_adapter_agrees_on_type_names(adapter: ModuleType, name: str) -> None:
    assert own_reading("msg", name, "") == adapter_reading(adapter, "msg", name, "")


def test_rosidl_adapter_agrees_on_installed_definitions(adapter: ModuleType) -> None:
    share = os.path.join(_wheel_prefix(), "share")
    count = 0
    for path in sorted(Path(share).glob("*/*/*.*")):
        kind = path.suffix[1:]
        if kind in {"msg", "srv", "action"}:
            text = path.read_text(encoding="utf-8")
            assert own_reading(kind, path.stem, text) == adapter_reading(
                adapter, kind, path.stem, text
            ), path
            count += 1
    assert count > 50


@settings(max_examples=300, deadline=None)
@given(st.text())
def test_parser_never_crashes(text: str) -> None:
    for problem in definition(text, "srv").problems:
        at = problem.location
        assert 1 <= at.line <= text.count("\n") + 1
        assert at.column >= 1
        assert at.end_column >= at.column


def test_long_names_are_checked_in_linear_time() -> None:
    """The pattern of rosidl_adapter takes exponential time for this one."""
    assert [kind for kind, *_ in places(f"int32 {'A' * 5000}a=1\n")] == ["constant name"]


# -- looking up


def test_bundle_equals_installed_definitions() -> None:
    installed = Definitions([PrefixSource([_wheel_prefix()])])
    bundled = Definitions([BundleSource()])
    names = [name for name in installed.all_names() if name.split("/")[0] in bundled.packages()]
    assert len(names) > 50
    for name in names:
        item, other = installed.find(name), bundled.find(name)
        assert item is not None
        assert other is not None
        assert _facts(item) == _facts(other)


def test_bundle_lists_its_interfaces() -> None:
    bundled = Definitions([BundleSource()])
    assert bundled.names("std_srvs", "srv") == ["Empty", "SetBool", "Trigger"]
    assert bundled.names("std_srvs", "msg") == []
    assert bundled.names("my_msgs", "msg") is None
    scan = bundled.find("sensor_msgs/msg/LaserScan")
    assert scan is not None
    assert [field.name for field in scan.fields][:3] == ["header", "angle_min", "angle_max"]
    assert scan.fields[-1].type == FieldType("float32", is_array=True)
    assert scan.origin == "sensor_msgs 5.3.6 of ROS 2 Jazzy"
    quaternion = bundled.find("geometry_msgs/msg/Quaternion")
    assert quaternion is not None
    assert quaternion.fields[-1].default == 1.0
    for name in ("std_msgs/String", "std_msgs/msg/Strin", "std_msgs/msg/String/x", "", "x/y/z"):
        assert bundled.find(name) is None


def test_rendered_definitions_round_trip() -> None:
    bundled = Definitions([BundleSource()])
    for name in bundled.all_names():
        interface = bundled.find(name)
        assert interface is not None
        again = parse(
            Source("again", render(interface)), interface.package, interface.kind, interface.name
        )
        assert not again.problems
        assert _facts(interface._replace(sections=again.sections)) == _facts(interface)


def test_rendered_values() -> None:
    text = (
        'string A="it\'s"\nbool B=false\nfloat32 C=0.5\nstring[] d [\'x"y\', "z"]\n'
        "int8[<=2] e [1, 2]\nThing[3] f\nbool g true\n"
    )
    sections = definition(text).sections
    interface = Interface("own_msgs", "msg", "Thing", sections, "here")
    assert render(interface) == text.replace('"z"', '"z"')


def package(name: str, files: dict[str, str], calls: str = "") -> Package:
    manifest = f"<package format='3'><name>{name}</name></package>\n"
    cmake = f"project({name})\n{calls}"
    return Package.of({"package.xml": manifest, "CMakeLists.txt": cmake, **files})


GENERATE = "rosidl_generate_interfaces(${PROJECT_NAME} msg/Status.msg)\n"


def test_workspace_takes_precedence() -> None:
    own = package("std_msgs", {"msg/Status.msg": "int32 code\n"}, GENERATE)
    definitions = Workspace([own]).interfaces
    assert definitions.names("std_msgs", "msg") == ["Status"]
    status = definitions.find("std_msgs/msg/Status")
    assert status is not None
    assert status.origin == "msg/Status.msg"
    assert definitions.find("std_msgs/msg/String") is None
    assert definitions.find("std_srvs/srv/Trigger") is not None


def test_broken_definition_is_unknown() -> None:
    own = package("my_msgs", {"msg/Status.msg": "int32 Code\n"}, GENERATE)
    definitions = Workspace([own]).interfaces
    assert definitions.find("my_msgs/msg/Status") is None
    with pytest.raises(
        InputError, match=r"my_msgs/msg/Status: msg/Status.msg:1: 'Code' is not a valid field"
    ):
        definitions.resolve("Status")


def test_prefix_takes_precedence_over_the_bundle(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    for name in ("std_msgs", "new_msgs"):
        messages = tmp_path / "share" / name / "msg"
        messages.mkdir(parents=True)
        (messages / "Text.msg").write_text("string text\n")
        (messages / "Text.idl").write_text("module ...\n")
        (messages / "Other.idl").write_text("module ...\n")
        index = tmp_path / "share/ament_index/resource_index/rosidl_interfaces"
        index.mkdir(parents=True, exist_ok=True)
        (index / name).touch()
    monkeypatch.setenv("AMENT_PREFIX_PATH", f"{tmp_path / 'missing'}:{tmp_path}")
    definitions = definitions_for()
    assert definitions.names("std_msgs", "msg") == ["Other", "Text"]
    assert definitions.find("std_msgs/msg/Other") is None
    text = definitions.find("new_msgs/msg/Text")
    assert text is not None
    assert text.origin == str(tmp_path / "share/new_msgs/msg/Text.msg")
    assert "new_msgs" in definitions.packages()
    assert definitions.matches("Text") == ["new_msgs/msg/Text", "std_msgs/msg/Text"]
    assert definitions.names("../share/new_msgs", "msg") is None


@pytest.mark.parametrize(
    ("spelling", "parts"),
    [
        ("std_msgs/msg/String", ("std_msgs", "msg", "String")),
        ("std_msgs.msg.String", ("std_msgs", "msg", "String")),
        ("std_msgs/String", ("std_msgs", None, "String")),
        ("msg/String", (None, "msg", "String")),
        ("String", (None, None, "String")),
        ("", (None, None, "")),
    ],
)
def test_spellings_of_type_names(spelling: str, parts: tuple[str | None, str | None, str]) -> None:
    assert spell(spelling) == parts


@pytest.mark.parametrize(
    ("spelling", "message"),
    [
        ("Empty", "'Empty' is ambiguous: it may be std_msgs/msg/Empty or std_srvs/srv/Empty"),
        ("std_msgs/Strin", "no interface 'std_msgs/Strin'; did you mean std_msgs/msg/String?"),
        ("std_msgs/srv/String", "did you mean std_msgs/msg/String?"),
        ("geometry_msg/twist", "did you mean geometry_msgs/msg/Twist?"),
        ("Qwertz", "there is no interface 'Qwertz'; see `ros2-scaffold interfaces`$"),
    ],
)
def test_unknown_and_ambiguous_spellings(spelling: str, message: str) -> None:
    with pytest.raises(InputError, match=message.replace("?", r"\?")):
        Definitions([BundleSource()]).resolve(spelling)


# -- the verb


def run_interfaces_verb(arguments: Sequence[str], directory: Path) -> int:
    return main(["interfaces", "--workspace", str(directory), *arguments])


def test_verb_shows_a_type(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run_interfaces_verb(["SetBool"], tmp_path) == 0
    assert capsys.readouterr().out == (
        "# std_srvs/srv/SetBool\n# from std_srvs 5.3.6 of ROS 2 Jazzy\n"
        "bool data\n---\nbool success\nstring message\n"
    )


def test_verb_lists_a_package_and_its_own_workspace(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    for path, text in {
        "package.xml": "<package format='3'><name>my_msgs</name></package>\n",
        "CMakeLists.txt": "project(my_msgs)\n" + GENERATE,
        "msg/Status.msg": "int32 code\n",
    }.items():
        target = tmp_path / "my_msgs" / path
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_text(text)
    assert run_interfaces_verb(["my_msgs", "std_srvs"], tmp_path) == 0
    assert capsys.readouterr().out.split() == [
        "my_msgs/msg/Status",
        "std_srvs/srv/Empty",
        "std_srvs/srv/SetBool",
        "std_srvs/srv/Trigger",
    ]
    assert run_interfaces_verb(["--format", "json", "my_msgs/Status"], tmp_path) == 0
    assert '"name": "code"' in capsys.readouterr().out


@pytest.mark.parametrize("word", ["Empty", "Strin", "std_msgs/Empti"])
def test_verb_rejects_unknown_types(
    word: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run_interfaces_verb([word], tmp_path) == 2
    error = capsys.readouterr().err
    assert error.startswith("ros2-scaffold: error: ")
    assert "std_msgs/msg/" in error


def _facts(interface: Interface) -> list[object]:
    return [
        (
            section.name,
            [(field.type, field.name, field.default) for field in section.fields],
            [(item.type, item.name, item.value) for item in section.constants],
        )
        for section in interface.sections
    ]


def _wheel_prefix() -> str:
    """Return the prefix of the ROS 2 wheels, or skip the test."""
    std_msgs = pytest.importorskip("std_msgs", reason="needs the ROS 2 wheels (extra `ros`)")
    prefix = str(Path(std_msgs.__file__).parents[4])
    if not os.path.isdir(os.path.join(prefix, "share", "std_msgs")):
        pytest.skip("std_msgs is installed without its definitions")
    return prefix


# -- what generates them


def test_generated_interfaces_listed_in_variables_are_found() -> None:
    calls = (
        "set(messages\n  msg/Status.msg\n  msg/Other.msg\n)\n"
        'rosidl_generate_interfaces(${PROJECT_NAME} ${messages} "srv/Add.srv" ${unknown}\n'
        "  DEPENDENCIES std_msgs SKIP_INSTALL)\n"
    )
    (call,) = generations(package("my_msgs", {}, calls))
    assert call.target == "my_msgs"
    assert [(file.path, file.argument.location.line) for file in call.files] == [
        ("msg/Status.msg", 3),
        ("msg/Other.msg", 4),
        ("srv/Add.srv", 6),
    ]
    assert not call.is_complete
    assert call.dependencies == ["std_msgs"]
    assert call.options == {"DEPENDENCIES", "SKIP_INSTALL"}


@pytest.mark.parametrize(
    "calls",
    ["", GENERATE.replace("msg/Status.msg", "${files}"), GENERATE.replace("Status", "Missing")],
)
def test_package_with_unknown_interfaces_is_not_checked(calls: str) -> None:
    own = package("my_msgs", {"msg/Status.msg": "int32 code\n"}, calls)
    assert Workspace([own]).interfaces.names("my_msgs", "msg") is None
    assert Workspace([own]).interfaces.find("my_msgs/msg/Status") is not None


def test_idl_files_have_only_names() -> None:
    own = package("my_msgs", {"msg/Status.msg": "int32 code\n", "msg/Made.idl": ""}, GENERATE)
    definitions = Workspace([own]).interfaces
    assert definitions.names("my_msgs", "msg") == ["Made", "Status"]
    assert definitions.find("my_msgs/msg/Made") is None
