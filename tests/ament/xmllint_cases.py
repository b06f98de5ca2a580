"""Packages and what ament_xmllint reports about them, by code."""

from __future__ import annotations

from collections.abc import Mapping

from scaffold.check.rules.rule import Example, Report
from scaffold.diagnostic import Severity

HEAD = '<launch xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance"\n'
USE = HEAD + '        xsi:noNamespaceSchemaLocation="a.xsd">\n'
SCHEMA = """\
<xs:schema xmlns:xs="http://www.w3.org/2001/XMLSchema">
  <xs:element name="launch">
    <xs:complexType>
      <xs:sequence><xs:element name="node" maxOccurs="unbounded"/></xs:sequence>
    </xs:complexType>
  </xs:element>
</xs:schema>
"""
INCLUDES = """\
<xs:schema xmlns:xs="http://www.w3.org/2001/XMLSchema">
  <xs:include schemaLocation="b.xsd"/>
  <xs:element name="launch"/>
</xs:schema>
"""
FITS = """\
<xs:schema xmlns:xs="http://www.w3.org/2001/XMLSchema">
  <xs:element name="launch"/>
</xs:schema>
"""


def _uses(schema: str) -> str:
    return f'{HEAD}        xsi:noNamespaceSchemaLocation="{schema}"/>\n'


RIGHT = """\
<package format="3">
  <name>talker</name>
  <version>1.0.0</version>
  <description>Talks.</description>
  <maintainer email="a@b.org">A</maintainer>
  <license>Apache-2.0</license>
  <author>B</author>
  <depend>rclpy</depend>
  <export/>
</package>
"""
AUTHOR, LICENCE = "  <author>B</author>\n", "  <license>Apache-2.0</license>\n"
EARLY = RIGHT.replace(LICENCE + AUTHOR, AUTHOR + LICENCE)
LATE = RIGHT.replace("  <export/>\n", "  <export/>\n  <exec_depend>launch</exec_depend>\n")
MANIFEST_HEAD = '<package format="{}">\n  <name>talker</name>\n'
ALL = """\
<package format="3">
  <name>talker</name>
  <version>1.0.0</version>
  <description>Talks.</description>
  <maintainer email="a@b.org">A</maintainer>
  <license>Apache-2.0</license>
</package>
"""
ONE = '<package format="3">\n  <name>talker</name>\n'

LINE = (
    '<?xml-model href="http://download.ros.org/schema/package_format{}.xsd" '
    'schematypens="http://www.w3.org/2001/XMLSchema"?>\n'
)


DEPEND = '<package format="{}">\n  <depend condition="{}">rclpy</depend>\n</package>\n'


