"""Parity with ament_copyright, ament_lint_cmake and ament_xmllint: same files, same lines."""

from __future__ import annotations

import re
import subprocess
from collections.abc import Callable, Mapping
from functools import lru_cache
from hashlib import sha256
from pathlib import Path
from random import Random

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from lxml import etree

from scaffold.ament import copyright as notices
from scaffold.ament import lint_cmake
from scaffold.ament.xml.xmllint import check as check_xml
from scaffold.ament.xml.xmllint import violations
from scaffold.check import runner
from scaffold.check.fixes import fixer
from scaffold.check.rules import registry
from scaffold.check.rules.rule import Rule
from scaffold.check.session import all_rules
from scaffold.configuration import content
from scaffold.diagnostic import Severity
from scaffold.model.manifest.structure import collapse
from scaffold.model.manifest.values import is_uri
from scaffold.model.package import Package
from tests import oracles
from tests.oracles import needs_system_linter

RULES = {rule.code: rule() for rule in all_rules(registry.load(content.roots("rules")))}
STRUCTURE = [rule for code, rule in RULES.items() if "PX060" <= code <= "PX079"]
COPYRIGHT = [RULES[code] for code in ("LY020", "LY021", "LY022")]
LAYOUT_OF_CMAKE = [rule for code, rule in RULES.items() if "CM070" <= code <= "CM085"]

SCHEMAS = Path("/usr/share/ament_xmllint/xml-catalog/download.ros.org/schema")
needs_schemas = pytest.mark.skipif(
    not SCHEMAS.is_dir(), reason="the official schemas of package.xml are not installed"
)


def write(directory: Path, files: Mapping[str, str | bytes]) -> Package:
    """Write files and return the package of them."""
    for path, text in files.items():
        target = directory / path
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_bytes(text.encode() if isinstance(text, str) else text)
    return Package.at(directory)


# -- ament_lint_cmake

WHOLE_FILE = {"convention/filename", "package/consistency"}
CMAKE = """\
cmake_minimum_required(VERSION 3.8)
project(talker)

# Everything that a node needs.
find_package(ament_cmake REQUIRED)
find_package(rclcpp REQUIRED)
if(BUILD_TESTING)
  find_package(ament_lint_auto REQUIRED)
  message(
    "one"
  )
else()
  set(LIST
    a b
    c)
endif()
foreach(name IN ITEMS a b)
  add_executable(${name} ${name}.cpp)
endforeach()
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(FOO DEFAULT_MSG FOO_LIBRARY)
install(TARGETS a b DESTINATION lib/${PROJECT_NAME})
ament_package()
"""
LONG = "x" * 150
CMAKE_PIECES = (
    *(" ", "  ", "\t", "(", ")", "( ", " )", "#", '"', "\n", "\r\n", "else", "endif", "endfoo("),
    *("endif(A B)", "endif( x)", "ELSE ()", "Set(", "set( a )", "[[", "]]", "\\", "\xa0", "\x0c"),
    *(f'message("{LONG}")', f'message(\n "{LONG}"', f'\n"{LONG}"\n', f'set(A\n  "{LONG}")'),
    *(" # lint_cmake: -linelength", "\n# lint_cmake: -whitespace,+whitespace/tabs\n"),
    *("\n# lint_cmake: -\n", "include(FindPackageHandleStandardArgs)", "if(A)\n   set(B 1)"),
)
CMAKE_NAMES = (
    *("CMakeLists.txt", "cmake/CMakeLists.txt", "cmake/cmakelists.txt", "FindFOO.cmake"),
    *("FindBar.cmake", "FindBar.cmake.in", "Finder.cmake", "a.CMAKE", "b.cmake.in", "c.txt"),
    *("_hidden/d.cmake", ".hidden/e.cmake", "ignored/f.cmake", "ignored/below/g.cmake"),
)


@needs_system_linter("ament_lint_cmake")
@pytest.mark.parametrize("seed", range(5))
def test_cmake_findings_equal_those_of_the_linter(seed: int, tmp_path: Path) -> None:
    random = _random(seed)
    files = {name: _mutant(random, CMAKE, CMAKE_PIECES) for name in CMAKE_NAMES}
    files["ignored/AMENT_IGNORE"] = ""
    package = write(tmp_path, files)
    ours = {
        (finding.source.path, 0 if name in WHOLE_FILE else finding.location.line, name)
        for name in lint_cmake.FILTERS
        for finding in lint_cmake.findings(package, name)
    }
    assert ours == {tuple(finding) for finding in _as_tuples(oracles.ament_lint_cmake(tmp_path))}
    assert bool(ours) == bool(runner.check(package, LAYOUT_OF_CMAKE))


