"""The command line: exit codes, reports, fixes."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from scaffold.cli.main import main
from scaffold.cli.verbs import VERBS

MANIFEST = """\
<?xml version="1.0"?>
<?xml-model href="http://download.ros.org/schema/package_format3.xsd" schematypens="http://www.w3.org/2001/XMLSchema"?>
<package format="3">
  <name>talker</name>
  <version>0.1.0</version>
  <description>{description}</description>
  <maintainer email="ada@example.com">Ada Lovelace</maintainer>
  <license>Apache-2.0</license>

  <buildtool_depend>ament_cmake</buildtool_depend>

  <export>
    <build_type>ament_cmake</build_type>
  </export>
</package>
"""
CMAKE_LISTS = """\
cmake_minimum_required(VERSION 3.8)
project({project})
find_package(ament_cmake REQUIRED)
ament_package()
"""


@pytest.fixture
def package(own_cache: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Return a clean package below the current directory, for a user without configuration."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path / "config"))
    monkeypatch.setenv("XDG_CACHE_HOME", str(own_cache))
    root = tmp_path / "talker"
    root.mkdir()
    (root / "package.xml").write_text(MANIFEST.format(description="Talks."))
    (root / "CMakeLists.txt").write_text(CMAKE_LISTS.format(project="talker"))
    (root / "LICENSE").touch()
    return root


@pytest.fixture
def flawed(package: Path) -> Path:
    """Return the package with one fixable finding and one that is not fixable."""
    (package / "package.xml").write_text(MANIFEST.format(description="TODO: Package description"))
    (package / "CMakeLists.txt").write_text(CMAKE_LISTS.format(project="listener"))
    return package


@pytest.mark.usefixtures("package")
def test_clean_package_has_no_findings(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["check", "talker"]) == 0
    assert capsys.readouterr().out == "1 package, 3 files for Jazzy: no findings\n"


@pytest.mark.usefixtures("flawed")
def test_findings_are_reported_with_exit_code_1(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["check"]) == 1
    assert capsys.readouterr().out.splitlines() == [
        (
            "talker/CMakeLists.txt:2:9: error CM001 project name 'listener' differs from package "
            "name 'talker' (package.xml, line 4): CMake stops [project-name-differs]"
        ),
        (
            "talker/package.xml:6:3: warning PX001 <description> is a placeholder, "
            "'TODO: Package description' [manifest-placeholder]"
        ),
        "1 package, 3 files for Jazzy: 1 error, 1 warning; 1 fixable with --fix",
    ]


def test_json_report(flawed: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["check", "--format", "json", str(flawed)]) == 1
    report = json.loads(capsys.readouterr().out)
    assert report["diagnostics"][0] == {
        "code": "CM001",
        "name": "project-name-differs",
        "severity": "error",
        "path": "talker/CMakeLists.txt",
        "line": 2,
        "column": 9,
        "end_line": 2,
        "end_column": 17,
        "message": "project name 'listener' differs from package name 'talker' "
        "(package.xml, line 4): CMake stops",
        "fixable": True,
        "cause": None,
        "distributions": ["jazzy"],
        "url": None,
        "fix": {
            "title": "Rename the project to talker",
            "safety": "safe",
            "edits": [
                {
                    "path": "talker/CMakeLists.txt",
                    "line": 2,
                    "column": 9,
                    "end_line": 2,
                    "end_column": 17,
                    "text": "talker",
                }
            ],
            "creates": [],
            "makes_executable": [],
            "removes": [],
        },
    }
    assert report["summary"] == {
        "packages": 1,
        "files": 3,
        "errors": 1,
        "warnings": 1,
        "infos": 0,
        "distributions": ["jazzy"],
    }


@pytest.mark.usefixtures("flawed")
def test_select_and_ignore(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["check", "--select", "CM"]) == 1
    assert "PX001" not in capsys.readouterr().out
    assert main(["check", "--ignore", "CM001,PX"]) == 0


@pytest.mark.usefixtures("flawed")
def test_check_of_one_file_reports_only_its_findings(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["check", "talker/package.xml"]) == 1
    assert "CM001" not in capsys.readouterr().out


def test_check_of_file_outside_of_any_package(
    package: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    loose = package.parent / "node.py"
    loose.write_text("import os\n")
    assert main(["check", "node.py"]) == 1
    assert "node.py:1:1: warning F401" in capsys.readouterr().out


@pytest.mark.usefixtures("package")
@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["check", "nowhere"], "nowhere: no such file or directory"),
        (["check", "--select", "CN001"], "--select: no rule has the code 'CN001'"),
        (
            ["check", "--select", "project-name"],
            "--select: no rule has the name 'project-name'; did",
        ),
        (["rules", "CN001"], "no rule has the code 'CN001'; did you mean"),
        (
            ["check", "--select", "PX02O"],
            "--select: no rule has the code 'PX02O'; did you mean PX020?",
        ),
        (
            ["check", "--ignore", "f4oi"],
            "--ignore: no rule has the code 'f4oi'; did you mean F401?",
        ),
        (["rules", "--content", "nowhere"], "nowhere: no such directory, but --content or"),
    ],
)
def test_user_errors_are_one_line_with_exit_code_2(
    capsys: pytest.CaptureFixture[str], arguments: list[str], message: str
) -> None:
    assert main(arguments) == 2
    error = capsys.readouterr().err
    assert error.startswith(f"ros2-scaffold: error: {message}")
    assert error.count("\n") == 1


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["chekc"], "argument VERB: invalid choice: 'chekc'; did you mean 'check'?"),
        (["completion", "fihs"], "argument shell: invalid choice: 'fihs'; did you mean 'fish'?"),
        (
            ["check", "--formt", "json"],
            "unrecognized arguments: --formt; did you mean '--format'?",
        ),
        (["check", "--selct=PX"], "unrecognized arguments: --selct=PX; did you mean '--select'?"),
        (["add"], "the following arguments are required: KIND"),
    ],
)
def test_invalid_arguments_get_one_line_with_suggestion(
    capsys: pytest.CaptureFixture[str], arguments: list[str], message: str
) -> None:
    with pytest.raises(SystemExit) as exit_:
        main(arguments)
    assert exit_.value.code == 2
    error = capsys.readouterr().err
    assert error.startswith(f"ros2-scaffold: error: {message}")
    assert error.endswith("--help`\n")
    assert error.count("\n") == 1


def test_help_is_shown_without_a_verb(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit, match="0"):
        main([])
    shown = capsys.readouterr()
    assert [verb for verb in VERBS if f"\n    {verb}" not in shown.out] == []
    assert shown.err == ""


@pytest.mark.parametrize("paths", [[], ["."], ["../talker/talker"]])
def test_directory_within_a_package_stands_for_the_package(
    paths: list[str],
    flawed: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    inner = flawed / "talker"
    inner.mkdir()
    monkeypatch.chdir(inner if not paths or paths == ["."] else flawed)
    assert main(["check", *paths]) == 1
    assert "CMakeLists.txt:2:9: error CM001" in capsys.readouterr().out


@pytest.mark.usefixtures("flawed")
@pytest.mark.parametrize(
    ("words", "codes"),
    [
        (["--select", "project-name-differs"], {"CM001"}),
        (["--select", "Project-Name-Differs,px001"], {"CM001", "PX001"}),
        (["--select", "ALL", "--ignore", "manifest-placeholder"], {"CM001"}),
        (["--ignore", "ALL"], set()),
        (["--ignore", "ALL", "--select", "PX"], {"PX001"}),
        (["--select", "cmake"], {"CM001"}),
        (["--ignore", "cmake,CM"], {"PX001"}),
    ],
)
def test_rules_are_selected_by_name_area_and_all(
    words: list[str], codes: set[str], capsys: pytest.CaptureFixture[str]
) -> None:
    main(["check", "--format", "json", *words])
    findings = json.loads(capsys.readouterr().out)["diagnostics"]
    assert {finding["code"] for finding in findings} == codes


def test_rules_verb_accepts_code_prefixes(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["rules", "CM00"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert len(lines) > 2
    assert all(line.startswith("CM00") for line in lines)
    assert main(["rules", "E50"]) == 0
    assert capsys.readouterr().out.startswith("E501 ")
    assert main(["rules", "--format", "json", "CM00"]) == 0
    listed = json.loads(capsys.readouterr().out)
    assert [finding["code"] for finding in listed] == [line.split()[0] for line in lines]
    assert main(["rules", "bridge"]) == 0
    assert all(line.startswith("BR") for line in capsys.readouterr().out.splitlines())


@pytest.mark.usefixtures("package")
def test_content_directory_without_rules_or_templates_is_rejected(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "own" / "rules" / "area").mkdir(parents=True)
    assert main(["check", "--content", "own/rules", "talker"]) == 2
    error = "own/rules: has no directory 'rules' or 'templates'; use the parent directory\n"
    assert capsys.readouterr().err == f"ros2-scaffold: error: {error}"
    assert main(["check", "--content", "own", "talker"]) == 0
    (tmp_path / "own" / "rules" / "lost.py").touch()
    assert main(["check", "--content", "own", "talker"]) == 2
    assert "own/rules/lost.py: a rule is in a directory of rules/" in capsys.readouterr().err


def test_configuration_is_searched_from_the_checked_path(
    flawed: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (flawed.parent / "ros2-scaffold.toml").write_text('[check]\nselect = ["LY"]\n')
    elsewhere = tmp_path / "elsewhere"
    elsewhere.mkdir()
    (elsewhere / "ros2-scaffold.toml").write_text('[check]\nselect = ["CM"]\n')
    monkeypatch.chdir(elsewhere)
    assert main(["check", str(flawed)]) == 0
    assert main(["check", str(flawed / "CMakeLists.txt")]) == 0
    (flawed / "ros2-scaffold.toml").write_text('[check]\nselect = ["CM"]\n')
    assert main(["check", str(flawed)]) == 1


def test_configuration_file_of_the_project(
    flawed: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (flawed.parent / "ros2-scaffold.toml").write_text('[check]\nignore = ["PX"]\n')
    assert main(["check"]) == 1
    assert "PX001" not in capsys.readouterr().out
    assert main(["check", "--ignore", "CM"]) == 1
    assert "PX001" in capsys.readouterr().out


def test_documented_configuration_is_valid(
    flawed: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    page = Path(__file__).parents[2] / "docs" / "configuration.md"
    text = page.read_text().partition("```toml\n")[2].partition("```")[0]
    (flawed.parent / "ros2-scaffold.toml").write_text(text)
    assert main(["check"]) == 1
    assert "you do not trust this directory" in capsys.readouterr().err


def test_per_path_ignores(flawed: Path) -> None:
    (flawed.parent / "ros2-scaffold.toml").write_text(
        '[check.per-path-ignores]\n"package.xml" = ["PX"]\n"CMake*" = ["CM"]\n'
    )
    assert main(["check"]) == 0


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("[check]\nselekt = []\n", "[check] has no key 'selekt'; did you mean 'select'?"),
        ("[checks]\nselect = []\n", "unknown table [checks]; did you mean 'check'?"),
        ("[tool.ros2-scaffold]\n", "unknown table [tool]: write [check] instead of [tool.ros2-"),
        ("[lint]\nselect = []\n", "unknown table [lint]; choose from check, new"),
        ("select = []\n", "'select' must be in the table [check]"),
        ("[check]\nselect = ['XX']\n", "toml: check.select: no rule has the name 'XX'"),
        (
            "[check.per-path-ignores]\n'a.py' = ['CM9999']\n",
            "check.per-path-ignores: 'a.py': no rule has the code 'CM9999'; did you mean",
        ),
        ("[check]\nselect = 'PX'\n", "check.select must be a list of strings"),
        ("[check\n", "invalid TOML"),
    ],
)
def test_broken_configuration(
    package: Path, capsys: pytest.CaptureFixture[str], text: str, message: str
) -> None:
    (package.parent / "ros2-scaffold.toml").write_text(text)
    assert main(["check"]) == 2
    assert message in capsys.readouterr().err


def test_noqa_on_the_import_accepts_an_undeclared_dependency(
    package: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (package / "talker").mkdir()
    (package / "talker" / "__init__.py").touch()
    node = package / "talker" / "node.py"
    node.write_text("import numpy  # noqa: PX020, F401\nimport rclpy  # noqa: F401\n")
    main(["check", "--select", "PX020,SC003", "talker"])
    (line,) = capsys.readouterr().out.splitlines()[:-1]
    assert line.startswith(
        "talker/talker/node.py:2:1: warning PX020 imports 'rclpy', which package.xml "
    )


def test_diff_writes_nothing(flawed: Path, capsys: pytest.CaptureFixture[str]) -> None:
    before = (flawed / "CMakeLists.txt").read_text()
    assert main(["check", "--diff"]) == 1
    assert "-project(listener)\n+project(talker)\n" in capsys.readouterr().out
    assert (flawed / "CMakeLists.txt").read_text() == before


def test_fix(flawed: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["check", "--fix"]) == 1
    assert (flawed / "CMakeLists.txt").read_text() == CMAKE_LISTS.format(project="talker")
    captured = capsys.readouterr()
    assert captured.err == "1 fix applied\n"
    assert "PX001" in captured.out
    assert "CM001" not in captured.out


def test_fix_style(package: Path) -> None:
    node = package / "test" / "test_node.py"
    node.parent.mkdir()
    node.write_text('"""A test."""\n\nimport sys\nimport os\n\nprint("a", os, sys)\n')
    main(["check", "--fix"])
    assert node.read_text() == '"""A test."""\n\nimport os\nimport sys\n\nprint(\'a\', os, sys)\n'


def test_crash_of_a_user_rule_is_reported(
    package: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    rule = package.parent / "mine" / "rules" / "cmake" / "crash.py"
    rule.parent.mkdir(parents=True)
    rule.write_text(
        "from scaffold.api import Rule\n\n\nclass Crash(Rule):\n"
        "    code = 'CM999'\n    name = 'crash'\n    examples = ()\n\n"
        "    def check(self, package):\n        raise ValueError('on purpose')\n"
    )
    assert main(["check", "--content", "mine", "talker"]) == 3
    assert "the rule CM999 crash failed: ValueError: on purpose" in capsys.readouterr().out


def test_rules_explained(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["rules", "cm001", "E501"]) == 0
    out = capsys.readouterr().out
    assert out.startswith("# CM001 project-name-differs\n")
    assert "\n# E501 " in out


def test_rules_listed(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["rules"]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert sum(line.startswith(("CM", "PX", "SP", "LY", "ND", "SC")) for line in lines) > 50


def test_version(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit, match="0"):
        main(["--version"])
    assert capsys.readouterr().out.startswith("ros2-scaffold 0.")


@pytest.mark.parametrize("verb", ["new", "add"])
def test_help_of_new_and_add_is_grouped(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, verb: str
) -> None:
    monkeypatch.setenv("COLUMNS", "80")
    with pytest.raises(SystemExit):
        main([verb, "--help"])
    lines = capsys.readouterr().out.splitlines()
    groups = [line.removesuffix(":") for line in lines if line.endswith(":") and line[0] != " "]
    wanted = ["the package", "nodes", "nodes: topics", "nodes: services and actions", "interfaces"]
    assert [group for group in groups if group in wanted] == wanted
    assert groups[-2:] == ["output", "templates"]
    assert len(lines[0]) < 80
    assert max(map(len, lines)) <= 80
