"""Extras of a package: launch file, CI, pre-commit, container, .gitignore and others."""

from __future__ import annotations

import json
import re
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
import yaml
from lxml import etree

from scaffold.check.rules import registry
from scaffold.check.selection import Selection
from scaffold.check.session import Session
from scaffold.cli.main import main
from scaffold.configuration import content
from scaffold.diagnostic import Diagnostic
from scaffold.errors import InputError
from scaffold.generate import checking, draft
from scaffold.generate.questions.defaults import User
from scaffold.generate.questions.questions import Given
from scaffold.generate.templates import licenses, loading, template
from scaffold.generate.templates.template import Role
from scaffold.model.package import Package
from tests import oracles

ROOTS = content.roots("templates")
TEMPLATES = loading.load(ROOTS)
EXTRAS = template.of_role(TEMPLATES, Role.EXTRA)
BUILD_TYPES = template.of_role(TEMPLATES, Role.BUILD_TYPE)


def make(**answers: object) -> dict[str, str]:
    """Return the files of a package that passes every rule."""
    given = {"maintainer_name": "Ada", "maintainer_email": "ada@example.com", **answers}
    asked = {name: Given(value, f"--{name}") for name, value in given.items()}
    made = draft.draft(ROOTS, TEMPLATES, asked, User("."))
    assert checking.defects(made, registry.load(content.roots("rules"))) == []
    return dict(made.rendered.files)


@pytest.mark.parametrize("build_type", BUILD_TYPES)
@pytest.mark.parametrize("comments", ["brief", "tutorial"])
def test_all_extras_in_one_package(build_type: str, comments: str) -> None:
    files = make(package="talker", build_type=build_type, comments=comments, extras=list(EXTRAS))
    assert {
        ".devcontainer/devcontainer.json",
        ".github/workflows/ci.yaml",
        ".gitignore",
        ".pre-commit-config.yaml",
        "config/talker.yaml",
        "launch/talker.launch.py",
    } < set(files)


def test_launch_file_starts_every_node_with_its_parameters() -> None:
    files = make(
        package="conversation",
        extras="launch",
        add=["publisher:talker", {"kind": "publisher", "name": "announcer", "topic": "on"}],
        rate=5,
    )
    launched = [line.strip() for line in files["launch/conversation.launch.py"].split("\n")]
    assert [line for line in launched if line.startswith("executable=")] == [
        "executable='talker.py',",
        "executable='announcer.py',",
    ]
    assert launched.count("LaunchConfiguration('params_file'),") == 2
    for argument in ("namespace", "use_sim_time", "params_file", "log_level"):
        assert [line for line in launched if line.startswith(f"'{argument}',")]
    parameters: Any = yaml.safe_load(files["config/conversation.yaml"])
    assert parameters == {
        "/**/talker": {"ros__parameters": {"rate": 5.0}},
        "/**/announcer": {"ros__parameters": {"rate": 5.0}},
    }
    for kind in ("ament_index_python", "launch", "launch_ros"):
        assert f"<exec_depend>{kind}</exec_depend>" in files["package.xml"]
    assert "ros2 launch conversation conversation.launch.py" in files["README.md"]
    assert "    config\n    launch\n  DESTINATION share/${PROJECT_NAME}" in files["CMakeLists.txt"]


def test_launch_file_configures_and_activates_managed_nodes() -> None:
    files = make(package="robot", extras="launch", add=["lifecycle:laser", "timer:clock"])
    text = files["launch/robot.launch.py"]
    _, managed, other = re.split(r"(?:Lifecycle)?Node\(\n", text)
    assert "name='laser',\n" in managed
    assert "autostart=True," in managed
    assert "autostart" not in other
    assert "namespace=LaunchConfiguration('namespace')," in managed


def test_node_with_a_lifecycle_manager_is_not_autostarted() -> None:
    files = make(
        package="robot",
        extras="launch",
        add=["lifecycle:laser", "lifecycle_manager:manager managed_node=laser"],
    )
    assert "LifecycleNode(" in files["launch/robot.launch.py"]
    assert "autostart=" not in files["launch/robot.launch.py"]
    assert "node_names: ['laser']" in files["config/robot.yaml"]


def test_lifecycle_manager_manages_all_managed_nodes() -> None:
    parts = ["lifecycle:laser", "lifecycle:camera"]
    files = make(package="robot", extras="launch", add=[*parts, "lifecycle_manager:manager"])
    assert "autostart=" not in files["launch/robot.launch.py"]
    assert "node_names: ['laser', 'camera']" in files["config/robot.yaml"]
    default = re.search(r"\[\n +'laser',\n +'camera',\n +\]", files["robot/manager.py"])
    assert default is not None
    assert "| `[laser, camera]` |" in files["README.md"]
    assert "minimal_lifecycle" not in files["README.md"]
    only_one = "lifecycle_manager:manager managed_node=laser"
    files = make(package="robot", extras="launch", add=[*parts, only_one])
    _, laser, camera, _ = re.split(r"(?:Lifecycle)?Node\(\n", files["launch/robot.launch.py"])
    assert ("autostart=" in laser, "autostart=" in camera) == (False, True)
    assert "node_names: ['laser']" in files["config/robot.yaml"]