@needs_system_linter("ament_lint_cmake")
@pytest.mark.parametrize("pragma", ["foo", "-linelenght", "-linelength, ", "linelength", " "])
def test_pragma_that_crashes_the_linter_is_reported(pragma: str, tmp_path: Path) -> None:
    package = write(tmp_path, {"CMakeLists.txt": f"# lint_cmake: {pragma}\nproject(a)\n"})
    with pytest.raises(AssertionError, match="ament_lint_cmake failed"):
        oracles.ament_lint_cmake(tmp_path)
    assert "CM084" in {d.code for d in runner.check(package, LAYOUT_OF_CMAKE)}


def test_linter_accepts_fixed_cmake(tmp_path: Path) -> None:
    text = "PROJECT (a) \nif(TEST)\n\tset( B 1)\n\tfoo(\n  b\n      )\nendif(TEST)\n"
    package = write(tmp_path, {"CMakeLists.txt": text})
    fixed = fixer.fix(package, lambda one: runner.check(one, LAYOUT_OF_CMAKE))
    expected = "project(a)\nif(TEST)\n  set(B 1)\n  foo(\n  b\n  )\nendif()\n"
    assert fixed.changed["CMakeLists.txt"].decode() == expected


def _as_tuples(found: set[oracles.Finding]) -> list[tuple[str, int, str]]:
    return [(finding.path, finding.line, finding.code) for finding in found]


# -- ament_copyright

APACHE = """\
# Copyright 2020-2022, 2024 Example Robotics
#
# Licensed under the Apache License, Version 2.0 (the "License");
# you may not use this file except in compliance with the License.
# You may obtain a copy of the License at
#
#     http://www.apache.org/licenses/LICENSE-2.0
#
# Unless required by applicable law or agreed to in writing, software
# distributed under the License is distributed on an "AS IS" BASIS,
# WITHOUT WARRANTIES OR CONDITIONS OF ANY KIND, either express or implied.
# See the License for the specific language governing permissions and
# limitations under the License.
"""
GOOGLE = """ Use of this source code is governed by a BSD-style
 license that can be found in the LICENSE file or at
 https://developers.google.com/open-source/licenses/bsd"""
HEADERS = (
    APACHE,
    APACHE.replace("\n", "\r\n"),
    APACHE.replace("# ", "// ").replace("#\n", "//\n"),
    f"#!/usr/bin/env python3\n# -*- coding: utf-8 -*-\n\n{APACHE}",
    "/*\n * Copyright (c) 2019 A\n *\n *" + GOOGLE.replace("\n", "\n *") + "\n */\n",
    "# Copyright 2020 A\n# Copyright 2021 B\n#" + GOOGLE.replace("\n", "\n#") + "\n",
    "# SPDX-License-Identifier: MIT\n# Copyright 2020 A\n",
    "import rclpy\n\n# Copyright 2020 late\n",
    "\ufeff" + APACHE,
)
COPYRIGHT_PIECES = (
    *(
        "#",
        "\n",
        "#\n",
        "//",
        "///",
        "/*",
        "*/",
        "<!--",
        "-->",
        " ",
        "#!",
        "coding: x",
        "2020",
        "-",
    ),
    *("# Copyright 2020 Foo\n", "Copyright (c) 2019-2020, 2022 Bar\n", "COPYRIGHT 2020, X", "(c) "),
    *("\\copyright Copyright 2020 A\n", " * Copyright 2020 B\n", "\r\n", "\r", "\x0c", "\u2028"),
    *("All rights reserved.", "\t", "\\copyright\n", "x", "copyright ", "2019\n", "\xa0"),
)


