"""`add`: parts in existing packages, ours and those of others, judged from outside."""

from __future__ import annotations

import json
import os
import re
from collections.abc import Mapping
from pathlib import Path
from textwrap import dedent

import pytest

from scaffold.cli.main import main
from scaffold.configuration import content
from scaffold.generate import parts
from scaffold.generate.edit.addition import Addition
from scaffold.generate.edit.edit import Edited, edit
from scaffold.generate.templates import loading
from scaffold.generate.templates.template import Role
from scaffold.generate.update.provenance import NAME
from scaffold.model.package import Package
from scaffold.smoke import environment
from tests import oracles
from tests.generate.test_generated import Workspace, counts, needs_ros

TEMPLATES = loading.load(content.roots("templates"))
EXTRAS = [name for name, one in TEMPLATES.items() if one.role is Role.EXTRA]
PERSON = ("--maintainer-name", "Ada", "--maintainer-email", "ada@example.com")
CMAKE = {
    "package.xml": """\
        <package format="3">
          <name>demo</name>
          <version>1.0.0</version>
          <description>Says hello</description>
          <maintainer email="grace@example.com">Grace</maintainer>
          <license>BSD-3-Clause</license>
          <buildtool_depend>ament_cmake</buildtool_depend>
          <exec_depend>rclpy</exec_depend>
          <export>
            <build_type>ament_cmake</build_type>
          </export>
        </package>
        """,
    "CMakeLists.txt": """\
        cmake_minimum_required(VERSION 3.20)
        project(demo NONE)
        find_package(ament_cmake REQUIRED)

        install(PROGRAMS scripts/hello.py  # the first one
          DESTINATION lib/${PROJECT_NAME})

        ament_package()
        """,
    "scripts/hello.py": """\
        #!/usr/bin/env python3
        # Copyright 2020 The Hello Company. All rights reserved.
        print('hello')
        """,
}
PYTHON = {
    "package.xml": """\
        <package format="3">
          <name>demo</name>
          <version>1.0.0</version>
          <description>Says hello</description>
          <maintainer email="grace@example.com">Grace</maintainer>
          <license>Apache License 2.0</license>
          <exec_depend>rclpy</exec_depend>
          <export>
            <build_type>ament_python</build_type>
          </export>
        </package>
        """,
    "setup.py": """\
        from setuptools import setup

        setup(
            name='demo',
            version='1.0.0',
            packages=['demo'],
            data_files=[
                ('share/ament_index/resource_index/packages', ['resource/demo']),
                ('share/demo', ['package.xml']),
            ],
            extras_require={'test': ['pytest']},
            entry_points={'console_scripts': ['hello = demo.hello:main']},
        )
        """,
    "setup.cfg": """\
        [develop]
        script_dir=$base/lib/demo
        [install]
        install_scripts=$base/lib/demo
        """,
    "resource/demo": "",
    "demo/__init__.py": "",
    "demo/hello.py": "def main():\n    print('hello')\n",
}


def write(directory: Path, files: Mapping[str, str]) -> Path:
    for path, text in files.items():
        file = directory / path
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(dedent(text))
        if text.lstrip().startswith("#!"):
            file.chmod(0o755)
    return directory


def read(directory: Path) -> dict[str, bytes]:
    files = [file for file in directory.rglob("*") if file.is_file()]
    return {str(file.relative_to(directory)): file.read_bytes() for file in files}


def add(directory: Path, *words: str) -> int:
    return main(["add", *words, "--package-directory", str(directory)])


@pytest.fixture(params=["ament_cmake", "ament_python"])
def demo(tmp_path: Path, request: pytest.FixtureRequest) -> Path:
    """A package of somebody else."""
    files = CMAKE if request.param == "ament_cmake" else PYTHON
    return write(tmp_path / "demo", files)


# -- our own packages

PARTS = ("publisher:talker", "publisher:beat")


@pytest.mark.parametrize("build_type", ["ament_cmake", "ament_python"])
@pytest.mark.parametrize("comments", ["brief", "tutorial"])
def test_new_and_add_make_what_new_makes_of_both(
    build_type: str, comments: str, tmp_path: Path
) -> None:
    answers = tmp_path / "answers.yaml"
    answers.write_text(
        f"build_type: {build_type}\ncomments: {comments}\ndescription: Beats\n"
        "add:\n  - {kind: publisher, name: talker}\n  - kind: publisher\n    name: beat\n"
        "    topic: beat\n    message_type: std_msgs/Float32\n    rate: '5'\n"
    )
    both, first = tmp_path / "both", tmp_path / "first"
    words = ["new", "demo", *PERSON, "--destination-directory"]
    assert main([*words, str(both), "--answers", str(answers)]) == 0
    general = ["--build-type", build_type, "--comments", comments, "--description", "Beats"]
    assert main([*words, str(first), "--node-name", "talker", *general]) == 0
    part = ["publisher", "beat", "--topic", "beat", "--message-type", "std_msgs/Float32"]
    assert add(first / "demo", *part, "--rate", "5", "--comments", comments) == 0
    assert read(first / "demo") == read(both / "demo")
    assert main(["update", str(first / "demo"), "--diff"]) == 0
    assert os.access(first / "demo" / "demo" / "beat.py", os.X_OK)


@pytest.mark.parametrize(
    ("first", "kind", "name", "more"),
    [
        ("message:Status", "message", "Speed", []),
        ("message:Status", "action", "Drive", []),
        ("cpp_program:one", "cpp_program", "two", []),
        ("cpp_program:one", "publisher", "talker", []),
        ("cpp_program:one", "message", "Status", []),
        ("publisher:talker", "cpp_program", "one", []),
        ("publisher:talker", "parameters", "settings", ["--extras", "launch"]),
        ("subscriber:listener", "service_server", "server", ["--extras", "launch", "ci"]),
    ],
)
@pytest.mark.parametrize("is_changed", [False, True])
def test_parts_join_those_of_other_kinds(
    first: str, kind: str, name: str, more: list[str], tmp_path: Path, *, is_changed: bool
) -> None:
    words = ["new", "demo", *PERSON, "--description", "Both", *more, "--add", first]
    both, one = tmp_path / "both", tmp_path / "one"
    assert main([*words, "--add", f"{kind}:{name}", "--destination-directory", str(both)]) == 0
    assert main([*words, "--destination-directory", str(one)]) == 0
    if is_changed:
        with (one / "demo" / "package.xml").open("a") as file:
            file.write("<!-- mine -->\n")
    assert add(one / "demo", kind, name) == 0
    after, expected = read(one / "demo"), read(both / "demo")
    assert after.keys() == expected.keys()
    if not is_changed:
        assert after == expected
    assert add(one / "demo", kind, name) == 0
    assert read(one / "demo") == after
    assert main(["check", str(one / "demo")]) == 0


