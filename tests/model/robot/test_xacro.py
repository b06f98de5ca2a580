"""Expansion of xacro files, compared with the documentation of xacro."""

from __future__ import annotations

import pytest

from scaffold.files.tree import MemoryTree
from scaffold.model.package import Package
from scaffold.model.robot.expressions import evaluate, literal, truth
from scaffold.model.robot.files import robot_file
from scaffold.model.robot.robots import robots
from scaffold.source import ParseError, UnreadEndError

HEAD = '<robot name="robot" xmlns:xacro="http://www.ros.org/wiki/xacro">'


def package(**files: str) -> Package:
    """Return a package of xacro files, each named by a keyword."""
    texts = {
        f"{name}.xacro": f"{HEAD}{text}</robot>" if not text.startswith("<?") else text
        for name, text in files.items()
    }
    return Package(MemoryTree({path: text.encode() for path, text in texts.items()}))


def links(**files: str) -> list[str]:
    """Return the names of the links of the only robot."""
    (robot,) = robots(package(**files)).whole
    return [part.get("name") or "" for part in robot.root.all("link")]


def test_macro_parameters_defaults_and_forwarded_values() -> None:
    text = (
        '<xacro:property name="side" value="left"/>'
        '<xacro:macro name="wheel" params="name n:=${1 + 1} side:=^|right size:=^|big">'
        '<link name="${side}_${size}_${name}_${n}"/></xacro:macro>'
        '<xacro:wheel name="front"/><xacro:wheel name="rear" n="7"/>'
    )
    assert links(a=text) == ["left_big_front_2", "left_big_rear_7"]


def test_block_is_expanded_in_the_scope_of_the_caller() -> None:
    text = (
        '<xacro:property name="a" value="outer"/>'
        '<xacro:macro name="m" params="a *one **two"><xacro:insert_block name="one"/>'
        '<xacro:insert_block name="two"/></xacro:macro>'
        '<xacro:m a="inner"><link name="${a}"/><group><link name="x"/><link name="y"/></group>'
        "</xacro:m>"
    )
    assert links(a=text) == ["outer", "x", "y"]


def test_elements_conditional_on_an_argument_are_optional() -> None:
    text = (
        '<xacro:arg name="arm" default="true"/><link name="base"/>'
        '<xacro:if value="$(arg arm)"><link name="arm"/></xacro:if>'
        '<xacro:if value="false"><link name="never"/></xacro:if>'
        '<xacro:unless value="${1 == 2}"><link name="always"/></xacro:unless>'
    )
    (robot,) = robots(package(a=text)).whole
    assert [(part.get("name"), part.is_certain) for part in robot.root.all("link")] == [
        ("base", True),
        ("arm", False),
        ("always", True),
    ]


def test_included_file_is_no_separate_robot() -> None:
    included = '<link name="${prefix}wheel"/>'
    text = '<xacro:property name="prefix" value="my_"/><xacro:include filename="b.xacro"/>'
    assert links(a=text, b=included) == ["my_wheel"]


def test_unknown_included_file_makes_names_unknown() -> None:
    text = (
        '<xacro:include filename="$(find other)/urdf/parts.xacro"/>'
        '<link name="${radius}"/><xacro:gripper/>'
    )
    (robot,) = robots(package(a=text)).whole
    assert robot.problems.is_open
    assert robot.problems.undefined == []


def test_recursive_macros_are_bounded() -> None:
    text = '<xacro:macro name="m"><link name="a"/><xacro:m/></xacro:macro><xacro:m/>'
    (robot,) = robots(package(a=text)).whole
    assert robot.problems.is_open


@pytest.mark.parametrize(
    ("expression", "value"),
    [
        ("1 + 2 * 3", 7),
        ("pi / 2 > 1 and not False", True),
        ("math.radians(180) == pi", True),
        ("'a' + 'b' if 1 < 2 else 'c'", "ab"),
        ("max(1, 2.5)", 2.5),
    ],
)
def test_expressions_are_evaluated_like_python(expression: str, value: object) -> None:
    assert evaluate(expression, lambda name: {"False": False}[name]) == value


def test_numeric_property_is_a_number() -> None:
    assert [literal(text) for text in ("1", "1.5", "true", "1_0", "'1'", "x")] == [
        1,
        1.5,
        True,
        "1_0",
        "1",
        "x",
    ]


def test_invalid_condition_is_rejected() -> None:
    assert [truth(value) for value in ("true", "0", 1.0, False)] == [True, False, True, False]
    with pytest.raises(ValueError, match="invalid literal"):
        truth("yes")


def test_surplus_quote_in_a_default_is_accepted() -> None:
    text = (
        '<xacro:macro name="m" params="a:=\'\'\'"><link name="[${a}]"/></xacro:macro>'
        '<xacro:m a="given"/>'
    )
    assert links(a=text) == ["[given]"]


def test_undeclared_namespace_is_accepted_in_urdf() -> None:
    text = b'<robot name="a"><link name="a"/><drake:proximity_properties/></robot>'
    files = Package(MemoryTree({"a.urdf": text, "a.xacro": text}))
    assert robot_file(files, "a.urdf") is not None
    with pytest.raises(ParseError, match='"drake:" is not declared'):
        robot_file(files, "a.xacro")


@pytest.mark.parametrize(
    ("text", "launch", "is_read"),
    [
        ('<robot name="a"><link name="a"/></robot>\n</robot>', "", True),
        ('<property name="p"/>\n<robot name="a"><link name="a"/></robot>', "", True),
        ('<robot name="a"><link name="a"/></robot>\n</robot>', "Command(['xacro a.urdf'])", False),
        ('<robot name="a"><link name="a"></robot>', "", False),
        ('<robot name="a"/><link><robot>', "", False),
    ],
)
def test_text_around_the_robot_element(text: str, launch: str, is_read: bool) -> None:
    files = Package.of({"a.urdf": text, "launch/a.launch.py": launch})
    with pytest.raises(ParseError) as raised:
        robot_file(files, "a.urdf")
    assert isinstance(raised.value, UnreadEndError) is is_read