@needs_system_linter("ament_copyright")
@pytest.mark.parametrize("seed", range(5))
def test_rejected_headers_equal_those_of_the_linter(seed: int, tmp_path: Path) -> None:
    random = _random(seed)
    endings = sorted(notices.EXTENSIONS)
    files = {
        f"{random.choice(('a', 'a/b', '_c', 'd'))}/f{number}{random.choice(endings)}": _mutant(
            random, random.choice(HEADERS), COPYRIGHT_PIECES
        )
        for number in range(60)
    }
    files |= {"d/AMENT_IGNORE": "", "a/empty.py": "", "setup.py": "", "package.xml": "<package/>"}
    files |= {f"g{number}.py": header for number, header in enumerate(HEADERS)}
    package = write(tmp_path, files)
    rejected = {header.path for header in notices.headers(package) if not header.is_known}
    assert rejected == {finding.path for finding in oracles.ament_copyright(tmp_path)}
    assert runner.check(package, COPYRIGHT)


@needs_system_linter("ament_copyright")
@pytest.mark.parametrize("data", [b"# \xe9t\xe9\n", b"#!/usr/bin/env python3\n", b"\xef\xbb\xbf"])
def test_file_that_crashes_the_linter_is_reported(data: bytes, tmp_path: Path) -> None:
    package = write(tmp_path, {"a.py": data})
    with pytest.raises(AssertionError, match="ament_copyright failed"):
        oracles.ament_copyright(tmp_path)
    assert [d.location.path for d in runner.check(package, COPYRIGHT)] == ["a.py"]


@needs_system_linter("ament_copyright")
@pytest.mark.parametrize("licence", ["apache2", "bsd_3clause", "gplv3", "mit0"])
def test_headers_written_by_the_linter_are_accepted(licence: str, tmp_path: Path) -> None:
    write(tmp_path, {".git": "gitdir: elsewhere\n", "a.py": "import b\n", "c.hpp": "int d;\n"})
    command = ["ament_copyright", "--add-missing", "Example Robotics", licence]
    environment = oracles.system_environment()
    subprocess.run(command, cwd=tmp_path, env=environment, check=True, capture_output=True)
    assert (tmp_path / "LICENSE").exists()
    assert runner.check(Package.at(tmp_path), COPYRIGHT) == []


@needs_system_linter("ament_copyright")
def test_known_license_texts_equal_those_of_the_linter() -> None:
    """Compute scaffold/data/licences.tsv from the installed linter."""
    result = {
        (kind, known.license, known.sections)
        for kind, texts in notices.known_texts().items()
        for known in texts
    }
    assert result == _templates()


def _templates() -> set[tuple[str, str, tuple[str, ...]]]:
    names = {"header": "header", "LICENSE": "license", "CONTRIBUTING.md": "contributing"}
    identifiers = {
        "apache2": "Apache-2.0",
        "boost1": "BSL-1.0",
        "bsd2": "BSD-2.0",
        "bsd_3clause": "BSD-3-Clause",
        "bsd_2clause": "BSD-2-Clause",
        "mit": "MIT",
        "mit0": "MIT-0",
        "gplv3": "GPL-3.0-only",
        "lgplv3": "LGPL-3.0-only",
    }
    (directory,) = Path("/usr/lib").glob("python3*/dist-packages/ament_copyright/template")
    result: set[tuple[str, str, tuple[str, ...]]] = set()
    for kind, name in names.items():
        for prefix, identifier in identifiers.items():
            for path in sorted(directory.glob(f"{prefix}_{name}*.txt")):
                joined = " ".join(path.read_text().split())
                parts = re.split(r"\{copyright(?:_holder)?\}", joined)
                sections = [part.strip() for part in parts if part]
                if kind != "header":
                    sections = [f"{len(s)} {_digest(s)} {s[:24]}" for s in sections]
                result.add((kind, identifier, tuple(sections)))
    return result


def _digest(text: str) -> str:
    return sha256(text.encode()).hexdigest()[:16]


TEST_OF_COPYRIGHT = (
    f"{APACHE}\nfrom ament_copyright.main import main\n\n\n{{}}def test_it():\n    {{}}\n"
)
MAIN = "assert main(argv=['.', 'test']) == 0"


