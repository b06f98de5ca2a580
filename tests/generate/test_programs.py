"""C++ programs next to Python nodes: they build, pass the linters and run."""

from __future__ import annotations

import os
import shutil
import subprocess
from importlib.util import find_spec
from pathlib import Path

import pytest
from lxml import etree

from scaffold.check.rules import registry
from scaffold.configuration import content
from scaffold.errors import InputError
from scaffold.generate import checking, draft
from scaffold.generate.questions.defaults import User
from scaffold.generate.questions.questions import Given
from scaffold.generate.templates import loading, template
from scaffold.generate.templates.template import Role
from scaffold.smoke import environment
from scaffold.writing.plan import WritePlan
from tests import oracles
from tests.oracles import needs_system_linter

ROOTS = content.roots("templates")
TEMPLATES = loading.load(ROOTS)
PROGRAMS = template.of_role(TEMPLATES, Role.PROGRAM)
NAMES = [item.default for name in PROGRAMS for item in TEMPLATES[name].questions]
PACKAGE = "cpp_tutorial"

EXPECTED = {
    "sensor_data_handling": "read 6.8 m, average 5.66667 m\n",
    "iterator_example": "nearest: 1.8 m, beam 2\n",
    "container_example": "actions: drive scan grasp return\n",
    "set_example": "4 landmarks: 10 20 30 40\ngrasp: 1 times\nmove: 3 times\nscan: 1 times\n",
    "map_example": "no sensor for wind\nthe arm has to grasp\nthe arm has to place\n",
    "stack_queue_example": "drive to the table\nback to the kitchen\nback to the corridor\n",
    "robotic_tasks_priority_queue": (
        "stop at once (priority 3)\ndrive to the charger (priority 2)\ndock (priority 2)\n"
        "send the log (priority 1)\n"
    ),
    "cpp_program": "Hello from cpp_program\n",
}
"""Something that each program must print."""


def write(destination: Path, **answers: object) -> Path:
    """Write a package as `new` does; return its directory."""
    given = {"package": PACKAGE, "maintainer_name": "Ada", "maintainer_email": "ada@example.com"}
    asked = {name: Given(value, name) for name, value in {**given, **answers}.items()}
    made = draft.draft(ROOTS, TEMPLATES, asked, User(str(destination)))
    assert checking.defects(made, registry.load(content.roots("rules"))) == []
    plan = WritePlan.of(destination / made.name, made.rendered.files)
    plan.write()
    return destination / made.name


@pytest.fixture(scope="module")
def package(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Write a package with every program and a Python node."""
    source = tmp_path_factory.mktemp("ws") / "src"
    return write(source, add=[*PROGRAMS, "publisher:talker"], comments="tutorial")


@pytest.mark.parametrize(
    "linter",
    [
        pytest.param(name, marks=needs_system_linter(name))
        for name in ("ament_cpplint", "ament_uncrustify", "ament_copyright", "ament_lint_cmake")
    ],
)
@pytest.mark.parametrize("comments", ["brief", "tutorial"])
def test_ament_linters_accept_programs(linter: str, comments: str, tmp_path: Path) -> None:
    directory = write(tmp_path, add=list(PROGRAMS), comments=comments)
    variables = oracles.system_environment()
    program = shutil.which(linter, path=variables["PATH"])
    assert program is not None, f"{linter} is not installed"
    done = subprocess.run(
        [program, str(directory)], env=variables, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stdout + done.stderr


@pytest.mark.build
@pytest.mark.skipif(
    find_spec("rclpy") is None and not Path("/opt/ros").exists(),
    reason="no ROS 2: install the extra 'ros' of this project",
)
@pytest.mark.skipif(shutil.which("c++") is None, reason="no C++ compiler")
@needs_system_linter("ament_lint_auto")
def test_programs_build_run_and_pass_their_tests(package: Path) -> None:
    root = package.parent.parent
    ros = environment.select(os.environ)

    def colcon(*arguments: str) -> None:
        done = subprocess.run(
            [ros.colcon, *arguments],
            cwd=root,
            env=dict(ros.variables),
            capture_output=True,
            text=True,
            check=False,
        )
        assert done.returncode == 0, done.stdout + done.stderr

    colcon("build")
    log = root / "log" / "latest_build" / PACKAGE / "stderr.log"
    assert log.read_text() == ""
    assert sorted(EXPECTED) == sorted(NAMES)
    for name, lines in EXPECTED.items():
        program = root / "install" / PACKAGE / "lib" / PACKAGE / name
        done = subprocess.run([program], capture_output=True, text=True, check=True)
        assert lines in done.stdout
    colcon("test", "--ctest-args", "-R", "_runs$", "--return-code-on-test-failure")
    reports = list((root / "build" / PACKAGE / "test_results").rglob("*_runs.xml"))
    assert len(reports) == len(NAMES)
    for report in reports:
        suite = etree.parse(report).getroot()
        assert (suite.get("tests"), suite.get("failures"), suite.get("errors")) == ("1", "0", "0")


def test_programs_require_ament_cmake(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="cpp_deque needs the build type ament_cmake, not"):
        write(tmp_path, add="cpp_deque:buffer", build_type="ament_python")