@pytest.mark.parametrize("kind", ["publisher", "timer", "service_client", "action_server"])
@pytest.mark.parametrize("rate", ["10.0", "2.0"])
def test_rate_in_readme_example_differs_from_the_default(kind: str, rate: str) -> None:
    readme = make(package="robot", add=[f"{kind}:worker rate={rate}"])["README.md"]
    (other,) = re.findall(r"-p rate:=(\S+)", readme)
    assert float(other) != float(rate)


def test_long_names_fit_on_their_lines() -> None:
    for build_type in BUILD_TYPES:
        for comments in ("brief", "tutorial"):
            make(
                package="p" * 48,
                build_type=build_type,
                comments=comments,
                extras=list(EXTRAS),
                node_name="n" * 48,
            )


def test_launch_extra_writes_nothing_without_nodes() -> None:
    files = make(package="tools", extras=["launch"], add=["cpp_program:tool"])
    assert not [path for path in files if path.startswith(("launch", "config"))]
    assert "ros2 launch" not in files["README.md"]


def test_workflow_builds_and_tests_the_package() -> None:
    workflow: Any = yaml.safe_load(make(package="talker", extras="ci")[".github/workflows/ci.yaml"])
    job = workflow["jobs"]["test"]
    commands = "\n".join(step.get("run", "") for step in job["steps"])
    assert job["steps"][0]["with"]["path"] == "src/talker"
    for command in ("rosdep install", "colcon build", "--return-code-on-test-failure"):
        assert command in commands