@pytest.mark.parametrize(
    ("test", "severities"),
    [
        (("", MAIN), [Severity.ERROR, Severity.ERROR]),
        (("import pytest\n@pytest.mark.skip(reason='later')\n", MAIN), [Severity.INFO]),
        (
            ("", "assert main(argv=['.', '--exclude', 'a.py', './lib/*.py']) == 0"),
            [Severity.INFO],
        ),
        (
            ("", "assert main(argv=['.', '--exclude', 'lib/*.py']) == 0"),
            [Severity.ERROR, Severity.INFO],
        ),
    ],
)
def test_severity_of_copyright_follows_the_tests_of_a_python_package(
    test: tuple[str, str], severities: list[Severity]
) -> None:
    files = {"a.py": "import b\n", "lib/c.py": "import d\n"}
    files["test/test_copyright.py"] = TEST_OF_COPYRIGHT.format(*test)
    diagnostics = runner.check(Package.of(files), COPYRIGHT)
    assert [d.severity for d in diagnostics] == severities


@pytest.mark.parametrize(
    ("lines", "depend", "severity"),
    [
        ("", "ament_lint_common", Severity.ERROR),
        ("", "ament_cmake_copyright", Severity.ERROR),
        ("", "ament_cmake_flake8", Severity.INFO),
        ("set(ament_cmake_copyright_FOUND TRUE)", "ament_lint_common", Severity.INFO),
        ("# set(ament_cmake_copyright_FOUND TRUE)", "ament_lint_common", Severity.ERROR),
        (
            "list(APPEND AMENT_LINT_AUTO_EXCLUDE ament_cmake_copyright)",
            "ament_lint_common",
            Severity.INFO,
        ),
        ("set(AMENT_LINT_AUTO_FILE_EXCLUDE a.py)", "ament_lint_common", Severity.INFO),
        ("set(AMENT_LINT_AUTO_FILE_EXCLUDE b.py)", "ament_lint_common", Severity.ERROR),
        ("ament_copyright()", "ament_cmake_copyright", Severity.ERROR),
        ("ament_copyright(src)", "ament_cmake_copyright", Severity.INFO),
        ("ament_copyright(src a.py TESTNAME x)", "ament_cmake_copyright", Severity.ERROR),
        ("ament_copyright(TESTNAME x src)", "ament_cmake_copyright", Severity.INFO),
        ("ament_copyright(${PLACES})", "ament_cmake_copyright", Severity.INFO),
        ("ament_copyright(EXCLUDE a.py)", "ament_cmake_copyright", Severity.INFO),
    ],
)
def test_severity_of_copyright_follows_the_tests_of_a_cmake_package(
    lines: str, depend: str, severity: Severity
) -> None:
    files = {
        "a.py": "import b\n",
        "package.xml": f"<package format='3'><test_depend>{depend}</test_depend></package>",
        "CMakeLists.txt": f"project(a)\n{lines}\nament_lint_auto_find_test_dependencies()\n",
    }
    assert [d.severity for d in runner.check(Package.of(files), COPYRIGHT)] == [severity]


@pytest.mark.parametrize(
    ("lines", "severity"),
    [
        ("", Severity.INFO),
        ("find_package(ament_lint_common REQUIRED)", Severity.ERROR),
        ("ament_auto_find_build_dependencies()", Severity.ERROR),
    ],
)
def test_ament_lint_auto_finds_only_test_dependencies(lines: str, severity: Severity) -> None:
    files = {
        "a.py": "import b\n",
        "package.xml": "<package format='3'><depend>ament_lint_common</depend></package>",
        "CMakeLists.txt": f"project(a)\n{lines}\nament_lint_auto_find_test_dependencies()\n",
    }
    assert [d.severity for d in runner.check(Package.of(files), COPYRIGHT)] == [severity]


def test_unknown_dependencies_may_add_licenses() -> None:
    manifest = "<package format='3'><test_depend>ament_cmake_copyright</test_depend>{}</package>"
    files = {
        "a.py": "# Copyright 2026 Ann.\n# All rights reserved. Nobody may copy this file.\n",
        "CMakeLists.txt": "project(a)\nament_lint_auto_find_test_dependencies()\n",
    }
    result = [
        [d.code for d in runner.check(Package.of({**files, "package.xml": text}), COPYRIGHT)]
        for text in (
            manifest.format(""),
            manifest.format("<test_depend>robots_ament_copyright</test_depend>"),
        )
    ]
    assert result == [["LY021"], []]


# -- ament_xmllint: well-formedness