def test_what_does_not_fit_a_package_is_refused(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    words = ["new", "demo", *PERSON, "--destination-directory", str(tmp_path)]
    assert main([*words, "--add", "message:Status"]) == 0
    capsys.readouterr()
    assert "such as demo_interfaces" in refused(tmp_path / "demo", capsys, "publisher", "talker")


@pytest.mark.parametrize("build_type", ["ament_cmake", "ament_python"])
@pytest.mark.parametrize("extra", EXTRAS)
def test_an_extra_makes_what_new_makes_with_it(
    build_type: str, extra: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    words = ["new", "demo", *PERSON, "--build-type", build_type, "--add", "publisher:talker"]
    words += ["--add", "parameters:settings", "--destination-directory"]
    both, first = tmp_path / "both", tmp_path / "first"
    assert main([*words, str(both), "--extras", extra]) == 0
    assert main([*words, str(first)]) == 0
    assert add(first / "demo", extra) == 0
    assert read(first / "demo") == read(both / "demo")
    capsys.readouterr()
    assert add(first / "demo", extra) == 0
    assert "nothing was changed" in capsys.readouterr().out


def test_an_extra_joins_one_that_an_answers_file_names_alone(tmp_path: Path) -> None:
    answers = write(tmp_path, {"answers.yaml": "extras: gitignore\n"}) / "answers.yaml"
    words = ["new", "demo", *PERSON, "--destination-directory", str(tmp_path)]
    assert main([*words, "--answers", str(answers)]) == 0
    assert add(tmp_path / "demo", "ci") == 0
    record = json.loads((tmp_path / "demo" / NAME).read_text())
    assert record["answers"]["extras"] == ["gitignore", "ci"]
    assert main(["update", str(tmp_path / "demo")]) == 0


@pytest.mark.parametrize("is_changed", [False, True])
def test_a_team_adds_extras_of_its_own(tmp_path: Path, *, is_changed: bool) -> None:
    team = write(
        tmp_path / "team",
        {
            "templates/extras/docker/template.yaml": """\
                summary: A Dockerfile
                questions: { base_image: { default: "ros:jazzy", help: the image to start from } }
                depends: { exec: [ros2launch] }
                """,
            "templates/extras/docker/Dockerfile.jinja": """\
                FROM {{ base_image }}
                {% for node in nodes %}
                # {{ node.name }}
                {% endfor %}
                """,
        },
    )
    answers = write(tmp_path, {"answers.yaml": "base_image: osrf/ros\n"}) / "answers.yaml"
    more = ["--content", str(team), "--answers", str(answers)]
    words = ["new", "demo", *PERSON, "--add", "publisher:talker", "--content", str(team)]
    both, one = tmp_path / "both", tmp_path / "one"
    assert main([*words, "--destination-directory", str(one)]) == 0
    words += ["--extras", "docker", "--answers", str(answers)]
    assert main([*words, "--destination-directory", str(both)]) == 0
    if is_changed:
        with (one / "demo" / "package.xml").open("a") as file:
            file.write("<!-- mine -->\n")
    assert add(one / "demo", "docker", *more) == 0
    assert (one / "demo" / "Dockerfile").read_text() == "FROM osrf/ros\n# talker\n"
    assert "<exec_depend>ros2launch</exec_depend>" in (one / "demo" / "package.xml").read_text()
    after, expected = read(one / "demo"), read(both / "demo")
    record, other = (json.loads(files.pop(NAME)) for files in (after, expected))
    assert record["answers"] == other["answers"]
    if not is_changed:
        assert (after, record["files"]) == (expected, other["files"])
    assert main(["update", str(one / "demo"), "--content", str(team)]) == 0
    assert (one / "demo" / "Dockerfile").read_bytes() == after["Dockerfile"]


def test_the_default_description_follows_the_parts(tmp_path: Path) -> None:
    words = ["new", "demo", *PERSON, "--destination-directory", str(tmp_path)]
    assert main([*words, "--node-name", "talker"]) == 0
    assert add(tmp_path / "demo", "subscriber", "listener") == 0
    described = "A ROS 2 package with the publisher node talker and the subscriber node listener"
    assert f"<description>{described}</description>" in (tmp_path / "demo/package.xml").read_text()
    assert main(["update", str(tmp_path / "demo"), "--diff"]) == 0


def test_an_extra_joins_what_its_owner_has_changed(tmp_path: Path) -> None:
    words = ["new", "demo", *PERSON, "--add", "publisher:talker", "--add", "cpp_program:tool"]
    assert main([*words, "--destination-directory", str(tmp_path)]) == 0
    demo = tmp_path / "demo"
    changed = ("CMakeLists.txt", "README.md", "package.xml")
    for path in changed:
        text = (demo / path).read_text()
        (demo / path).write_text(text.replace("Jazzy", "Kilted").replace("# Find", "# find"))
    (demo / "package.xml").write_text((demo / "package.xml").read_text() + "<!-- mine -->\n")
    before = read(demo)
    assert add(demo, "launch") == 0
    assert main(["check", str(demo)]) == 0
    assert "\n    launch\n    config\n" not in (demo / "CMakeLists.txt").read_text()
    readme = (demo / "README.md").read_text()
    run = readme.index("ros2 launch demo demo.launch.py")
    assert readme.index("## Run") < run < readme.index("### talker")
    lines = {path: before[path].decode().splitlines() for path in changed}
    assert all(set(lines[path]) <= set((demo / path).read_text().splitlines()) for path in changed)
    after = read(demo)
    assert add(demo, "launch") == 0
    assert read(demo) == after
    (demo / "launch" / "demo.launch.py").write_text("mine = True\n")
    assert add(demo, "launch") == 0
    assert (demo / "launch" / "demo.launch.py").read_text() == "mine = True\n"


def test_a_node_joins_the_readme_above_the_programs(tmp_path: Path) -> None:
    words = ["new", "demo", *PERSON, "--add", "publisher:talker", "--add", "cpp_program:tool"]
    assert main([*words, "--destination-directory", str(tmp_path)]) == 0
    demo = tmp_path / "demo"
    (demo / "package.xml").write_text((demo / "package.xml").read_text() + "<!-- mine -->\n")
    assert add(demo, "subscriber", "listener") == 0
    headings = re.findall("^##.*", (demo / "README.md").read_text(), re.MULTILINE)
    assert headings[2:9] == [
        "## Run",
        "### talker",
        "### listener",
        "### C++ programs",
        "## Inspect",
        "## Topics",
        "## Parameters",
    ]


# -- packages of others


# -- fixtures that tests share


def test_the_tests_of_all_nodes_share_their_fixtures(demo: Path) -> None:
    assert add(demo, "publisher", "talker") == 0
    fixtures = (demo / "test" / "conftest.py").read_text()
    assert add(demo, "timer", "ticker", "--copyright-holder", "Somebody Else") == 0
    assert (demo / "test" / "conftest.py").read_text() == fixtures
    assert "Somebody Else" in (demo / "test" / "test_ticker.py").read_text()
    assert "def run(" not in (demo / "test" / "test_ticker.py").read_text()


def test_fixtures_of_the_package_stay_as_they_are(demo: Path) -> None:
    own = "import pytest\n\n\n@pytest.fixture\ndef run():\n    return None\n"
    write(demo, {"test/conftest.py": own})
    for _ in range(2):
        assert add(demo, "publisher", "talker") == 0
        assert add(demo, "timer", "ticker") == 0
        assert (demo / "test" / "conftest.py").read_text() == own
        assert {file.name for file in (demo / "test" / "nodes").iterdir()} == {
            "conftest.py",
            "test_talker.py",
            "test_ticker.py",
        }
    if (demo / "CMakeLists.txt").exists():
        assert "test_talker test/nodes/test_talker.py" in (demo / "CMakeLists.txt").read_text()


def test_tests_go_where_the_package_has_its_own(tmp_path: Path) -> None:
    demo = write(tmp_path / "demo", with_nodes(CMAKE, "scripts", "first=eye"))
    cmake = demo / "CMakeLists.txt"
    text = cmake.read_text().replace(
        "ament_package()",
        "if(BUILD_TESTING)\n"
        "  find_package(ament_cmake_pytest REQUIRED)\n"
        "  ament_add_pytest_test(test_eye tests/test_eye.py)\n"
        "endif()\n\nament_package()",
    )
    cmake.write_text(text)
    write(demo, {"tests/test_eye.py": "def test_eye():\n    pass\n"})
    assert add(demo, "publisher", "talker") == 0
    assert add(demo, "launch_test") == 0
    assert {file.name for file in (demo / "tests").iterdir()} >= {
        "test_launch.py",
        "test_talker.py",
    }
    assert not (demo / "test").exists()
    assert "tests/test_launch.py" in cmake.read_text()


def test_a_line_with_programs_does_not_grow_without_end(tmp_path: Path) -> None:
    demo = write(tmp_path / "demo", with_nodes(CMAKE, "scripts", "first=eye"))
    cmake = demo / "CMakeLists.txt"
    for name in ("talker", "listener", "watcher", "speaker", "follower"):
        assert add(demo, "timer", f"timer_of_the_{name}") == 0
    lines = cmake.read_text().splitlines()
    assert "scripts/timer_of_the_follower.py" in cmake.read_text()
    assert max(map(len, lines)) <= 100
    after = cmake.read_text()
    assert add(demo, "timer", "timer_of_the_talker") == 0
    assert cmake.read_text() == after


def test_the_diff_is_what_is_needed(demo: Path, capsys: pytest.CaptureFixture[str]) -> None:
    before = read(demo)
    assert add(demo, "publisher", "talker", "--diff") == 0
    assert read(demo) == before
    edits, _, _ = capsys.readouterr().out.partition("--- /dev/null")
    lines = re.findall(r"^[+-](?![+-]{2} ).*", edits, re.MULTILINE)
    is_cmake = (demo / "CMakeLists.txt").exists()
    if is_cmake:
        assert lines == [
            "-install(PROGRAMS scripts/hello.py  # the first one",
            "+install(PROGRAMS scripts/hello.py scripts/talker.py  # the first one",
            "+if(BUILD_TESTING)",
            "+  find_package(ament_cmake_pytest REQUIRED)",
            "+  ament_add_pytest_test(test_talker test/test_talker.py TIMEOUT 300)",
            "+endif()",
            "+",
            "+  <exec_depend>rcl_interfaces</exec_depend>",
            "+  <exec_depend>std_msgs</exec_depend>",
            "+  <test_depend>ament_cmake_pytest</test_depend>",
            "+  <test_depend>ament_index_python</test_depend>",
            "+  <test_depend>domain_coordinator</test_depend>",
        ]


def test_a_second_run_changes_nothing(
    demo: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("SOURCE_DATE_EPOCH", "1700000000")
    assert add(demo, "publisher", "talker") == 0
    after = read(demo)
    capsys.readouterr()
    monkeypatch.setenv("SOURCE_DATE_EPOCH", "1800000000")  # three years later
    assert add(demo, "publisher", "talker") == 0
    assert "nothing was changed" in capsys.readouterr().out
    assert read(demo) == after


def test_a_dry_run_changes_nothing(demo: Path, capsys: pytest.CaptureFixture[str]) -> None:
    before = read(demo)
    assert add(demo, "publisher", "talker", "--dry-run") == 0
    assert capsys.readouterr().out.endswith("Nothing was changed (--dry-run).\n")
    assert read(demo) == before


def test_check_has_nothing_new_to_say(demo: Path, capsys: pytest.CaptureFixture[str]) -> None:
    main(["check", str(demo)])
    before = capsys.readouterr().out
    assert add(demo, "publisher", "talker") == 0
    capsys.readouterr()
    main(["check", str(demo)])
    after = capsys.readouterr().out
    assert {re.sub(r"\d+", "", line) for line in after.splitlines()} <= {
        re.sub(r"\d+", "", line) for line in before.splitlines()
    }


def test_the_header_is_that_of_the_package(tmp_path: Path) -> None:
    demo = write(tmp_path / "demo", CMAKE)
    assert add(demo, "publisher", "talker", "--comments", "tutorial") == 0
    lines = (demo / "scripts" / "talker.py").read_text().splitlines()
    assert re.fullmatch(r"# Copyright \d{4} The Hello Company", lines[1])
    assert "Redistribution and use in source and binary forms" in lines[3]
    assert "Author: Grace" in lines


def test_an_unknown_licence_gives_the_header_of_the_other_files(tmp_path: Path) -> None:
    manifest = CMAKE["package.xml"].replace("BSD-3-Clause", "Ours")
    demo = write(tmp_path / "demo", {**CMAKE, "package.xml": manifest})
    assert add(demo, "publisher", "talker") == 0
    lines = (demo / "scripts" / "talker.py").read_text().splitlines()
    assert lines[:3] == [
        "#!/usr/bin/env python3",
        "# Copyright 2020 The Hello Company. All rights reserved.",
        "",
    ]


def test_paragraphs_that_empty_lines_keep_apart_are_one_header(tmp_path: Path) -> None:
    manifest = CMAKE["package.xml"].replace("BSD-3-Clause", "Ours")
    script = """\
        #!/usr/bin/env python3
        # Copyright 2020 The Hello Company

        # Use it as you like,
        # under the terms of our license.

        # It comes without warranty; see the LICENSE.

        # Imports of the standard library
        import sys
        """
    demo = write(tmp_path / "demo", {**CMAKE, "package.xml": manifest, "scripts/hello.py": script})
    assert add(demo, "publisher", "talker") == 0
    lines = (demo / "scripts" / "talker.py").read_text().splitlines()
    assert lines[1:8] == [
        "# Copyright 2020 The Hello Company",
        "#",
        "# Use it as you like,",
        "# under the terms of our license.",
        "#",
        "# It comes without warranty; see the LICENSE.",
        "",
    ]


def test_the_author_of_other_files_is_not_the_one_of_new_ones(tmp_path: Path) -> None:
    manifest = CMAKE["package.xml"].replace("BSD-3-Clause", "Ours")
    hello = CMAKE["scripts/hello.py"].replace(
        "# Copyright", "# @author  Grace <grace@example.org>\n        # Copyright", 1
    )
    demo = write(tmp_path / "demo", {**CMAKE, "package.xml": manifest, "scripts/hello.py": hello})
    assert add(demo, "publisher", "talker") == 0
    lines = (demo / "scripts" / "talker.py").read_text().splitlines()
    assert lines[1] == "# Copyright 2020 The Hello Company. All rights reserved."


LINTER_TEST = """\
    # Copyright 2015 Open Source Robotics Foundation, Inc.
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

    from ament_copyright.main import main


    def test_copyright():
        assert main(argv=['.', 'test']) == 0
    """
"""What `ros2 pkg create` leaves behind, three times."""
OF_OTHERS = {
    **{f"test/test_{name}.py": LINTER_TEST for name in ("copyright", "flake8", "pep257")},
    "third_party/motor.h": "// Copyright 2019 Motors LLC\n",
    "deps/motors/motor.c": "// Copyright 2019 Motors LLC\n",
    "demo/drivers/LICENSE": "Drivers are free.\n",
    "demo/drivers/a.py": "# Copyright 2019 Drivers Inc.\n",
    "demo/drivers/b.py": "# Copyright 2019 Drivers Inc.\n",
    "demo/drivers/c.py": "# Copyright 2019 Drivers Inc.\n",
    "launch/demo.launch.py": "# Copyright 2019 Open Source Robotics Foundation, Inc.\n",
}


def notice(directory: Path) -> list[str]:
    """Return the copyright notice of what was added to a package of ament_python."""
    text = (directory / "demo" / "talker.py").read_text()
    return re.findall(r"(?m)^# Copyright \d{4} (.*)$", text)


@pytest.mark.parametrize(
    ("own", "holder"),
    [
        ({}, "Grace"),
        ({"demo/a.py": "# Copyright 2024 Acme Corp. All rights reserved.\n"}, "Acme Corp"),
        ({"demo/a.py": "# Copyright 2024 Acme\n", "demo/b.py": "# Copyright 2025 Acme\n"}, "Acme"),
        ({"demo/a.py": "# Copyright 2024 Acme\n", "demo/b.py": "b = 1\n"}, "Grace"),
        ({"demo/a.py": "# Copyright 2024 Acme\n", "demo/b.py": "# Copyright 2024 B\n"}, "Grace"),
        ({"demo/a.py": "# Copyright 2016 Open Source Robotics Foundation, Inc.\n"}, "Grace"),
    ],
    ids=["none", "a notice", "all", "half", "different ones", "a copied example"],
)
def test_the_holder_is_the_maintainer_or_that_of_most_own_sources(
    own: Mapping[str, str], holder: str, tmp_path: Path
) -> None:
    files = {path: text for path, text in PYTHON.items() if path != "demo/hello.py" or not own}
    demo = write(tmp_path / "demo", {**files, **OF_OTHERS, **own})
    assert add(demo, "publisher", "talker") == 0
    assert notice(demo) == [holder]


def test_of_several_holders_of_all_sources_the_first_is_taken(tmp_path: Path) -> None:
    files = {path: text for path, text in PYTHON.items() if path != "demo/hello.py"}
    for number in range(8):  # the order of a set would differ from run to run
        own = f"# Copyright 2024 Acme{number} Corp\n# Copyright 2026 Robots{number} Inc.\n"
        demo = write(tmp_path / str(number) / "demo", {**files, "demo/a.py": own})
        assert add(demo, "publisher", "talker") == 0
        assert notice(demo) == [f"Acme{number} Corp"]


def test_examples_of_open_robotics_keep_their_holder(tmp_path: Path) -> None:
    manifest = PYTHON["package.xml"].replace("grace@example.com", "grace@openrobotics.org")
    own = "# Copyright 2016 Open Source Robotics Foundation, Inc.\n"
    files = {**PYTHON, "package.xml": manifest, "demo/hello.py": own}
    demo = write(tmp_path / "demo", files)
    assert add(demo, "publisher", "talker") == 0
    assert notice(demo) == ["Open Source Robotics Foundation, Inc."]


def test_a_submodule_has_a_holder_of_its_own(tmp_path: Path) -> None:
    submodule = {".gitmodules": "[submodule]\n  path = demo/arm\n", ".git/HEAD": ""}
    others = {f"demo/arm/{name}.py": "# Copyright 2019 Arms Inc.\n" for name in "abc"}
    demo = write(tmp_path / "demo", {**PYTHON, **submodule, **others})
    assert add(demo, "publisher", "talker") == 0
    assert notice(demo) == ["Grace"]


@pytest.mark.parametrize("maintainer", ["root", "TODO", "your name"])
def test_without_a_holder_there_is_no_header(
    maintainer: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    manifest = PYTHON["package.xml"].replace(">Grace<", f">{maintainer}<")
    demo = write(tmp_path / "demo", {**PYTHON, **OF_OTHERS, "package.xml": manifest})
    assert add(demo, "publisher", "talker") == 0
    assert notice(demo) == []
    assert (
        "note: the new files have no license header: neither the maintainer nor the sources of "
        "demo name a copyright holder; --copyright-holder adds one\n"
    ) in capsys.readouterr().err
    assert add(demo, "publisher", "talker", "--copyright-holder", "Ada", "--force") == 0
    assert notice(demo) == ["Ada"]


@pytest.mark.parametrize("license_", ["TODO: License declaration", "TODO", "Your License"])
def test_an_undecided_licence_gives_no_header(
    license_: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    manifest = PYTHON["package.xml"].replace("Apache License 2.0", license_)
    own = {"demo/hello.py": LINTER_TEST.replace("Open Source Robotics Foundation, Inc.", "Acme")}
    demo = write(tmp_path / "demo", {**PYTHON, **OF_OTHERS, **own, "package.xml": manifest})
    assert add(demo, "publisher", "talker") == 0
    assert notice(demo) == []
    assert "Licensed" not in (demo / "demo" / "talker.py").read_text()
    assert f"the license of demo is {license_!r}" in capsys.readouterr().err


def test_without_any_licence_there_is_no_header(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    files = {**CMAKE, "scripts/hello.py": "#!/usr/bin/env python3\nprint('hello')\n"}
    files["package.xml"] = CMAKE["package.xml"].replace("BSD-3-Clause", "TODO")
    demo = write(tmp_path / "demo", files)
    assert add(demo, "publisher", "talker") == 0
    assert (demo / "scripts" / "talker.py").read_text().startswith('#!/usr/bin/env python3\n"""\n')
    said = capsys.readouterr().err
    assert "the license of demo is 'TODO'; --license adds one" in said
    assert add(demo, "publisher", "other", "--license", "MIT") == 0
    assert "governed by an MIT-style" in (demo / "scripts" / "other.py").read_text()


@pytest.mark.parametrize(
    ("clause", "place", "expected"),
    [
        ("3. Neither the name of Acme nor those of others may be used.", ".", "BSD-3-Clause"),
        ("", "demo", "BSD-2-Clause"),
        (None, "", ""),
    ],
)
def test_what_the_manifest_leaves_open_is_in_the_text_of_the_license(
    clause: str | None,
    place: str,
    expected: str,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    files = {**CMAKE, "scripts/hello.py": "#!/usr/bin/env python3\nprint('hello')\n"}
    files["package.xml"] = CMAKE["package.xml"].replace("BSD-3-Clause", "BSD")
    demo = write(tmp_path / "demo", files)
    write(tmp_path, {".git/HEAD": "ref: refs/heads/main\n"})
    text = "Copyright (c) 2019-2021, Acme Robotics Inc.\n\nRedistribution and use in source\n"
    text += "and binary forms, with or without modification, are permitted provided that:\n"
    if clause is not None:
        (tmp_path / place / "LICENSE.txt").write_text(f"{text}{clause}\n")
    assert add(demo, "publisher", "talker") == 0
    said, written = capsys.readouterr().err, (demo / "scripts" / "talker.py").read_text()
    assert ("the license of demo is 'BSD'" in said) is (clause is None)
    assert ("Acme Robotics Inc.\n" in written) is bool(expected)
    assert ("Neither the name of" in written) is (expected == "BSD-3-Clause")


def test_answers_come_from_flags_a_file_and_the_configuration(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    demo = write(tmp_path / "demo", CMAKE)
    config = tmp_path / "config" / "ros2-scaffold" / "config.toml"
    write(config.parent, {config.name: "[new]\nrate = 7.0\nqos = 'sensor_data'\nlicense = 'MIT'\n"})
    write(tmp_path, {"answers.yaml": "rate: 8.0\ntopic: a\n"})
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path / "config"))
    answers = ["--answers", str(tmp_path / "answers.yaml"), "--topic", "b"]
    assert add(demo, "publisher", "talker", *answers) == 0
    text = (demo / "scripts" / "talker.py").read_text()
    assert "declare_parameter('rate', 8.0, " in text
    assert "create_publisher(String, 'b', qos_profile_sensor_data)" in text
    assert "MIT-style" not in text


def test_the_package_is_the_one_around_the_current_directory(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    demo = write(tmp_path / "demo", CMAKE)
    monkeypatch.chdir(demo / "scripts")
    assert main(["add", "publisher", "talker"]) == 0
    assert (demo / "scripts" / "talker.py").exists()
    monkeypatch.chdir(tmp_path)
    assert main(["add", "publisher", "talker"]) == 2
    assert "no package.xml here or above" in capsys.readouterr().err


def test_what_cannot_be_edited_is_said(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    lists = CMAKE["CMakeLists.txt"].replace("ament_package()", "if(X)\n ament_package()\nendif()")
    demo = write(tmp_path / "demo", {**CMAKE, "CMakeLists.txt": lists})
    before = (demo / "CMakeLists.txt").read_bytes()
    assert add(demo, "publisher", "talker") == 1
    assert (demo / "CMakeLists.txt").read_bytes() == before
    said = capsys.readouterr().err
    assert (
        f"    {demo}/CMakeLists.txt: find_package(ament_cmake_pytest REQUIRED) and "
        "ament_add_pytest_test(test_talker test/test_talker.py TIMEOUT 300) "
        "inside if(BUILD_TESTING)\n"
        "        because there is no ament_package() at the top level\n"
    ) in said


@pytest.mark.parametrize("kind", parts.kinds(TEMPLATES))
def test_every_kind_can_be_added(kind: str, demo: Path, capsys: pytest.CaptureFixture[str]) -> None:
    role = TEMPLATES[kind].role
    name = "Extra" if role is Role.INTERFACE else "extra"
    if role is not Role.NODE and (demo / "setup.py").exists():
        assert "needs the build type ament_cmake" in refused(demo, capsys, kind, name)
        return
    assert add(demo, kind, name) == 0
    assert capsys.readouterr().err == ""
    after = read(demo)
    assert add(demo, kind, name) == 0
    assert read(demo) == after


def test_what_is_found_in_other_files_is_said_and_does_not_matter(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    manifest = CMAKE["package.xml"].replace("<exec_depend>rclpy</exec_depend>", "")
    script = CMAKE["scripts/hello.py"].replace(
        "print('hello')", "import rosgraph_msgs.msg\n        print(rosgraph_msgs)"
    )
    demo = write(tmp_path / "demo", {**CMAKE, "package.xml": manifest, "scripts/hello.py": script})
    assert add(demo, "publisher", "talker") == 0
    assert "PX080 scripts/hello.py:" in capsys.readouterr().err
    assert (demo / "scripts" / "talker.py").exists()


def test_what_is_found_of_an_old_line_is_said_and_does_not_matter(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    line = "('share/demo', ['package.xml']),"
    setup = PYTHON["setup.py"].replace(
        line, f"{line}\n                ('share/demo', glob('launch/*_launch.py')),"
    )
    setup = f"        from glob import glob\n{setup}"
    demo = write(tmp_path / "demo", {**PYTHON, "setup.py": setup})
    assert add(demo, "publisher", "talker") == 0
    capsys.readouterr()
    assert add(demo, "launch") == 0
    assert "SP011 the pattern launch/*_launch.py matches no file; " in capsys.readouterr().err
    assert (demo / "launch" / "demo.launch.py").exists()


@pytest.mark.parametrize(
    ("before", "after"), [("<name>demo<", "<name>other<"), ("'package.xml'", "'package.xm'")]
)
def test_an_edit_that_makes_another_line_wrong_is_refused(
    before: str,
    after: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    def spoilt(package: Package, addition: Addition) -> Edited:
        edited = edit(package, addition)
        changed = {
            path: data.replace(before.encode(), after.encode())
            for path, data in edited.files.items()
        }
        return edited._replace(files=changed)

    demo = write(tmp_path / "demo", PYTHON)
    there = read(demo)
    monkeypatch.setattr("scaffold.generate.add.add.edit", spoilt)
    assert add(demo, "publisher", "talker") == 3
    assert "internal error: the checker finds errors in the added files" in capsys.readouterr().err
    assert read(demo) == there


def test_what_was_found_before_may_name_what_is_new(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    setup = PYTHON["setup.py"].replace("demo.hello:main", "demo.hallo:main")
    demo = write(tmp_path / "demo", {**PYTHON, "setup.py": setup})
    (demo / "demo" / "hello.py").unlink()
    assert add(demo, "publisher", "talker") == 0
    assert "SP001" not in capsys.readouterr().err
    main(["check", str(demo)])
    assert "there is no demo/hallo.py; closest: demo/talker.py" in capsys.readouterr().out


def test_a_node_name_that_is_taken_is_said(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    demo = write(tmp_path / "demo", PYTHON)
    assert add(demo, "publisher", "talker") == 0
    text = (demo / "demo" / "talker.py").read_text()
    (demo / "demo" / "hello.py").write_text(text.replace("'talker'", "'beat'"))
    line = text.partition("super().__init__('talker')")[0].count("\n") + 1
    capsys.readouterr()
    assert add(demo, "publisher", "beat") == 0
    assert capsys.readouterr().err == (
        f"note: demo/hello.py:{line} also creates a node named 'beat': "
        "nodes that run together need different names\n"
    )


def test_nodes_that_do_not_connect_are_named(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    demo = write(tmp_path / "demo", CMAKE)
    assert add(demo, "publisher", "talker", "--topic", "chatter") == 0
    assert add(demo, "publisher", "other", "--topic", "chatter") == 0
    assert capsys.readouterr().err == ""
    assert add(demo, "action_server", "counter", "--action", "count") == 0
    before = read(demo)
    words = ["--topic", "/chatter", "--message-type", "std_msgs/msg/Int32"]
    message = refused(demo, capsys, "subscriber", "listener", *words)
    assert message.startswith("the topic /chatter is std_msgs/msg/Int32 in listener, scripts/")
    assert message.endswith("use the same type for both, or different names; nothing was changed")
    words = ["--topic", "chatter", "--qos", "latched"]
    message = refused(demo, capsys, "subscriber", "listener", *words)
    assert message.startswith("the topic /chatter is published volatile by ")
    assert message.endswith("use the same quality of service for both; nothing was changed")
    assert read(demo) == before
    words = ["--action", "count", "--action-type", "tf2_msgs/action/LookupTransform"]
    assert add(demo, "action_client", "asker", *words) == 0
    said = capsys.readouterr().err
    assert "the action /count is tf2_msgs/action/LookupTransform in asker, scripts/" in said


DRIVER = """\
    import rclpy
    from rclpy.node import Node
    from rclpy.qos import qos_profile_sensor_data
    from sensor_msgs.msg import LaserScan


    class Driver(Node):
        def __init__(self):
            super().__init__('driver')
            self.publisher = self.create_publisher(LaserScan, 'front', qos_profile_sensor_data)
    """


def test_a_subscriber_has_the_type_and_the_quality_of_service_of_the_publisher_there(
    tmp_path: Path,
) -> None:
    demo = write(tmp_path / "demo", {**CMAKE, "demo/driver.py": dedent(DRIVER)})
    assert add(demo, "subscriber", "listener", "--topic", "front") == 0
    text = (demo / "scripts" / "listener.py").read_text()
    assert "LaserScan, 'front', self.receive_message, qos_profile_sensor_data)" in text


def test_a_package_of_ours_refuses_services_of_two_types(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    words = ["new", "demo", *PERSON, "--node-kind", "service_server", "--node-name", "server"]
    assert main([*words, "--destination-directory", str(tmp_path)]) == 0
    capsys.readouterr()
    words = ["--service", "add_two_ints", "--service-type", "std_srvs/srv/Trigger"]
    assert refused(tmp_path / "demo", capsys, "service_client", "asker", *words) == (
        "the service /add_two_ints is example_interfaces/srv/AddTwoInts in server, but "
        "std_srvs/srv/Trigger in asker: they do not connect; use the same type for both, or "
        "different names"
    )


# -- extras of others

NODE = """\
    #!/usr/bin/env python3
    import rclpy
    from rclpy.node import Node


    class {cls}(Node):
        def __init__(self):
            super().__init__('{name}')
            self.declare_parameter('gain', 1.0)


    def main():
        rclpy.init()
        rclpy.spin({cls}())


    if __name__ == '__main__':
        main()
    """


def with_nodes(files: Mapping[str, str], directory: str, *names: str) -> dict[str, str]:
    """Return a package with a node in each of some programs: ``program=node name``."""
    found = dict(files)
    build = "CMakeLists.txt" if "CMakeLists.txt" in files else "setup.py"
    for word in reversed(names):
        program, _, name = word.partition("=")
        found[f"{directory}/{program}.py"] = NODE.format(cls=program.title(), name=name)
        if build == "setup.py":
            more = f"'hello = demo.hello:main', '{program} = demo.{program}:main'"
            found[build] = found[build].replace("'hello = demo.hello:main'", more)
        else:
            more = f"scripts/hello.py scripts/{program}.py"
            found[build] = found[build].replace("scripts/hello.py", more)
    return found


def launched(demo: Path) -> list[str]:
    """Return what the launch file says of its nodes."""
    text = (demo / "launch" / "demo.launch.py").read_text()
    return re.findall(r"(?<= )(?:(?:executable|name)=|config / ').*(?=,)", text)


@pytest.mark.parametrize(("files", "directory"), [(CMAKE, "scripts"), (PYTHON, "demo")])
def test_launch_starts_the_nodes_of_a_package(
    files: Mapping[str, str], directory: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    demo = write(tmp_path / "demo", with_nodes(files, directory, "first=eye", "other=ear"))
    write(demo, {"config/ear.yaml": "ear:\n  ros__parameters:\n    gain: 2.0\n"})
    ending = ".py" if directory == "scripts" else ""
    before = read(demo)
    assert add(demo, "launch") == 0
    assert capsys.readouterr().err == (
        f"note: launch/demo.launch.py does not start hello{ending}: not known to be nodes\n"
    )
    assert set(launched(demo)) == {
        f"executable='first{ending}'",
        f"executable='other{ending}'",
        "config / 'ear.yaml'",
    }
    build = "CMakeLists.txt" if ending else "setup.py"
    for path in ("package.xml", build):
        lines = (demo / path).read_text().splitlines()
        assert set(before[path].decode().splitlines()) <= set(lines)
    for name in ("launch", "launch_ros", "ament_index_python"):
        assert f"<exec_depend>{name}</exec_depend>" in (demo / "package.xml").read_text()
    capsys.readouterr()
    main(["check", str(demo)])
    said = capsys.readouterr().out
    assert "/demo/launch/" not in said
    assert "/demo/config/" not in said
    after = read(demo)
    assert add(demo, "launch") == 0
    assert read(demo) == after


def test_a_launch_file_is_edited_only_when_it_is_named(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    demo = write(tmp_path / "demo", with_nodes(CMAKE, "scripts", "first=eye"))
    assert add(demo, "launch") == 0
    path = demo / "launch" / "demo.launch.py"
    path.write_text(path.read_text().replace("Start the node", "Run the node"))
    before = path.read_bytes()
    capsys.readouterr()
    assert add(demo, "publisher", "talker") == 0
    assert path.read_bytes() == before
    assert capsys.readouterr().err == (
        "note: launch/demo.launch.py does not start talker.py: --launch launch/demo.launch.py "
        "would add it\n"
    )
    assert refused(demo, capsys, "launch") == (
        f"launch/demo.launch.py in {demo} already exists and differs; "
        "`add KIND NAME --launch launch/demo.launch.py` starts a new node there; "
        "nothing was changed"
    )
    assert refused(demo, capsys, "publisher", "talker", "--launch", "launch/talker.py") == (
        "--launch: launch/talker.py is not a launch file of demo; it has launch/demo.launch.py"
    )
    for named in ("launch/demo.launch.py", str(path)):
        assert add(demo, "publisher", "talker", "--launch", named) == 0
        assert launched(demo) == ["executable='first.py'", "executable='talker.py'"]
    assert path.read_text().count("namespace=LaunchConfiguration('namespace'),") == 2


COMPUTED = """\
from launch import LaunchDescription
from launch_ros.actions import Node


def generate_launch_description():
    return LaunchDescription([Node(package='demo', executable=name) for name in ('a', 'b')])
"""


@pytest.mark.parametrize(
    ("name", "text", "reason", "line"),
    [
        (
            "made.launch.py",
            "def generate_launch_description():\n    return make()\n",
            "it starts no node of demo that shows how",
            "Node(package='demo', executable='talker.py'),",
        ),
        (
            "some.launch.py",
            COMPUTED,
            "it is not clear where its LaunchDescription is filled",
            "Node(package='demo', executable='talker.py'),",
        ),
        (
            "some.launch.xml",
            "<launch/>\n",
            "only Python launch files can be edited",
            '<node pkg="demo" exec="talker.py"/>',
        ),
    ],
)
@pytest.mark.parametrize("is_ours", [False, True])
def test_a_named_launch_file_that_cannot_be_edited_is_refused(
    name: str,
    text: str,
    reason: str,
    line: str,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    *,
    is_ours: bool,
) -> None:
    demo = tmp_path / "demo"
    if is_ours:
        maintainer = ("--maintainer-name", "Ada", "--maintainer-email", "ada@example.org")
        main(["new", "demo", "--destination", str(tmp_path), "--extras", "launch", *maintainer])
    else:
        write(demo, with_nodes(CMAKE, "scripts", "first=eye"))
    write(demo, {f"launch/{name}": text})
    before = read(demo)
    capsys.readouterr()
    assert refused(demo, capsys, "publisher", "talker", "--launch", f"launch/{name}") == (
        f"--launch: launch/{name} cannot be edited: {reason}; add `{line}` there yourself and "
        "omit --launch; nothing was changed"
    )
    assert read(demo) == before


def test_several_launch_files_without_a_node_are_one_note(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    demo = write(tmp_path / "demo", with_nodes(CMAKE, "scripts", "first=eye"))
    assert add(demo, "launch") == 0
    path = demo / "launch" / "demo.launch.py"
    (demo / "launch" / "other.launch.py").write_text(path.read_text())
    capsys.readouterr()
    assert add(demo, "publisher", "talker") == 0
    assert capsys.readouterr().err == (
        "note: 2 launch files do not start talker.py, such as launch/demo.launch.py: "
        "--launch FILE would add it\n"
    )


def test_launch_starts_programs_that_use_rclcpp(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    targets = (
        "add_library(core a.cpp)\ntarget_link_libraries(core PUBLIC rclcpp::rclcpp)\n"
        "add_executable(one a.cpp)\nament_target_dependencies(one rclcpp std_msgs)\n"
        "add_executable(two a.cpp)\ntarget_link_libraries(two core)\n"
        "add_executable(three a.cpp)\ntarget_link_libraries(three rclcpp_fake)\n"
        "install(TARGETS core DESTINATION lib)\n"
        "install(TARGETS one two three DESTINATION lib/${PROJECT_NAME})\n"
    )
    lists = dedent(CMAKE["CMakeLists.txt"]).replace("ament_package", f"{targets}ament_package")
    demo = write(tmp_path / "demo", {**CMAKE, "CMakeLists.txt": lists})
    assert add(demo, "launch") == 0
    assert launched(demo) == ["executable='one'", "executable='two'"]
    said = capsys.readouterr().err
    assert "launch/demo.launch.py does not start hello.py, three: not known to be nodes" in said


def test_launch_starts_the_nodes_that_setup_cfg_declares(tmp_path: Path) -> None:
    made = with_nodes(PYTHON, "demo", "first=eye")
    setup = dedent(made["setup.py"])
    made["setup.py"] = re.sub(r"    entry_points=.*\n", "", setup)
    made["setup.cfg"] = dedent(made["setup.cfg"]) + (
        "[options.entry_points]\nconsole_scripts =\n    one = demo.first:main\n"
    )
    demo = write(tmp_path / "demo", made)
    assert add(demo, "launch") == 0
    assert launched(demo) == ["executable='one'"]


def test_launch_starts_a_node_of_a_module_that_the_program_imports(tmp_path: Path) -> None:
    node = "from rclpy.node import Node\n\n\nclass Eye(Node):\n    def __init__(self):\n"
    files = {
        "demo/parts/__init__.py": "",
        "demo/parts/eye.py": f"{node}        super().__init__('eye')\n",
        "demo/hello.py": "import rclpy\nfrom demo.parts import eye as organ\n\n\n"
        "def main():\n    rclpy.init()\n    rclpy.spin(organ.Eye())\n",
    }
    demo = write(tmp_path / "demo", {**PYTHON, **files})
    assert add(demo, "launch") == 0
    assert launched(demo) == ["executable='hello'"]


def test_launch_starts_a_node_of_a_class_that_another_package_has(tmp_path: Path) -> None:
    demo = write(tmp_path / "demo", CMAKE)
    assert add(demo, "nav2_client", "patrol") == 0
    assert add(demo, "launch") == 0
    assert "executable='patrol.py'" in launched(demo)


def test_nodes_of_one_name_are_started_under_those_of_their_programs(tmp_path: Path) -> None:
    demo = write(tmp_path / "demo", with_nodes(CMAKE, "scripts", "first=eye", "other=eye"))
    assert add(demo, "launch") == 0
    assert launched(demo) == [
        "executable='first.py'",
        "name='first'",
        "executable='other.py'",
        "name='other'",
    ]


@pytest.mark.parametrize(
    ("files", "directory", "there", "gained"),
    [
        (
            PYTHON,
            "demo",
            ("('share/demo', ['package.xml']),", "('share/demo/launch', ['launch/a.launch.py']),"),
            "('share/demo/launch', ['launch/a.launch.py', 'launch/demo.launch.py']),",
        ),
        (
            PYTHON,
            "demo",
            ("('share/demo', ['package.xml']),", "('share/demo', glob('launch/*.xml')),"),
            "('share/demo/launch', ['launch/demo.launch.py']),",
        ),
        (
            CMAKE,
            "scripts",
            ("ament_package", "install(FILES launch/a.launch.py DESTINATION share/demo/launch)\n"),
            "install(FILES launch/a.launch.py launch/demo.launch.py DESTINATION share/demo/launch)",
        ),
    ],
)
def test_a_launch_file_joins_those_that_are_installed_one_by_one(
    files: Mapping[str, str], directory: str, there: tuple[str, str], gained: str, tmp_path: Path
) -> None:
    made = with_nodes(files, directory, "first=eye")
    build = "CMakeLists.txt" if directory == "scripts" else "setup.py"
    old, new = there
    both = f"{old}\n        {new}" if build == "setup.py" else f"{new}{old}"
    glob = "from glob import glob\n" if "glob" in new else ""
    made[build] = glob + dedent(made[build]).replace(old, both)
    demo = write(tmp_path / "demo", {**made, "launch/a.launch.py": "", "launch/b.xml": ""})
    assert add(demo, "launch") == 0
    lines = [line.strip() for line in (demo / build).read_text().splitlines()]
    assert gained in lines
    after = read(demo)
    assert add(demo, "launch") == 0
    assert read(demo) == after


def test_what_installs_other_launch_files_alone_is_said(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    made = with_nodes(CMAKE, "scripts", "first=eye")
    install = 'install(DIRECTORY launch DESTINATION share/demo FILES_MATCHING PATTERN "*.xml")\n'
    made["CMakeLists.txt"] = dedent(made["CMakeLists.txt"]).replace(
        "ament_package", f"{install}ament_package"
    )
    demo = write(tmp_path / "demo", {**made, "launch/b.xml": "<launch/>\n"})
    assert add(demo, "launch") == 1
    assert (
        "CMakeLists.txt: install(FILES launch/demo.launch.py DESTINATION "
        "share/${PROJECT_NAME}/launch)\n        because what installs launch/ does not include it\n"
    ) in capsys.readouterr().err


@pytest.mark.parametrize(
    "extra",
    [name for name in EXTRAS if not (TEMPLATES[name].depends or TEMPLATES[name].needs_nodes)],
)
def test_an_extra_of_files_alone_writes_them(
    extra: str, demo: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    before = read(demo)
    assert add(demo, extra, "--dry-run") == 0
    assert read(demo) == before
    capsys.readouterr()
    assert add(demo, extra) == 0
    said = capsys.readouterr()
    unread = "read only at the top of a git repository" in said.err
    assert (said.err == "") is not unread
    assert unread is bool(TEMPLATES[extra].repository)
    assert "colcon" not in said.out
    after = read(demo)
    assert before.items() < after.items()
    assert add(demo, extra) == 0
    assert read(demo) == after


def test_an_extra_does_not_overwrite(demo: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (demo / ".gitignore").write_text("mine\n")
    said = refused(demo, capsys, "gitignore")
    assert said == (f".gitignore in {demo} already exists and differs; overwrite it with --force")
    assert add(demo, "gitignore", "--force") == 0
    assert "__pycache__/" in (demo / ".gitignore").read_text()


@pytest.mark.parametrize("extra", [name for name in EXTRAS if TEMPLATES[name].needs_nodes])
def test_an_extra_for_nodes_writes_nothing_without_any(
    extra: str, demo: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert refused(demo, capsys, extra) == (
        f"{extra} has nothing to write for {demo}: it installs no node that is known"
    )


def test_the_usage_page_lists_what_an_existing_package_has(demo: Path) -> None:
    (demo / "msg").mkdir()
    (demo / "msg" / "Beat.msg").write_text("float64 period\n")
    assert add(demo, "documentation") == 0
    page = (demo / "doc" / "usage.rst").read_text()
    assert "* ``demo/msg/Beat``\n" in page
    assert "   ros2 run demo hello" in page


def test_a_usage_page_without_content_is_not_written(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    library = PYTHON["setup.py"].replace("hello = demo.hello:main", "").replace("['']", "[]")
    demo = write(tmp_path / "demo", {**PYTHON, "setup.py": library})
    assert refused(demo, capsys, "documentation") == (
        f"documentation has nothing to write for {demo}: "
        "it has no program and no interface that is known"
    )


# -- refusals


def refused(demo: Path, capsys: pytest.CaptureFixture[str], *words: str) -> str:
    before = read(demo)
    assert add(demo, *words) == 2
    assert read(demo) == before
    (line,) = capsys.readouterr().err.splitlines()
    return line.removeprefix("ros2-scaffold: error: ")


def test_a_file_is_not_overwritten_unasked(demo: Path, capsys: pytest.CaptureFixture[str]) -> None:
    directory = "scripts" if (demo / "scripts").exists() else "demo"
    path = demo / directory / "talker.py"
    path.write_text("mine = True\n")
    said = refused(demo, capsys, "publisher", "talker")
    assert said == (
        f"{directory}/talker.py in {demo} already exists and differs; "
        "choose another name, or overwrite it with --force"
    )
    assert add(demo, "publisher", "talker", "--force") == 0
    assert "class Talker(Node):" in path.read_text()


@pytest.mark.parametrize(
    ("files", "path", "text", "where"),
    [
        (CMAKE, "package.xml", "<package>\n<name>demo</nam>\n", "package.xml:2:"),
        (CMAKE, "CMakeLists.txt", "project(demo)\nfind_package(x\n", "CMakeLists.txt:2:"),
        (CMAKE, "scripts/hello.py", "#!/usr/bin/env python3\ndef f(:\n", "scripts/hello.py:2:"),
        (PYTHON, "setup.py", "from setuptools import setup\nsetup(\n", "setup.py:2:"),
        (PYTHON, "setup.cfg", "[develop]\nx\n", "setup.cfg:2:"),
        (PYTHON, "demo/hello.py", "def main():\nprint('hello')\n", "demo/hello.py:2:"),
    ],
)
def test_a_package_that_does_not_parse_is_refused(
    files: Mapping[str, str],
    path: str,
    text: str,
    where: str,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    demo = write(tmp_path / "demo", {**files, path: text})
    assert refused(demo, capsys, "publisher", "talker").startswith(f"{demo}/{where}")


def test_a_program_that_is_there_is_not_added_again(
    demo: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    if (demo / "CMakeLists.txt").exists():
        text = (
            (demo / "CMakeLists.txt").read_text().replace("scripts/hello.py", "a/hello.py b/x.py")
        )
        write(demo, {"CMakeLists.txt": text, "a/hello.py": "", "b/x.py": ""})
        expected = "demo already has a program 'hello.py', a/hello.py; choose another name"
    else:
        text = (demo / "setup.py").read_text().replace("demo.hello:main", "demo.other:main")
        write(demo, {"setup.py": text, "demo/other.py": "def main():\n    pass\n"})
        (demo / "demo" / "hello.py").unlink()
        expected = "demo already has a program 'hello', demo/other.py; choose another name"
    assert refused(demo, capsys, "publisher", "hello") == expected


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("publischer", "x_y"), "did you mean publisher?"),
        (("publisher", "Bad-Name"), "NAME"),
        (("publisher",), "NAME is required: the name of the node"),
        (("launch", "all"), "NAME does not apply to launch, which is for the whole package"),
        (("lunch",), "did you mean launch?"),
        (("publisher", "talker", "--rate", "fast"), "--rate: 'fast' is not a rate in hertz"),
        (("message", "Status"), "message needs the build type ament_cmake, not ament_python"),
    ],
)
def test_unusable_answers_are_refused(
    words: tuple[str, ...], said: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert said in refused(write(tmp_path / "demo", PYTHON), capsys, *words)


def test_a_directory_without_a_package_is_refused(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "demo").mkdir()
    said = refused(tmp_path / "demo", capsys, "publisher", "talker")
    assert said == f"{tmp_path}/demo is not a package: it has no package.xml"


def test_a_package_of_ros_1_is_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    text = CMAKE["package.xml"]
    text = text.replace("ament_cmake</buildtool_depend>", "catkin</buildtool_depend>")
    text = text.replace("<build_type>ament_cmake</build_type>", "")
    demo = write(tmp_path / "demo", {**CMAKE, "package.xml": text})
    assert refused(demo, capsys, "publisher", "talker") == (
        f"{demo}: a package of ROS 1, built with catkin, and `add` writes ROS 2 code; "
        "nothing was changed"
    )


def test_what_cmake_finds_already_is_declared_for_the_build(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    found = "find_package(rclpy REQUIRED)\n        find_package(ament_index_python REQUIRED)\n"
    files = {
        **CMAKE,
        "package.xml": CMAKE["package.xml"].replace("<exec_depend>rclpy</exec_depend>", ""),
        "CMakeLists.txt": CMAKE["CMakeLists.txt"].replace("install(", f"{found}        install("),
    }
    demo = write(tmp_path / "demo", files)
    assert add(demo, "publisher", "talker") == 0
    text = (demo / "package.xml").read_text()
    assert "<depend>rclpy</depend>" in text
    assert "<build_depend>ament_index_python</build_depend>" in text
    assert "<test_depend>ament_index_python</test_depend>" not in text
    capsys.readouterr()


def test_a_node_of_ours_is_not_added_again(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    destination = ("--destination-directory", str(tmp_path))
    assert main(["new", "talk", "--node-name", "talker", *PERSON, *destination]) == 0
    before = read(tmp_path / "talk")
    assert add(tmp_path / "talk", "publisher", "talker") == 0
    assert read(tmp_path / "talk") == before
    assert "nothing was changed" in capsys.readouterr().out


# -- the linters of ament


@pytest.mark.parametrize(("files", "directory"), [(CMAKE, "scripts"), (PYTHON, "demo")])
def test_ament_accepts_a_launch_file(
    files: Mapping[str, str], directory: str, tmp_path: Path
) -> None:
    demo = write(tmp_path / "demo", with_nodes(files, directory, "first=eye", "other=eye", "x=ear"))
    write(demo, {"config/ear.yaml": "ear:\n  ros__parameters:\n    gain: 2.0\n"})
    assert add(demo, "launch") == 0
    assert "config / 'ear.yaml'" in launched(demo)
    for lint in (oracles.ament_flake8, oracles.ament_pep257):
        assert not [finding for finding in lint(demo) if finding.path.startswith("launch")]


@pytest.mark.parametrize("build_type", ["ament_cmake", "ament_python"])
def test_ament_accepts_what_was_added_to_ours(build_type: str, tmp_path: Path) -> None:
    words = ["new", "demo", *PERSON, "--build-type", build_type, "--add", "publisher:talker"]
    assert main([*words, "--destination-directory", str(tmp_path)]) == 0
    demo = tmp_path / "demo"
    (demo / "README.md").write_text((demo / "README.md").read_text().replace("Jazzy", "Kilted"))
    (demo / "package.xml").write_text((demo / "package.xml").read_text() + "<!-- mine -->\n")
    for extra in EXTRAS:
        assert add(demo, extra) == 0
    assert add(demo, "service_client", "asker") == 0
    assert main(["check", str(demo)]) == 0
    assert oracles.ament_flake8(demo) | oracles.ament_pep257(demo) == set()


# -- colcon


@pytest.mark.build
@needs_ros
def test_colcon_builds_and_tests_what_was_added(tmp_path: Path) -> None:
    made = Workspace(tmp_path, environment.select(os.environ))
    for name, files in (("cmake_demo", CMAKE), ("python_demo", PYTHON)):
        renamed = {
            path.replace("demo", name): text.replace("demo", name) for path, text in files.items()
        }
        directory = write(tmp_path / "src" / name, renamed)
        assert add(directory, "publisher", "talker", "--topic", f"{name}/talk") == 0
        write(directory, {"config/talker.yaml": "talker:\n  ros__parameters:\n    rate: 20.0\n"})
        assert add(directory, "launch") == 0
    assert add(tmp_path / "src" / "cmake_demo", "cpp_program", "two") == 0
    done = made.colcon("build")
    assert done.returncode == 0, done.stdout + done.stderr
    assert "stderr" not in done.stderr
    installed = tmp_path / "install"
    assert set(os.listdir(installed / "cmake_demo" / "lib" / "cmake_demo")) == {
        "hello.py",
        "talker.py",
        "two",
    }
    assert set(os.listdir(installed / "python_demo" / "lib" / "python_demo")) == {
        "hello",
        "talker",
    }
    for name in ("cmake_demo", "python_demo"):
        share = installed / name / "share" / name
        assert (share / "launch" / f"{name}.launch.py").exists()
        assert (share / "config" / "talker.yaml").exists()
    done = made.colcon("test", "--return-code-on-test-failure")
    assert done.returncode == 0, done.stdout + done.stderr
    build = tmp_path / "build"
    assert counts(build / "python_demo" / "pytest.xml") == (4, 0)
    results = build / "cmake_demo" / "test_results" / "cmake_demo"
    assert {file.name.partition(".")[0]: counts(file) for file in results.iterdir()} == {
        "test_talker": (4, 0),
        "two_runs": (1, 0),
    }


def test_the_licence_of_the_repository_is_seen(
    demo: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """What is added in memory still stands where the package does."""
    (demo / "LICENSE").unlink(missing_ok=True)
    (demo.parent / "LICENSE").touch()
    assert add(demo, "subscriber", "listener", "--diff") == 0
    assert "LICENSE" not in capsys.readouterr().err
