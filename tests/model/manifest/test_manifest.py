"""package.xml: locations, values, error messages and edits."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Iterable

import pytest
from catkin_pkg.condition import (  # type: ignore[import-untyped]  # it has no types
    evaluate_condition,
)
from hypothesis import example, given
from hypothesis import strategies as st

from scaffold.edits import Edit
from scaffold.model.manifest import edit as manifest_edit
from scaffold.model.manifest.conditions import ConditionError, holds
from scaffold.model.manifest.manifest import Dependency, Manifest, decode
from scaffold.source import Location, ParseError, Source

TALKER = """\
<?xml version="1.0"?>
<?xml-model href="http://download.ros.org/schema/package_format3.xsd" schematypens="x"?>
<package format="3">
  <name>talker</name>
  <version>0.1.0</version>
  <description>Says &lt;hello&gt;
    twice</description>
  <maintainer email="ann@example.org">Ann</maintainer>
  <license>Apache-2.0</license>

  <!-- messages -->
  <buildtool_depend>ament_cmake</buildtool_depend>
  <depend>rclpy</depend>
  <depend>std_msgs</depend>
  <exec_depend condition="$ROS_VERSION == 1">rospy</exec_depend>
  <test_depend>ament_lint_auto</test_depend> <!-- the linters -->

  <export>
    <build_type>ament_cmake</build_type>
  </export>