XML = """\
<?xml version="1.0"?>
<launch a="b">
  <!-- comment -->
  <node pkg="talker" exec='x'/>
  <text>&amp; &#65; <![CDATA[ <raw> ]]></text>
</launch>
"""
RUNS_XMLLINT = {
    "package.xml": "<package>\n  <name>talker</name>\n"
    "  <test_depend>ament_cmake_xmllint</test_depend>\n</package>\n",
    "CMakeLists.txt": "project(talker)\nif(BUILD_TESTING)\n"
    "  find_package(ament_cmake_xmllint REQUIRED)\n  ament_xmllint()\nendif()\n",
}
"""A package whose tests run the linter."""
XML_PIECES = (
    *("<", ">", "&", "/", "'", '"', "<a>", "</a>", "<a/>", "&x;", "&#0;", "&lt;", "--", "]]>", " "),
    *("<?pi x?>", "<?xml version='1.0'?>", "\n", "x:y", "\x01", "\ufffe", "é", "\ufeff", "=", "b"),
)


@needs_system_linter("ament_xmllint")
@pytest.mark.parametrize("seed", range(3))
def test_unreadable_xml_files_equal_those_of_the_linter(seed: int, tmp_path: Path) -> None:
    random = _random(seed)
    files: dict[str, str | bytes] = {
        f"f{number}.xml": _mutant(random, XML, XML_PIECES) for number in range(40)
    }
    files |= {"empty.xml": "", "deep.xml": "<a>" * 258 + "</a>" * 258, "v2.xml": XML_V2}
    files |= {"utf16.xml": "<a>é</a>".encode("utf-16")}
    files |= {"_x/not.xml": "<", "a/b.launch": "<", "a/c.urdf": "<", "a/.xml": "<"}
    files |= RUNS_XMLLINT
    package = write(tmp_path, files)
    ours = {d.location.path for d in runner.check(package, [RULES["PX050"]])}
    assert ours == oracles.files_rejected_by_xmllint(tmp_path)


@needs_system_linter("ament_xmllint")
@pytest.mark.parametrize("data", [b"<a>\xe9</a>", b'<?xml version="1.0" encoding="gb2312"?><a/>'])
def test_xml_file_that_crashes_the_linter_is_reported(data: bytes, tmp_path: Path) -> None:
    package = write(tmp_path, {"a.xml": data})
    with pytest.raises(AssertionError, match="ament_xmllint failed"):
        oracles.ament_xmllint(tmp_path)
    assert [d.location.path for d in runner.check(package, [RULES["PX050"]])] == ["a.xml"]


XML_V2 = '<?xml version="2.0"?><a/>'


@settings(max_examples=300, deadline=None)
@given(st.binary(max_size=200))
def test_xml_check_never_raises(data: bytes) -> None:
    result = check_xml("a.xml", data)
    assert result is None or result[0].path == "a.xml"


@needs_system_linter("ament_copyright")
@needs_system_linter("ament_xmllint")
def test_dangling_symlinks_are_reported(tmp_path: Path) -> None:
    package = write(tmp_path, {"package.xml": MANIFESTS[2]})
    (tmp_path / "a.py").symlink_to("gone.py")
    (tmp_path / "b.xml").symlink_to("gone.xml")
    assert {finding.path for finding in oracles.ament_copyright(tmp_path)} == {"a.py"}
    with pytest.raises(AssertionError, match="ament_xmllint failed"):
        oracles.files_rejected_by_xmllint(tmp_path)
    diagnostics = runner.check(package, [*COPYRIGHT, RULES["PX050"]])
    assert [d.location.path for d in diagnostics] == ["a.py", "b.xml"]


# -- ament_xmllint: package.xml