def test_pre_commit_accepts_its_configuration(tmp_path: Path) -> None:
    path = tmp_path / ".pre-commit-config.yaml"
    path.write_text(make(package="talker", extras="pre_commit")[path.name])
    command = [sys.executable, "-m", "pre_commit", "validate-config", str(path)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr


def test_container_has_the_package_in_a_workspace() -> None:
    files = make(package="talker", extras="devcontainer")
    container = json.loads(files[".devcontainer/devcontainer.json"])
    assert container["workspaceFolder"] == "/ros2_ws/src/talker"


def test_gitignore_ignores_build_products(tmp_path: Path) -> None:
    (tmp_path / ".gitignore").write_text(make(package="talker", extras="gitignore")[".gitignore"])
    subprocess.run(["git", "init", "-q", str(tmp_path)], check=True)
    paths = ["build/x", "install/x", "log/x", "talker/__pycache__/a.pyc", "talker/talker.py"]
    done = subprocess.run(
        ["git", "-C", str(tmp_path), "check-ignore", *paths],
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.stdout.split() == paths[:-1]


def test_dockerfile_has_no_tutorial_markers() -> None:
    for comments in ("brief", "tutorial"):
        dockerfile = make(package="robot", extras="dockerfile", comments=comments)["Dockerfile"]
        assert "#:" not in dockerfile
        assert "# For another distribution: docker build" in dockerfile


def test_extras_may_be_separated_by_commas() -> None:
    files = make(package="talker", extras=["ci,pre_commit", "gitignore"])
    assert files == make(package="talker", extras=["ci", "pre_commit", "gitignore"])


def test_unknown_extra_is_rejected() -> None:
    with pytest.raises(InputError, match=r"--extras: 'lunch' is not one of .*did you mean launch"):
        make(package="talker", extras=["lunch"])


def write(directory: Path, files: dict[str, str]) -> Path:
    """Write a package that is a git repository of its own."""
    for path, text in files.items():
        (directory / path).parent.mkdir(parents=True, exist_ok=True)
        (directory / path).write_text(text)
    subprocess.run(["git", "init", "-q", str(directory)], check=True)
    return directory


@oracles.needs_system_linter("ament_copyright")
@pytest.mark.parametrize("license_", licenses.names(ROOTS))
def test_ament_copyright_accepts_a_package_that_is_a_repository(
    license_: str, tmp_path: Path
) -> None:
    files = make(package="talker", extras=["ci"], license=license_)
    talker = write(tmp_path / "talker", files)
    assert oracles.ament_copyright(talker) == set()
    assert [finding.code for finding in check(talker) if finding.code == "LY022"] == []
    (talker / "CONTRIBUTING.md").unlink()
    assert {finding.path for finding in oracles.ament_copyright(talker)} == {"CONTRIBUTING.md"}
    assert [finding.code for finding in check(talker) if finding.code == "LY022"] == ["LY022"]


@oracles.needs_system_linter("ament_copyright")
@pytest.mark.parametrize("license_", licenses.names(ROOTS))
def test_check_fix_adds_files_required_in_a_repository(license_: str, tmp_path: Path) -> None:
    talker = write(tmp_path / "talker", make(package="talker", license=license_))
    assert {finding.path for finding in oracles.ament_copyright(talker)} == {"CONTRIBUTING.md"}
    assert main(["check", "--fix", str(talker)]) == 0
    assert oracles.ament_copyright(talker) == set()


@pytest.mark.parametrize("extra", ["ci", "pre_commit", "devcontainer"])
def test_add_writes_files_required_in_a_repository(extra: str, tmp_path: Path) -> None:
    person = ["--maintainer-name", "Ada", "--maintainer-email", "ada@example.com"]
    assert main(["new", "talker", *person, "--destination-directory", str(tmp_path)]) == 0
    talker = write(tmp_path / "talker", {})
    command = ["add", extra, "--package-directory", str(talker)]
    assert main(command) == 0
    assert check(talker) == []
    (talker / "CONTRIBUTING.md").write_text("Please do.\n")
    assert main(command) == 0
    assert (talker / "CONTRIBUTING.md").read_text() == "Please do.\n"


def check(directory: Path) -> list[Diagnostic]:
    """Return the output of `check` for a package."""
    session = Session(registry.load(content.roots("rules")), Selection())
    return session.check(Package.at(str(directory)))


@pytest.mark.parametrize("build_type", BUILD_TYPES)
def test_type_checker_settings_find_the_stubs(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, build_type: str
) -> None:
    for path, text in make(package="talker", build_type=build_type, extras="types").items():
        (tmp_path / path).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / path).write_text(text)
    monkeypatch.chdir(tmp_path)
    assert main(["stubs"]) == 0
    node = tmp_path / "talker" / "minimal_publisher.py"
    correct = node.read_text()
    for checker, arguments in (("mypy", ["talker"]), ("basedpyright", ["--level=error"])):
        command = [sys.executable, "-m", checker, *arguments]
        for text, code in ((correct, 0), (correct.replace("msg.data", "msg.text"), 1)):
            node.write_text(text)
            done = subprocess.run(command, capture_output=True, text=True, check=False)
            assert done.returncode == code, done.stdout


@pytest.mark.parametrize("build_type", BUILD_TYPES)
def test_description_extra_gives_a_robot_description_package(build_type: str) -> None:
    files = make(package="rover_description", build_type=build_type, extras="description")
    programs = {path for path in files if path.startswith("rover_description/")}
    assert programs <= {"rover_description/__init__.py"}
    assert {"launch/description.launch.py", "rviz/robot.rviz"} < set(files)
    urdf = etree.fromstring(files["urdf/robot.urdf.xacro"].encode())
    assert urdf.get("name") == "rover"


def test_description_with_launch_extra_has_a_node() -> None:
    files = make(package="rover", extras=["description", "launch"])
    assert {"rover/minimal_publisher.py", "launch/rover.launch.py"} < set(files)


@pytest.mark.parametrize("build_type", BUILD_TYPES)
def test_description_extra_can_be_added(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, build_type: str
) -> None:
    new = ["new", "rover", "--build-type", build_type, "--maintainer-name", "Ada"]
    assert main([*new, "--destination-directory", str(tmp_path)]) == 0
    monkeypatch.chdir(tmp_path / "rover")
    assert main(["add", "description"]) == 0
    assert check(tmp_path / "rover") == []
    if build_type == "ament_cmake":
        cmake = (tmp_path / "rover" / "CMakeLists.txt").read_text()
        assert "ament_add_pytest_test(test_description test/test_description.py" in cmake
        assert " urdf" in cmake
    before = {path: path.read_bytes() for path in tmp_path.rglob("*") if path.is_file()}
    assert main(["add", "description"]) == 0
    assert {path: path.read_bytes() for path in tmp_path.rglob("*") if path.is_file()} == before


@pytest.mark.parametrize("build_type", BUILD_TYPES)
@pytest.mark.parametrize("extras", [["launch_test"], ["launch", "launch_test"]])
def test_launch_test_starts_all_nodes(build_type: str, extras: list[str]) -> None:
    add = ["publisher:talker", "subscriber:listener"]
    files = make(package="duo", build_type=build_type, add=add, extras=extras)
    text = files["test/test_launch.py"]
    assert "NODES = {\n    'talker',\n    'listener',\n}\n" in text
    assert ("'launch', 'duo.launch.py'" in text) is ("launch" in extras)
    assert ("executable='" in text) is ("launch" not in extras)
    if build_type == "ament_cmake":
        assert "ament_add_pytest_test(test_launch test/test_launch.py" in files["CMakeLists.txt"]
    assert "<test_depend>launch_testing_ros</test_depend>" in files["package.xml"]


def test_launch_test_can_be_added(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    new = ["new", "rover", "--maintainer-name", "Ada", "--node-name", "wheels"]
    assert main([*new, "--destination-directory", str(tmp_path)]) == 0
    monkeypatch.chdir(tmp_path / "rover")
    assert main(["add", "launch_test"]) == 0
    assert check(tmp_path / "rover") == []
    assert "'wheels'," in (tmp_path / "rover" / "test" / "test_launch.py").read_text()