</package>
"""


def read(text: str) -> Manifest:
    return Manifest.parse(Source("package.xml", text))


def place(location: Location) -> tuple[int, int, int, int]:
    return location[1:]


def apply(text: str, *edits: Edit) -> str:
    for edit in sorted(edits, key=lambda edit: edit.start, reverse=True):
        text = text[: edit.start] + edit.text + text[edit.end :]
    return text


def added(text: str, *edits: Edit) -> list[str]:
    """Return the lines that edits add; fail if they change others."""
    after = apply(text, *edits).splitlines()
    for line in text.splitlines():
        assert line in after
    return [line for line in after if line not in text.splitlines()]


# -- reading


def test_name_version_and_build_type() -> None:
    manifest = read(TALKER)
    assert (manifest.name, manifest.version) == ("talker", "0.1.0")
    assert manifest.description == "Says <hello>\n    twice"
    assert (manifest.format, manifest.declared_format) == (3, "3")
    assert manifest.build_type == "ament_cmake"


def test_missing_elements_are_empty() -> None:
    manifest = read("<package/>")
    assert (manifest.name, manifest.version, manifest.description) == ("", "", "")
    assert manifest.build_type is None
    assert manifest.xml_models == []
    assert manifest.one("name") is None
    assert manifest.all("license") == []


@pytest.mark.parametrize(
    ("written", "number"),
    [("", 1), (' format="2"', 2), (' format="3"', 3), (' format="4"', 4), (' format="x"', 3)],
)
def test_format_number(written: str, number: int) -> None:
    assert read(f"<package{written}/>").format == number


def test_locations_of_an_element() -> None:
    maintainer = read(TALKER).all("maintainer")[0]
    assert place(maintainer.location) == (8, 3, 8, 55)
    assert place(maintainer.name_location) == (8, 4, 8, 14)
    assert place(maintainer.text_location) == (8, 39, 8, 42)
    email = maintainer.attributes["email"]
    assert email.value == "ann@example.org"
    assert place(email.location) == (8, 22, 8, 37)
    assert place(email.name_location) == (8, 15, 8, 20)


def test_locations_over_several_lines() -> None:
    description = read(TALKER).all("description")[0]
    assert place(description.location) == (6, 3, 7, 24)
    assert place(description.text_location) == (6, 16, 7, 10)


def test_locations_around_the_root() -> None:
    manifest = read(TALKER)
    (model,) = manifest.xml_models
    assert model.href == "http://download.ros.org/schema/package_format3.xsd"
    assert place(model.location) == (2, 1, 2, 89)
    assert [place(comment.location) for comment in manifest.comments] == [
        (11, 3, 11, 20),
        (16, 46, 16, 66),
    ]


def test_offsets_for_splicing() -> None:
    text = "<a><b  c='1' >x</b ><d/></a>"
    b, d = read(text).root.children
    assert [text[: b.start], text[b.start : b.open_end]] == ["<a>", "<b  c='1' >"]
    assert [text[b.open_end : b.close_start], text[b.close_start : b.end]] == ["x", "</b >"]
    assert (d.raw, d.is_empty_tag, d.close_start, d.end) == ("<d/>", True, 24, 24)


@pytest.mark.parametrize("lead", ["", "\ufeff", "<!-- ä😀 -->\n", "<!-- ä -->" * 100])
def test_offsets_are_characters(lead: str) -> None:
    text = f"{lead}<package>é<name>  talkér </name><b é='ü'/></package>"
    manifest = read(text)
    name, other = manifest.root.children
    assert (name.raw, name.text) == ("<name>  talkér </name>", "talkér")
    start, end = name.text_span
    assert text[start:end] == "talkér"
    assert other.raw == "<b é='ü'/>"
    value = other.attributes["é"].location
    offset = manifest.source.offset
    assert text[offset(value.line, value.column) : offset(value.end_line, value.end_column)] == "ü"


@pytest.mark.parametrize(
    ("markup", "text", "written"),
    [
        ("<a>x</a>", "x", "x"),
        ("<a> x y\n</a>", "x y", "x y"),
        ("<a>x &amp; y</a>", "x & y", "x &amp; y"),
        ("<a>&lt;&#65;</a>", "<A", "&lt;&#65;"),
        ("<a><!-- c --> x <!-- d --></a>", "x", "x"),
        ("<a>x<!-- c -->y</a>", "xy", "x<!-- c -->y"),
        ("<a><![CDATA[ x & y ]]></a>", "x & y", "x & y"),
        ("<a>x<b>y</b>z</a>", "xyz", "x<b>y</b>z"),
        ("<a>x\r\ny</a>", "x\ny", "x\r\ny"),
        ("<a></a>", "", ""),
        ("<a/>", "", ""),
    ],
)
def test_text_of_an_element(markup: str, text: str, written: str) -> None:
    (element,) = read(f"<package>{markup}</package>").root.children
    start, end = element.text_span
    assert element.text == text
    assert f"<package>{markup}"[start:end] == written


def test_own_text_excludes_children() -> None:
    assert read("<package>a<b>c</b> d</package>").root.own_text == "a d"


def test_attributes_with_references_and_odd_whitespace() -> None:
    element = read("<a b = '1 > &quot;2&quot;'\n\tc=\"\"/>").root
    assert {name: item.value for name, item in element.attributes.items()} == {
        "b": '1 > "2"',
        "c": "",
    }
    assert place(element.attributes["c"].location) == (2, 5, 2, 5)
    assert element.get("b") == '1 > "2"'
    assert element.get("d") is None


def test_children_and_descendants() -> None:
    root = read("<a><b><c/><d><e/></d></b><b/>x</a>").root
    assert [child.tag for child in root.children] == ["b", "b"]
    assert [element.tag for element in root.descendants()] == ["b", "c", "d", "e", "b"]
    assert root.children[0].children[1].parent is root.children[0]
    assert len(root.all("b")) == 2
    assert root.one("c") is None


# -- dependencies


def test_dependencies_in_order() -> None:
    result = read(TALKER).dependencies
    assert [(item.kind, item.name, item.condition) for item in result] == [
        ("buildtool_depend", "ament_cmake", None),
        ("depend", "rclpy", None),
        ("depend", "std_msgs", None),
        ("exec_depend", "rospy", "$ROS_VERSION == 1"),
        ("test_depend", "ament_lint_auto", None),
    ]
    assert place(result[1].location) == (13, 11, 13, 16)


def test_depends_on_by_kind() -> None:
    manifest = read(TALKER)
    assert list(manifest.depends("depend")) == ["rclpy", "std_msgs"]
    assert list(manifest.depends("exec_depend", "test_depend")) == ["rospy", "ament_lint_auto"]
    assert isinstance(manifest.depends()["rospy"], Dependency)
    assert len(manifest.depends()) == 5


def test_names_of_format_3() -> None:
    manifest = read(
        "<package format='3'><depend>a</depend><build_depend>b</build_depend>"
        "<build_export_depend>c</build_export_depend><exec_depend>d</exec_depend>"
        "<buildtool_depend>e</buildtool_depend><test_depend>f</test_depend>"
        "<buildtool_export_depend>g</buildtool_export_depend><doc_depend>h</doc_depend>"
        "<conflict>i</conflict></package>"
    )
    assert manifest.build_names == {"a", "b", "e"}
    assert manifest.build_export_names == {"a", "c", "g"}
    assert manifest.run_names == {"a", "d"}
    assert manifest.test_names == {"f"}
    assert manifest.names_for("doc") == {"h"}
    assert manifest.declared_names == set("abcdefgh")


def test_names_of_format_1() -> None:
    manifest = read(
        "<package><build_depend>a</build_depend><run_depend>b</run_depend>"
        "<test_depend>c</test_depend></package>"
    )
    assert (manifest.build_names, manifest.run_names) == ({"a"}, {"b"})
    assert manifest.build_export_names == {"b"}


def test_dependencies_with_false_conditions_are_ignored() -> None:
    manifest = read(TALKER)
    assert "rospy" not in manifest.run_names
    assert "rospy" in manifest.declared_names
    assert [item.active for item in manifest.dependencies] == [True, True, True, False, True]


def test_group_elements() -> None:
    manifest = read(
        "<package><group_depend>a</group_depend><member_of_group>b</member_of_group>"
        "<member_of_group condition='$ROS_VERSION == 1'>c</member_of_group></package>"
    )
    assert [element.text for element in manifest.groups] == ["a", "b", "c"]
    assert [manifest.member_of(name) for name in "abc"] == [False, True, False]


def test_build_type_that_holds_on_jazzy() -> None:
    manifest = read(
        "<package><export><build_type condition='$ROS_VERSION == 1'>catkin</build_type>"
        "<build_type condition='$ROS_VERSION == 2'>ament_python</build_type></export></package>"
    )
    assert manifest.build_type == "ament_python"
    assert [element.text for element in manifest.build_type_elements] == ["catkin", "ament_python"]


# -- conditions


@pytest.mark.parametrize(
    ("condition", "value"),
    [
        ("$ROS_VERSION == 2", True),
        ("$ROS_VERSION==1", False),
        ('$ROS_DISTRO == "jazzy"', True),
        ("$ROS_DISTRO >= humble and $ROS_VERSION != 1", True),
        ("a == b or c == c and d == e", False),
        ("(a == a or b == c) and (d == d)", True),
        ("((a == a))", True),
        ("$UNKNOWN == ''", True),
    ],
)
def test_condition_value(condition: str, value: bool) -> None:
    assert holds(condition) is value


@pytest.mark.parametrize(
    ("condition", "offset"),
    [
        ("", 0),
        ("$A = 2", 3),
        ("$A", 2),
        ("a == b c == d", 7),
        ("(a == b", 7),
        ("a == b)", 6),
        ("a == b and", 10),
        ("a == 1.2", 6),
    ],
)
def test_syntax_error_in_condition(condition: str, offset: int) -> None:
    with pytest.raises(ConditionError) as caught:
        holds(condition)
    assert caught.value.offset == offset


TERMS = st.sampled_from(["$ROS_VERSION", "$X", "1", "2", '"a b"', "'x'", "a-b", "jazzy"])
OPERATORS = st.sampled_from(["==", "!=", "<", "<=", ">", ">="])
COMPARISONS = st.tuples(TERMS, OPERATORS, TERMS).map(" ".join)
CONDITIONS = st.recursive(
    COMPARISONS,
    lambda inner: st.one_of(
        st.tuples(inner, st.sampled_from(["and", "or"]), inner).map(" ".join),
        inner.map("({})".format),
    ),
    max_leaves=6,
)


# catkin_pkg uses old names of pyparsing.
catkin = pytest.mark.filterwarnings("ignore::DeprecationWarning")


@catkin
@given(CONDITIONS)
def test_condition_value_equals_that_of_catkin_pkg(condition: str) -> None:
    environment = {"ROS_VERSION": "2", "X": "b"}
    assert holds(condition, environment) is evaluate_condition(condition, environment)


@catkin
@given(st.lists(st.sampled_from(["$A", "a", " ", "==", "<", "and", "or", "(", ")", "'", "="])))
def test_syntax_errors_in_conditions_equal_those_of_catkin_pkg(pieces: list[str]) -> None:
    condition = " ".join(pieces)
    try:
        mine = holds(condition, {})
    except ConditionError:
        with pytest.raises(ValueError, match="failed to parse"):
            evaluate_condition(condition, {})
    else:
        assert evaluate_condition(condition, {}) is mine


# -- messages


@pytest.mark.parametrize(
    ("text", "at", "message"),
    [
        ("", "1:1", "the file is empty"),
        ("\n<?xml version='1.0'?><a/>", "1:1", 'a blank line before "<?xml": it must come first'),
        ("x<?xml version='1.0'?><a/>", "1:1", 'text before "<?xml": it must come first'),
        ("<?xml version=1.0?><a/>", "1:1", 'write the first line as <?xml version="1.0"?>'),
        (
            "<a>\n <b>x</c>\n</a>",
            "2:6",
            "</b> expected, <b> opened at line 2 is not closed",
        ),
        ("<a>\n <b>\n</a>", "3:1", "</b> expected, <b> opened at line 2 is not closed"),
        ("<a>\n<b/>\n", "3:1", "end of file, but <a> opened at line 1 is not closed"),
        ("<a/></a>", "1:5", "this end tag closes nothing"),
        ("<a>x & y</a>", "1:6", 'write "&amp;" for "&"'),
        ("<a b='x&y'/>", "1:8", 'write "&amp;" for "&"'),
        ("<a>é < 2</a>", "1:6", 'write "&lt;" for "<", or a tag name after it'),
        ("<a>&nbsp;</a>", "1:4", '"&nbsp;" means nothing in package.xml: write the character'),
        ("<a>&#1;</a>", "1:4", '"&#1;" is not a character that XML allows'),
        ("<a b='1' b='2'/>", "1:10", "the attribute 'b' is a duplicate"),
        ("<a b=1/>", "1:6", "a value in quotes expected in the tag <a>"),
        ("<a b='1'c='2'/>", "1:9", "a space expected between attributes of <a>"),
        ("<a b/>", "1:5", "an attribute of <a> has no value"),
        ("<a b=\u201c1\u201d/>", "1:6", "write a plain quote for \u201c"),
        ("<a\n<b/></a>", "1:1", '">" expected: the tag <a is not closed'),
        ("<a b='1", "1:6", "a second ' expected: the value is not closed"),
        ("<a><!-- b</a>", "1:4", '"-->" expected: this comment is not closed'),
        ("<a><!-- b -- c --></a>", "1:11", '"--" is not allowed inside a comment'),
        ("<a><![CDATA[b</a>", "1:4", '"]]>" expected: this CDATA section is not closed'),
        ("<a>]]></a>", "1:4", 'write "]]&gt;" for "]]>"'),
        ("<a/><b/>", "1:5", "<b> after />, the end of the root element"),
        ("<a></a>x", "1:8", "text after </a>, the end of the root element"),
        ("<b:a/>", "1:2", 'the prefix "b:" is not declared'),
        ("<a>\0</a>", "1:4", "the character U+0000 is not allowed here"),
        ("<a>\ud800</a>", "1:4", "the character U+D800 is not allowed here"),
    ],
)
def test_message_of_syntax_error(text: str, at: str, message: str) -> None:
    with pytest.raises(ParseError) as caught:
        read(text)
    location = caught.value.location
    assert (f"{location.line}:{location.column}", caught.value.message) == (at, message)


def test_document_types_are_rejected() -> None:
    bomb = '<!ENTITY a "aaaaaaaa">' + "".join(
        f'<!ENTITY a{n + 1} "&a{n or ""};&a{n or ""};">' for n in range(60)
    )
    for inside in ("", '[<!ENTITY b SYSTEM "file:///etc/passwd">]', f"[{bomb}]"):
        with pytest.raises(ParseError, match="document type declaration") as caught:
            read(f"\n<!DOCTYPE package {inside}>\n<package>&a60;</package>")
        assert place(caught.value.location) == (2, 1, 2, 10)


# -- encodings


def test_declared_encoding() -> None:
    text = '<?xml version="1.0" encoding="ISO-8859-1"?>\n<package><name>é</name></package>\n'
    source = decode("package.xml", text.encode("latin-1"))
    assert (source.text, source.encoding) == (text, "iso8859-1")
    assert Manifest.parse(source).name == "é"


def test_utf8_by_default_and_by_declaration() -> None:
    for lead in ("", '<?xml version="1.0" encoding="utf-8"?>', "\ufeff"):
        source = decode("package.xml", f"{lead}<a>é</a>".encode())
        assert (source.text, source.encoding) == (f"{lead}<a>é</a>", "utf-8")


@pytest.mark.parametrize("encoding", ["utf-16", "utf-16-le", "utf-16-be", "utf-32"])
def test_wide_encodings_are_rejected(encoding: str) -> None:
    with pytest.raises(ParseError, match="save it as UTF-8"):
        decode("package.xml", "<package/>".encode(encoding))


@pytest.mark.parametrize("encoding", ["utf-16", "gbk", "utf-7", "hex", "unicode_escape", "what"])
def test_other_encodings_are_rejected(encoding: str) -> None:
    data = f'<?xml version="1.0"\n encoding="{encoding}"?><package/>'.encode()
    with pytest.raises(ParseError, match=f"the declared encoding '{encoding}' is not") as caught:
        decode("package.xml", data)
    assert place(caught.value.location) == (2, 12, 2, 12 + len(encoding))


def test_undecodable_bytes() -> None:
    with pytest.raises(ParseError, match="byte 0xff is not valid UTF-8") as caught:
        decode("package.xml", b"<package>\n\xff</package>")
    assert caught.value.location.line == 2


# -- hostile input


PIECES = (
    ("<a>", "</a>", "<b", " c='1'", ' d="&lt;"', ">", "/>", "<!--", "-->", "--", "&", "&amp;"),
    ("<?xml version='1.0'?>", "<?p q?>", "<![CDATA[", "]]>", "\n", "\r\n", " ", "é", "😀", "x"),
    ("<", "=", "'", '"', "\0", "\ufeff", "\ud800", "</", "<!", "&#", ";", "x:", " xmlns:x='u'"),
)
MARKUP = st.lists(st.sampled_from([*PIECES[0], *PIECES[1], *PIECES[2]]), max_size=24).map("".join)


@given(st.one_of(MARKUP, MARKUP.map("<a>{}</a>".format), st.text(max_size=30)))
@example("<a>" * 3000)
@example("<" * 3000)
def test_any_text_parses_or_raises_parse_error(text: str) -> None:
    if is_well_formed(text):
        check_places(read(text), text)
        return
    with pytest.raises(ParseError) as caught:
        read(text)
    location = caught.value.location
    assert 1 <= location.line <= text.count("\n") + 1
    assert location[1:3] <= location[3:5]
    assert caught.value.message


def is_well_formed(text: str) -> bool:
    if "<!DOCTYPE" in text:
        return False
    try:
        ET.fromstring(text.encode("utf-8", "surrogatepass"))  # noqa: S314  no DOCTYPE, no harm
    except ET.ParseError:
        return False
    return True


def check_places(manifest: Manifest, text: str) -> None:
    for element in [manifest.root, *manifest.root.descendants()]:
        assert text.startswith(f"<{element.tag}", element.start)
        assert text[element.end - 1] == ">"
        assert element.start < element.open_end <= element.close_start <= element.end
        for attribute in element.attributes.values():
            assert attribute.value == element.get(attribute.name)
        start, end = element.text_span
        assert element.open_end <= start <= end <= element.close_start


def test_deep_nesting() -> None:
    depth = 50_000
    manifest = read("<a>" * depth + "x" + "</a>" * depth)
    assert manifest.root.text == "x"
    assert sum(1 for _ in manifest.root.descendants()) == depth - 1


def test_long_line() -> None:
    name = "é" * 1_000_000
    manifest = read(f"<package><name>{name}</name><depend>x</depend></package>")
    assert len(manifest.name) == 1_000_000
    assert place(manifest.dependencies[0].location) == (1, 1_000_031, 1, 1_000_032)


# -- edits


@pytest.mark.parametrize(
    ("tag", "text", "line", "number"),
    [
        ("depend", "sensor_msgs", "  <depend>sensor_msgs</depend>", 14),
        ("depend", "ament_index_python", "  <depend>ament_index_python</depend>", 13),
        ("depend", "tf2_ros", "  <depend>tf2_ros</depend>", 15),
        ("exec_depend", "launch", "  <exec_depend>launch</exec_depend>", 15),
        ("build_depend", "x", "  <build_depend>x</build_depend>", 13),
        ("test_depend", "python3-pytest", "  <test_depend>python3-pytest</test_depend>", 17),
        ("member_of_group", "x", "  <member_of_group>x</member_of_group>", 17),
        ("url", "http://a/?b&c", "  <url>http://a/?b&amp;c</url>", 10),
        ("license", "MIT", "  <license>MIT</license>", 10),
    ],
)
@pytest.mark.parametrize("newline", ["\n", "\r\n"])
def test_insert_element(tag: str, text: str, line: str, number: int, newline: str) -> None:
    before = TALKER.replace("\n", newline)
    after = apply(before, read(before).insert(tag, text)).split(newline)
    assert after[number - 1] == line
    assert after[: number - 1] + after[number:] == before.split(newline)


def test_insert_into_an_unsorted_group_appends() -> None:
    before = "<package>\n\t<depend>b</depend>\n\t<depend>a</depend>\n</package>\n"
    after = (
        "<package>\n\t<depend>b</depend>\n\t<depend>a</depend>\n\t<depend>A</depend>\n</package>\n"
    )
    assert apply(before, read(before).insert("depend", "A")) == after


def test_insert_after_the_comment_at_the_end_of_a_line() -> None:
    before = "<package>\n  <depend>a</depend> <!-- why -->\n</package>\n"
    after = "<package>\n  <depend>a</depend> <!-- why -->\n  <depend>b</depend>\n</package>\n"
    assert apply(before, read(before).insert("depend", "b")) == after


@pytest.mark.parametrize(
    ("before", "after"),
    [
        ("<package/>", "<package>\n  <depend>b</depend>\n</package>"),
        ("<package></package>", "<package>\n  <depend>b</depend>\n</package>"),
        (
            "<package><name>a</name><export/></package>",
            "<package><name>a</name><depend>b</depend><export/></package>",
        ),
        (
            "<package>\n <export/>\n</package>",
            "<package>\n <depend>b</depend>\n <export/>\n</package>",
        ),
    ],
)
def test_insert_into_oddly_formatted_files(before: str, after: str) -> None:
    assert apply(before, read(before).insert("depend", "b")) == after


def test_insert_with_attributes() -> None:
    manifest = read(TALKER)
    edit = manifest.insert("maintainer", "Bob", {"email": 'b"@x'})
    assert added(TALKER, edit) == ['  <maintainer email="b&quot;@x">Bob</maintainer>']


def test_remove_element() -> None:
    manifest = read(TALKER)
    (rclpy, _) = manifest.all("depend")
    assert apply(TALKER, manifest.remove(rclpy)) == TALKER.replace("  <depend>rclpy</depend>\n", "")
    (lint,) = manifest.all("test_depend")
    line = "  <test_depend>ament_lint_auto</test_depend> <!-- the linters -->\n"
    assert apply(TALKER, manifest.remove(lint)) == TALKER.replace(line, "")
    together = "<package><a/> <b/> <c/></package>"
    manifest = read(together)
    assert apply(together, manifest.remove(manifest.root.children[1])) == (
        "<package><a/> <c/></package>"
    )


@given(
    st.sampled_from(["depend", "exec_depend", "test_depend", "author", "url", "group_depend"]),
    st.sampled_from(["a", "m", "rclpy", "zzz"]),
    st.booleans(),
)
def test_remove_undoes_insert(tag: str, text: str, windows: bool) -> None:
    before = TALKER.replace("\n", "\r\n") if windows else TALKER
    edit = read(before).insert(tag, text)
    manifest = read(apply(before, edit))
    start = edit.start + edit.text.index("<")
    (element,) = [child for child in manifest.root.children if child.start == start]
    assert (element.tag, element.text) == (tag, text)
    assert apply(manifest.source.text, manifest.remove(element)) == before


def test_rename_element() -> None:
    before = "<package><run_depend>a</run_depend><b/></package>"
    manifest = read(before)
    run, empty = manifest.root.children
    edits = [*manifest_edit.rename(manifest.document, run, "exec_depend")]
    edits += manifest_edit.rename(manifest.document, empty, "c")
    assert apply(before, *edits) == "<package><exec_depend>a</exec_depend><c/></package>"


BUILD_TYPE = "  <export>\n    <build_type>t</build_type>\n  </export>\n"


def test_reorder_moves_comments_and_blank_lines() -> None:
    before = (
        "<package>\n  <name>a</name>\n  <license>MIT</license>\n\n  <!-- us -->\n"
        "  <maintainer email='x'>X</maintainer> <!-- me -->\n  <depend>b</depend>\n</package>\n"
    )
    after = (
        "<package>\n  <name>a</name>\n\n  <!-- us -->\n"
        "  <maintainer email='x'>X</maintainer> <!-- me -->\n  <license>MIT</license>\n"
        "  <depend>b</depend>\n</package>\n"
    )
    edit = manifest_edit.reorder(read(before).document)
    assert edit is not None
    assert apply(before, edit) == after
    assert manifest_edit.reorder(read(after).document) is None


def test_reorder_does_not_change_a_file_with_stray_text() -> None:
    text = "<package>x<depend>b</depend><name>a</name></package>"
    assert manifest_edit.reorder(read(text).document) is None


TAGS = st.sampled_from(["name", "license", "maintainer", "url", "depend", "exec_depend", "export"])


@given(st.lists(TAGS, max_size=12))
def test_reorder_keeps_everything(tags: Iterable[str]) -> None:
    lines = [f"  <{tag}>{number}</{tag}>\n" for number, tag in enumerate(tags)]
    manifest = read("<package>\n" + "".join(lines) + "</package>\n")
    edit = manifest_edit.reorder(manifest.document)
    text = manifest.source.text if edit is None else apply(manifest.source.text, edit)
    assert sorted(text.splitlines()) == sorted(manifest.source.text.splitlines())
    numbers = [manifest_edit.section(child.tag) for child in read(text).root.children]
    assert numbers == sorted(number for number in numbers if number is not None)