HEAD = """\
<?xml version="1.0"?>
<?xml-model
   href="http://download.ros.org/schema/package_format{0}.xsd"
   schematypens="http://www.w3.org/2001/XMLSchema"?>
<package format="{0}">
"""
BODY = """\
  <name>talker</name>
  <version>1.0.0</version>
  <description>Talks and <b>talks</b>.</description>
  <maintainer email="a@b.org">A</maintainer>
  <license>Apache-2.0</license>
  <url type="website">http://a.org/b</url>
  <author email="c.d@e.org">C</author>
  <author>D</author>
  <buildtool_depend>ament_cmake</buildtool_depend>
  <build_depend version_gte="1.2">rclcpp</build_depend>
  <test_depend>ament_lint_auto</test_depend>
  <conflict>x</conflict>
"""
TAILS = {
    1: "  <run_depend>rclcpp</run_depend>\n",
    2: "  <exec_depend>rclcpp</exec_depend>\n  <depend>a</depend>\n",
    3: '  <depend condition="$A == 2">a</depend>\n'
    "  <group_depend>g</group_depend>\n  <member_of_group>h</member_of_group>\n",
}
END = "  <export>\n    <build_type>ament_cmake</build_type>\n  </export>\n</package>\n"
MANIFESTS = [HEAD.format(number) + BODY + tail + END for number, tail in TAILS.items()]
TAGS = (
    *("name", "version", "description", "maintainer", "license", "url", "author", "build_depend"),
    *("buildtool_depend", "run_depend", "test_depend", "conflict", "exec_depend", "depend"),
    *("doc_depend", "group_depend", "member_of_group", "export", "build_type", "licence", "foo"),
)
ATTRIBUTES = (
    *('email="a@b.org"', 'email="a@b"', 'email=""', 'type=" bugtracker "', 'type="home"'),
    *('version_gte="1.2"', 'version_lt="1.x"', 'version_eq="1.2.3.4"', 'version_gt=" 1 "'),
    *('condition="$A == 2"', "condition=\"$A == 'b'\"", 'condition="a | b"', 'condition=""'),
    *('file="x"', 'compatibility="1.0"', 'format="3"', 'xml:lang="en"', 'xmlns="u"'),
    *('xmlns:a="u"', 'xmlns=""', 'condition="a&#10;b"'),
)
VALUES = (
    *("", "x", "1.2.3", "01.2.3", "1.2", "1x2x3", "1.2.3.4", " 1.2.3 ", "a_b", "a__b", "_a", "a_"),
    *("A", "a-b", "9a", "http://a.b", "http://a:b/", "a b", "&#160;", "&#10;", "<![CDATA[x]]>"),
    *("<b/>", "<b>x</b>", "<!-- c -->", "é", "a&#xa0;", "a<!-- c -->b", "<?pi x?>", "http://[::1"),
)
ROOTS = (
    "<package>",
    '<package format="1">',
    '<package format="4">',
    "<pkg>",
    '<package format=" 3">',
)
ELEMENT = r"[ \t]*<(\w+)([^<>/]*)(?:/>|>([^<]*)</\1>)[ \t]*\n?"


@needs_schemas
@pytest.mark.parametrize("seed", range(20))
def test_manifest_findings_agree_with_the_schemas(seed: int) -> None:
    random = _random(seed)
    for _ in range(150):
        text = _mutant_of_manifest(random, random.choice(MANIFESTS))
        official = _official_verdict(text)
        if official is None:
            continue
        package = Package.of({"package.xml": text})
        diagnostics = runner.check(package, STRUCTURE)
        assert (not diagnostics) == official, f"{[d.message for d in diagnostics]}\n{text}"
        assert (not violations(text.encode(), _format_number(text))) == official, text


@pytest.mark.parametrize("text", MANIFESTS, ids=["format 1", "format 2", "format 3"])
def test_valid_manifests_are_accepted(text: str) -> None:
    assert runner.check(Package.of({"package.xml": text}), STRUCTURE) == []
    assert violations(text.encode(), _format_number(text)) == []


@settings(max_examples=400, deadline=None)
@given(st.text("ab1:/?#[]@!%4éhtp. <|", max_size=25))
def test_urls_are_validated_like_any_uri_of_schemas(url: str) -> None:
    assert is_uri(collapse(url)) == _uri_schema().validate(_element("u", url))


@lru_cache
def _uri_schema() -> etree.XMLSchema:
    return etree.XMLSchema(
        etree.fromstring(
            '<s:schema xmlns:s="http://www.w3.org/2001/XMLSchema">'
            '<s:element name="u" type="s:anyURI"/></s:schema>'
        )
    )


def _element(tag: str, text: str) -> etree._Element:
    element = etree.Element(tag)
    element.text = text
    return element


def _format_number(text: str) -> int:
    """Return the package format whose schema the linter would use."""
    result = re.search(r"package_format([123])\.xsd", text) or re.search(r'format="([123])"', text)
    return int(result[1]) if result else 1