CASES: Mapping[str, tuple[Example, ...]] = {
    "PX050": (
        Example(
            "well-formed",
            {"package.xml": "<package/>\n", "launch/talker.launch.xml": "<launch>\n</launch>\n"},
        ),
        Example(
            "what a test reads, where no linter does",
            {"package.xml": "<package/>\n", "test/data/empty.xml": ""},
        ),
        Example(
            "plugins in two elements at the top, and part of a document, where no linter runs",
            {
                "package.xml": "<package/>\n",
                "resource/topics.xml": "<topic/>\n<data_writer/>\n",
                "plugins.xml": '<library path="a"/>\n<library path="b"/>\n',
                "more.xml": '<?xml version="1.0"?>\n<!-- two -->\n'
                '<library path="a"/>\n<library path="b"/>\n',
            },
        ),
        Example(
            "a template in a description of plugins, where no linter runs",
            {
                "package.xml": "<package/>\n",
                "plugins.xml": '<library path="a">\n  <class type="Solver<Chain>"/>\n</library>\n',
            },
        ),
        Example(
            "a license before the profiles of Fast DDS, and a second element that nothing reads",
            {
                "package.xml": "<package/>\n",
                "config/dds.xml": '<?xml version="1.0"?>\n<license>Free</license>\n<profiles/>\n',
                "config/map.xml": '<?xml version="1.0"?>\n<license>Free</license>\n<map/>\n',
            },
            "config/map.xml:3:1: <map> after </license>, the end of the root element",
        ),
        Example(
            "two dashes in a comment of a behavior tree, where no linter runs",
            {
                "package.xml": "<package/>\n",
                "trees/drive.xml": "<!-- drive --fast -->\n"
                '<root BTCPP_format="4"><BehaviorTree ID="Drive"/></root>\n',
            },
        ),
        Example(
            "a version of XML that only xmllint refuses, where no linter runs",
            {
                "package.xml": "<package/>\n",
                "launch/talker.launch.xml": '<?xml version="1.0."?>\n<launch/>\n',
            },
        ),
        Example(
            "a file, and a linter, that the package excludes",
            {
                "package.xml": "<package>\n"
                "  <test_depend>ament_lint_auto</test_depend>\n"
                "  <test_depend>ament_cmake_xmllint</test_depend>\n</package>\n",
                "CMakeLists.txt": "project(talker)\nif(BUILD_TESTING)\n"
                "  find_package(ament_lint_auto REQUIRED)\n"
                "  set(AMENT_LINT_AUTO_FILE_EXCLUDE config/broken.xml)\n"
                "  ament_lint_auto_find_test_dependencies()\nendif()\nament_package()\n",
                "config/broken.xml": "<a>\n",
            },
        ),
        Example(
            "an element is not closed",
            {"launch/talker.launch.xml": "<launch>\n  <node>\n</launch>\n"},
            Report(
                "launch/talker.launch.xml:3:1",
                "</node> expected, <node> opened at line 2 is not closed",
            ),
        ),
        Example(
            "empty, where no linter runs",
            {"plugins.xml": ""},
            Report("plugins.xml:1:1", "the file is empty", severity=Severity.WARNING),
        ),
        Example("not linted", {"AMENT_IGNORE": "", "broken.xml": "<a>"}),
    ),
    "PX051": (
        Example("fits", {"a.xsd": SCHEMA, "a.launch.xml": f"{USE}  <node/>\n</launch>\n"}),
        Example("on the network", {"a.xml": USE.replace("a.xsd", "http://a.org/a") + "</launch>"}),
        Example(
            "does not fit",
            {"a.xsd": SCHEMA, "a.launch.xml": f"{USE}  <nod/>\n</launch>\n"},
            Report(
                "a.launch.xml:3:1",
                "does not fit a.xsd: Element 'nod': This element is not expected. "
                "Expected is ( node )",
            ),
        ),
        Example(
            "no such schema",
            {"a.launch.xml": f"{USE}</launch>\n"},
            Report("a.launch.xml:1:1", "names the schema a.xsd, but there is no file a.xsd"),
        ),
    ),
    "PX052": (
        Example("one file of the package", {"a.xsd": FITS, "a.launch.xml": _uses("a.xsd")}),
        Example(
            "a schema that includes another",
            {"a.xsd": INCLUDES, "b.xsd": FITS, "a.launch.xml": _uses("a.xsd")},
            Report(
                "a.launch.xml:1:1",
                "names the schema 'a.xsd', which is not checked: it includes other files",
            ),
        ),
        Example(
            "on the network",
            {"a.xml": _uses("https://ros.example.org/launch.xsd")},
            Report(
                "a.xml:1:1",
                "names the schema 'https://ros.example.org/launch.xsd', which is not "
                "checked: it is not a local file",
            ),
        ),
    ),
    "PX060": (
        Example("in order", {"package.xml": RIGHT}),
        Example(
            "<author> before <license>",
            {"package.xml": EARLY},
            Report(
                "package.xml:6:4",
                "<author> must come after <license> in line 7 and before <depend> in line 8",
                fix="Reorder the elements",
            ),
            fixed={"package.xml": RIGHT},
        ),
        Example(
            "<export> before a dependency",
            {"package.xml": LATE},
            Report(
                "package.xml:9:4",
                "<export> must come after <exec_depend> in line 10",
                fix="Reorder the elements",
            ),
            fixed={
                "package.xml": RIGHT.replace(
                    "  <export/>\n", "  <exec_depend>launch</exec_depend>\n  <export/>\n"
                )
            },
        ),
    ),
    "PX061": (
        Example(
            "of format 3",
            {
                "package.xml": MANIFEST_HEAD.format(3)
                + "  <exec_depend>rclpy</exec_depend>\n</package>\n"
            },
        ),
        Example(
            "of format 1 in format 3",
            {
                "package.xml": MANIFEST_HEAD.format(3)
                + "  <run_depend>rclpy</run_depend>\n</package>\n"
            },
            Report(
                "package.xml:3:4",
                "<run_depend> is of format 1: in format 3 it is <exec_depend>",
                unsafe_fix="Replace the element with <exec_depend>",
            ),
            fixed={
                "package.xml": MANIFEST_HEAD.format(3)
                + "  <exec_depend>rclpy</exec_depend>\n</package>\n"
            },
        ),
        Example(
            "of format 3 in format 2",
            {
                "package.xml": MANIFEST_HEAD.format(2)
                + "  <group_depend>a</group_depend>\n</package>\n"
            },
            Report(
                "package.xml:3:4",
                "<group_depend> needs format 3, but this manifest has format 2",
            ),
        ),
        Example(
            "misspelt",
            {"package.xml": MANIFEST_HEAD.format(2) + "  <licence>MIT</licence>\n</package>\n"},
            Report(
                "package.xml:3:4",
                "<licence> is not known in format 2: <license> is",
                unsafe_fix="Replace the element with <license>",
            ),
            fixed={
                "package.xml": MANIFEST_HEAD.format(2) + "  <license>MIT</license>\n</package>\n"
            },
        ),
    ),
    "PX062": (
        Example("all there", {"package.xml": ALL}),
        Example(
            "no license, no maintainer",
            {
                "package.xml": "".join(
                    line
                    for line in ALL.splitlines(keepends=True)
                    if "maintainer" not in line and "license" not in line
                )
            },
            Report("package.xml:1:2", "no <license>: every manifest has one, after <maintainer>"),
            Report(
                "package.xml:1:2",
                "no <maintainer>: every manifest has one, after <description>",
            ),
        ),
        Example(
            "misspelt: said by another rule",
            {"package.xml": ALL.replace("license", "licence")},
        ),
    ),
    "PX063": (
        Example("one", {"package.xml": f"{ONE}</package>\n"}),
        Example(
            "the same again",
            {"package.xml": f"{ONE}  <name>talker</name>\n</package>\n"},
            Report(
                "package.xml:3:4",
                "a second <name>: the first is in line 2",
                fix="Remove the duplicate",
            ),
            fixed={"package.xml": f"{ONE}</package>\n"},
        ),
        Example(
            "another one",
            {"package.xml": f"{ONE}  <name>listener</name>\n</package>\n"},
            Report("package.xml:3:4", "a second <name>: the first is in line 2"),
        ),
    ),
    "PX064": (
        Example(
            "known",
            {
                "package.xml": '<package format="3">\n  <license file="LICENSE">MIT</license>\n'
                '  <depend version_gte="1.2">rclpy</depend>\n</package>\n'
            },
        ),
        Example(
            "misspelt, too early, unknown to the schema",
            {
                "package.xml": '<package format="2">\n'
                '  <version compatibility="1.0.0">1.2.0</version>\n'
                '  <license file="LICENSE">MIT</license>\n'
                '  <depend version_get="1.2">rclpy</depend>\n</package>\n'
            },
            Report(
                "package.xml:2:12",
                "<version compatibility> is in REP 149, but ament_xmllint's schema rejects it",
            ),
            Report(
                "package.xml:3:12",
                "<license file> needs format 3, but this manifest has format 2",
            ),
            Report(
                "package.xml:4:11",
                '<depend> has no attribute "version_get": it has "version_gt"',
            ),
        ),
    ),
    "PX065": (
        Example("the same", {"package.xml": LINE.format(2) + '<package format="2"/>\n'}),
        Example("no schema, format 1", {"package.xml": "<package/>\n"}),
        Example(
            "different",
            {"package.xml": LINE.format(2) + '<package format="3"/>\n'},
            Report(
                "package.xml:1:1",
                "names the schema of format 2, but <package> has 3",
                fix="Use the schema of format 3",
                severity=Severity.WARNING,
            ),
            fixed={"package.xml": LINE.format(3) + '<package format="3"/>\n'},
        ),
        Example(
            "none, so 1",
            {"package.xml": LINE.format(3) + "<package/>\n"},
            Report(
                "package.xml:2:2",
                "no format: that is format 1, but the schema named is format 3",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "different, and a test runs ament_xmllint",
            {
                "package.xml": LINE.format(2)
                + '<package format="3"><test_depend>ament_cmake_xmllint</test_depend></package>\n',
                "CMakeLists.txt": "find_package(ament_lint_auto REQUIRED)\n"
                "ament_lint_auto_find_test_dependencies()\n",
            },
            Report(
                "package.xml:1:1",
                "names the schema of format 2, but <package> has 3",
                fix="Use the schema of format 3",
            ),
            fixed={
                "package.xml": LINE.format(3)
                + '<package format="3"><test_depend>ament_cmake_xmllint</test_depend></package>\n',
            },
        ),
        Example(
            "a format that does not exist",
            {"package.xml": LINE.format(3) + '<package format="4"/>\n'},
            Report("package.xml:2:18", 'format="4" does not exist: there are 1, 2 and 3'),
        ),
    ),
    "PX066": (
        Example(
            "a comment",
            {"package.xml": "<package>\n  <!-- more -->\n  <name>talker</name>\n</package>\n"},
        ),
        Example(
            "text",
            {
                "package.xml": "<package>\n  <name>talker</name>>\n  <export>\n"
                "    ament_python\n  </export>\n</package>\n"
            },
            Report("package.xml:2:22", "text between the elements: only comments are allowed"),
            Report("package.xml:4:5", "text between the elements: only comments are allowed"),
        ),
    ),
    "PX067": (
        Example("well-formed", {"package.xml": "<package><name>talker_2</name></package>\n"}),
        Example(
            "a capital and a dash",
            {"package.xml": "<package>\n  <name>Talker-two</name>\n</package>\n"},
            Report(
                "package.xml:2:9",
                "the name 'Talker-two' has - in it: only a to z, 0 to 9 and _ are allowed",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "a dash",
            {"package.xml": "<package><name>the-talker</name></package>\n"},
            Report(
                "package.xml:1:16",
                "the name 'the-talker' has - in it: only a to z, 0 to 9 and _ are allowed",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "a dash in the name of a package with messages",
            {"package.xml": "<package><name>the-msgs</name></package>\n", "msg/Beat.msg": ""},
            Report(
                "package.xml:1:16",
                "the name 'the-msgs' has - in it: only a to z, 0 to 9 and _ are allowed",
            ),
        ),
        Example(
            "two underscores",
            {"package.xml": "<package>\n  <name>talker__two</name>\n</package>\n"},
            Report(
                "package.xml:2:9",
                "the name 'talker__two' has an underscore at its end or two in a row",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "a space, which colcon refuses",
            {"package.xml": "<package>\n  <name>talker two</name>\n</package>\n"},
            Report(
                "package.xml:2:9",
                "the name 'talker two' has a space in it: only a to z, 0 to 9 and _ are allowed",
            ),
        ),
        Example(
            "a capital in a package whose tests run ament_xmllint",
            {
                "package.xml": "<package>\n  <name>Talker</name>\n"
                "  <test_depend>ament_xmllint</test_depend>\n</package>\n",
                "CMakeLists.txt": "project(Talker)\nif(BUILD_TESTING)\n"
                "  find_package(ament_cmake_xmllint REQUIRED)\n  ament_xmllint()\nendif()\n",
            },
            Report("package.xml:2:9", "the name 'Talker' has capitals in it: write 'talker'"),
        ),
        Example(
            "a capital in a package with services",
            {"package.xml": "<package><name>Beats</name></package>\n", "srv/Beat.srv": "---\n"},
            Report("package.xml:1:16", "the name 'Beats' has capitals in it: write 'beats'"),
        ),
    ),
    "PX068": (
        Example("well-formed", {"package.xml": "<package><version>0.1.0</version></package>\n"}),
        Example(
            "two numbers",
            {"package.xml": "<package>\n  <version>0.1</version>\n</package>\n"},
            Report("package.xml:2:12", "the version '0.1' is not MAJOR.MINOR.PATCH"),
        ),
        Example(
            "a suffix",
            {"package.xml": "<package>\n  <version>0.1.0-rc1</version>\n</package>\n"},
            Report("package.xml:2:12", "the version '0.1.0-rc1' is not MAJOR.MINOR.PATCH"),
        ),
        Example(
            "a leading zero",
            {"package.xml": "<package>\n  <version>0.01.0</version>\n</package>\n"},
            Report("package.xml:2:12", "the version '0.01.0' has a leading zero"),
        ),
    ),
    "PX069": (
        Example(
            "known",
            {"package.xml": '<package>\n  <url type="website">http://a.org</url>\n</package>\n'},
        ),
        Example(
            "unknown",
            {"package.xml": '<package>\n  <url type="homepage">http://a.org</url>\n</package>\n'},
            Report(
                "package.xml:2:14",
                "the url type 'homepage' is not known, only website, bugtracker, repository",
            ),
        ),
    ),
    "PX070": (
        Example(
            "well-formed",
            {"package.xml": '<package>\n  <depend version_gte="1.2">a</depend>\n</package>\n'},
        ),
        Example(
            "a wildcard",
            {
                "package.xml": '<package format="2">\n'
                '  <depend version_gte="1.x">a</depend>\n</package>\n'
            },
            Report("package.xml:2:24", 'version_gte="1.x" is not one to three numbers'),
        ),
    ),
    "PX071": (
        Example("format 3", {"package.xml": DEPEND.format(3, "$ROS_VERSION == 2")}),
        Example(
            "format 2",
            {"package.xml": DEPEND.format(2, "$ROS_VERSION == 2")},
            Report("package.xml:2:11", "conditions need format 3, but this manifest has format 2"),
        ),
        Example(
            "a character that no condition has",
            {"package.xml": DEPEND.format(3, "$ROS_VERSION == 2 | 1")},
            Report(
                "package.xml:2:22",
                "'$ROS_VERSION == 2 | 1': the schema does not allow all of these "
                "characters for dependencies",
            ),
        ),
        Example(
            "quotes in the condition of a group",
            {
                "package.xml": '<package format="3">\n'
                "  <member_of_group condition=\"$A == 'b'\">g</member_of_group>\n</package>\n"
            },
            Report(
                "package.xml:2:31",
                "\"$A == 'b'\": the schema does not allow all of these characters for groups",
            ),
        ),
    ),
    "PX072": (
        Example(
            "an author needs none",
            {
                "package.xml": "<package>\n"
                '  <maintainer email="a@b.org">A</maintainer>\n  <author>B</author>\n</package>\n'
            },
        ),
        Example(
            "a maintainer without",
            {"package.xml": "<package>\n  <maintainer>A</maintainer>\n</package>\n"},
            Report("package.xml:2:4", "the maintainer 'A' has no email"),
        ),
    ),
    "PX073": (
        Example(
            "well-formed",
            {"package.xml": '<package>\n  <author email="a.b@c-d.org">A</author>\n</package>\n'},
        ),
        Example(
            "spelt out",
            {"package.xml": '<package>\n  <author email="a at b.org">A</author>\n</package>\n'},
            Report("package.xml:2:18", "'a at b.org' is not an email address"),
        ),
        Example(
            "no domain",
            {"package.xml": '<package>\n  <maintainer email="a@b">A</maintainer>\n</package>\n'},
            Report("package.xml:2:22", "'a@b' is not an email address"),
        ),
    ),
    "PX074": (
        Example(
            "in a description",
            {"package.xml": "<package><description>A <b>talker</b>.</description></package>\n"},
        ),
        Example(
            "in a license",
            {
                "package.xml": "<package>\n  <license>\n"
                "    <url>http://a.org</url>\n  </license>\n</package>\n"
            },
            Report("package.xml:3:6", "<url> is inside <license>, which holds text only"),
        ),
    ),
    "PX075": (
        Example("a URL", {"package.xml": "<package><url>http://a.org:80/b#c</url></package>\n"}),
        Example(
            "no port",
            {"package.xml": "<package>\n  <url>http://a.org:port/b</url>\n</package>\n"},
            Report("package.xml:2:8", "'http://a.org:port/b' is not a URL"),
        ),
    ),
}