def _official_verdict(text: str) -> bool | None:
    """Return whether the official schema accepts a file; ``None`` if it is not well-formed."""
    parser = etree.XMLParser(resolve_entities=False, no_network=True)
    try:
        document = etree.fromstring(text.encode(), parser).getroottree()
    except etree.XMLSyntaxError:
        return None
    return bool(_official_schema(_format_number(text)).validate(document))


@lru_cache
def _official_schema(number: int) -> etree.XMLSchema:
    text = (SCHEMAS / f"package_format{number}.xsd").read_text()
    # Their pattern of a version lets any character stand for a dot; catkin_pkg does not.
    return etree.XMLSchema(etree.fromstring(text.replace("(.(0|", r"(\.(0|").encode()))


def _mutant_of_manifest(random: Random, text: str) -> str:
    for _ in range(random.randint(1, 3)):
        elements = list(re.finditer(ELEMENT, text))
        if not elements:
            return text
        text = random.choice(MUTATIONS)(random, text, random.choice(elements))
    return text


def _remove(_random: Random, text: str, element: re.Match[str]) -> str:
    return text[: element.start()] + text[element.end() :]


def _repeat(_random: Random, text: str, element: re.Match[str]) -> str:
    return text[: element.end()] + element[0] + text[element.end() :]


def _move(random: Random, text: str, element: re.Match[str]) -> str:
    rest = text[: element.start()] + text[element.end() :]
    others = list(re.finditer(ELEMENT, rest))
    at = random.choice(others).start() if others else 0
    return rest[:at] + element[0] + rest[at:] if others else text


def _retag(random: Random, text: str, element: re.Match[str]) -> str:
    tag = random.choice(TAGS)
    new = re.sub(rf"(</?){element[1]}\b", rf"\g<1>{tag}", element[0])
    return text[: element.start()] + new + text[element.end() :]


def _add_attribute(random: Random, text: str, element: re.Match[str]) -> str:
    at = element.start(2)
    return f"{text[:at]} {random.choice(ATTRIBUTES)}{text[at:]}"


def _change_value(random: Random, text: str, element: re.Match[str]) -> str:
    if element[3] is None:
        return text
    return text[: element.start(3)] + random.choice(VALUES) + text[element.end(3) :]


def _add_text(random: Random, text: str, element: re.Match[str]) -> str:
    at = random.choice(element.span())
    return text[:at] + random.choice((*VALUES, "<export>x</export>", '<export a="b"/>')) + text[at:]


def _change_root(random: Random, text: str, _element: re.Match[str]) -> str:
    return re.sub("<package[^>]*>", random.choice(ROOTS), text, count=1)


def _change_schema(random: Random, text: str, _element: re.Match[str]) -> str:
    return re.sub(r"package_format\d", f"package_format{random.choice('123')}", text, count=1)


Mutation = Callable[[Random, str, "re.Match[str]"], str]
MUTATIONS: tuple[Mutation, ...] = (
    *(_remove, _repeat, _move, _move, _retag, _add_attribute, _change_value, _change_value),
    *(_add_text, _change_root, _change_schema),
)


@needs_system_linter("ament_xmllint")
def test_manifest_findings_agree_with_the_linter(tmp_path: Path) -> None:
    random = _random(7)
    texts = [*MANIFESTS, *(_mutant_of_manifest(random, MANIFESTS[2]) for _ in range(60))]
    rules: list[Rule] = [*STRUCTURE]
    wrong: set[str] = set()
    for number, text in enumerate(texts):
        directory = tmp_path / f"p{number}"
        package = write(directory, {"package.xml": text})
        if runner.check(package, rules):
            wrong.add(f"p{number}/package.xml")
    theirs = oracles.files_rejected_by_xmllint(tmp_path)
    # Where the pattern of their version lets any character pass we are stricter on purpose.
    assert {
        p for p in wrong - theirs if not re.search(r"1x2x3", (tmp_path / p).read_text())
    } == set()
    assert theirs - wrong == set()


def _random(seed: int) -> Random:
    return Random(seed)  # noqa: S311  the same files every time


def _mutant(random: Random, text: str, pieces: tuple[str, ...]) -> str:
    """Return a text with a few insertions and deletions."""
    for _ in range(random.randint(0, 4)):
        at = random.randint(0, min(len(text), 800))
        if random.random() < 0.75:
            text = text[:at] + random.choice(pieces) + text[at:]
        else:
            text = text[:at] + text[at + random.randint(1, 8) :]
    return text
