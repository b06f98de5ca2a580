"""Packages generated for each distribution of ROS 2, and for several at once."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
import yaml

from scaffold import distributions
from scaffold.cli.main import main
from scaffold.distributions import ORDER
from tests.generate.test_generated import BUILD_TYPES, KINDS, write

PUBLISHER = "robot/minimal_publisher.py"
RECORD = ".ros2-scaffold.json"


@pytest.fixture(autouse=True)
def _empty_directory(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.delenv("ROS_DISTRO", raising=False)
    monkeypatch.setenv("SOURCE_DATE_EPOCH", "1700000000")


def new(*arguments: str, package: str = "robot") -> int:
    """Write a package in the current directory."""
    who = ("--maintainer-name", "Ada", "--maintainer-email", "ada@example.com")
    return main(["new", package, *who, *arguments])


def targets() -> object:
    """Return the distributions in the record of the package."""
    return json.loads(Path("robot", RECORD).read_text())["answers"]["distro"]


def checked_for(capsys: pytest.CaptureFixture[str], *arguments: str) -> list[str]:
    """Check the package; return its distributions and the messages of findings."""
    capsys.readouterr()
    main(["check", "robot", "--no-types", "--format", "json", *arguments])
    report = json.loads(capsys.readouterr().out)
    return [*report["summary"]["distributions"], *(it["message"] for it in report["diagnostics"])]


@pytest.mark.parametrize(
    ("distro", "kinds"),
    [
        *((name, KINDS) for name in ORDER if name != "jazzy"),
        (",".join(ORDER), ("lifecycle", "parameters")),
    ],
)
def test_every_kind_of_node_is_clean_on_each_distribution(
    tmp_path: Path, distro: str, kinds: tuple[str, ...], capsys: pytest.CaptureFixture[str]
) -> None:
    build_type = BUILD_TYPES[len(distro) % 2]
    extras = ["ci", "devcontainer", "launch", "launch_test", "types"]
    parts = [{"kind": kind, "name": f"{kind}_node"} for kind in kinds]
    write(tmp_path, package="robot", distro=distro, build_type=build_type, add=parts, extras=extras)

    main(["check", "robot", "--distro", distro, "--format", "json"])
    report = json.loads(capsys.readouterr().out)

    assert report["diagnostics"] == []
    assert report["summary"]["distributions"] == distro.split(",")


@pytest.mark.parametrize("distro", ORDER)
def test_interfaces_and_programs_are_clean_on_each_distribution(
    distro: str, capsys: pytest.CaptureFixture[str]
) -> None:
    parts = ("--add", "message:Speed", "--add", "action:Drive", "--add", "cpp_maps:maps")
    assert new("--distro", distro, *parts) == 0
    assert checked_for(capsys) == [distro]


def test_profiles_define_the_same_template_variables() -> None:
    facts = [{*distributions.named(name).profile["templates"]} for name in ORDER]
    assert all(names == facts[0] for names in facts)


def test_each_distribution_follows_its_own_ros2_pkg_create() -> None:
    written = {}
    for name in ORDER:
        package = f"robot_{name}"
        assert new("--distro", name, "--build-type", "ament_python", package=package) == 0
        node = Path(package, package, "minimal_publisher.py").read_text()
        written[name] = (
            Path(package, package, "py.typed").exists(),
            Path(package, "test", "test_xmllint.py").exists(),
            "with rclpy.init(args=args):" in node,
        )
    assert written == {
        "humble": (False, False, False),
        "jazzy": (False, False, False),
        "kilted": (True, True, True),
        "lyrical": (True, True, True),
    }


def test_nodes_for_several_distributions_use_the_oldest_api() -> None:
    assert new("--distro", "kilted,jazzy") == 0
    assert targets() == ["jazzy", "kilted"]
    assert "rclpy.try_shutdown()" in Path("robot", PUBLISHER).read_text()


def test_ci_runs_on_all_distributions() -> None:
    assert new("--distro", "jazzy,lyrical", "--extras", "ci") == 0
    workflow = Path("robot/.github/workflows/ci.yaml").read_text()
    job = yaml.safe_load(workflow)["jobs"]["test"]
    assert job["strategy"]["matrix"] == {"distro": ["jazzy", "lyrical"]}
    assert job["container"] == "ros:${{ matrix.distro }}"


def test_container_image_defaults_to_the_oldest_distribution() -> None:
    assert new("--distro", "humble,lyrical", "--extras", "dockerfile", "devcontainer") == 0
    dockerfile = Path("robot/Dockerfile").read_text()
    assert (
        "# For another distribution: docker build --build-arg ROS_DISTRO=lyrical .\n" in dockerfile
    )
    assert "\nARG ROS_DISTRO=humble\n" in dockerfile
    assert dockerfile.count("FROM ros:${ROS_DISTRO} AS ") == 2
    container = json.loads(Path("robot/.devcontainer/devcontainer.json").read_text())
    assert container["image"] == "ros:${localEnv:ROS_DISTRO:humble}"
    readme = Path("robot/README.md").read_text()
    assert "`docker build --build-arg ROS_DISTRO=lyrical` builds it for Lyrical" in readme
    assert "`ROS_DISTRO=lyrical code .` opens it with Lyrical" in readme
    for text in (dockerfile, container["postCreateCommand"]):
        assert "humble" not in text.replace("ARG ROS_DISTRO=humble", "")


def test_readme_names_only_the_target_distribution() -> None:
    assert new("--extras", "dockerfile", "devcontainer") == 0
    readme = Path("robot/README.md").read_text()
    assert "ROS_DISTRO" not in readme
    assert "\n\n\n" not in readme
    container = json.loads(Path("robot/.devcontainer/devcontainer.json").read_text())
    assert container["image"] == "ros:jazzy"


@pytest.mark.parametrize(
    ("variables", "configuration", "flags", "expected"),
    [
        ({}, "", [], ["jazzy"]),
        ({"ROS_DISTRO": "humble"}, "", [], ["humble"]),
        ({"ROS_DISTRO": "iron"}, "", [], ["jazzy"]),
        ({"ROS_DISTRO": "humble"}, '[check]\ndistribution = "kilted"\n', [], ["kilted"]),
        ({}, '[check]\ndistribution = "kilted"\n', ["--distro", "lyrical"], ["lyrical"]),
        ({}, '[new]\ndistro = ["kilted", "jazzy"]\n', [], ["jazzy", "kilted"]),
        (
            {},
            "",
            ["--distro", "lyrical,kilted", "--distro", "jazzy"],
            ["jazzy", "kilted", "lyrical"],
        ),
    ],
)
def test_distribution_comes_from_flag_configuration_or_shell(
    variables: dict[str, str],
    configuration: str,
    flags: list[str],
    expected: list[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    for name, value in variables.items():
        monkeypatch.setenv(name, value)
    Path("ros2-scaffold.toml").write_text(configuration)
    assert new(*flags) == 0
    assert targets() == expected


@pytest.mark.parametrize(
    ("shell", "flags", "expected"),
    [
        ("jazzy", [], ""),
        ("humble", ["--distro", "jazzy"], ""),
        (
            "humble",
            [],
            "note: created for Humble, as ROS_DISTRO is 'humble'; use --distro NAMES ",
        ),
        (
            "iron",
            [],
            "note: created for Jazzy, although ROS_DISTRO is 'iron', which has reached its end of ",
        ),
    ],
)
def test_distribution_taken_from_the_shell_is_noted(
    shell: str,
    flags: list[str],
    expected: str,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.setenv("ROS_DISTRO", shell)
    assert new(*flags) == 0
    written = capsys.readouterr().err
    assert expected in written
    assert ("created for" in written) == bool(expected)


def test_unknown_distribution_is_rejected_with_a_suggestion(
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert new("--distro", "jazy") == 2
    assert "no distribution 'jazy'; did you mean 'jazzy'?" in capsys.readouterr().err


def test_incompatible_distributions_are_rejected_with_the_line(
    capsys: pytest.CaptureFixture[str],
) -> None:
    type_ = "lifecycle_msgs/msg/TransitionEvent"
    assert new("--distro", "jazzy,lyrical", "--message-type", type_) == 2
    message = capsys.readouterr().err
    assert "no code works for both Jazzy and Lyrical: line " in message
    assert not Path("robot").exists()


def test_message_types_depend_on_the_distribution(capsys: pytest.CaptureFixture[str]) -> None:
    pose = ("--message-type", "geometry_msgs/msg/Pose2D")
    assert new("--distro", "lyrical", *pose) == 2
    assert "Pose2D" in capsys.readouterr().err
    assert new("--distro", "jazzy", *pose) == 0


def test_add_uses_the_distribution_of_the_record(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    assert new("--distro", "kilted") == 0
    monkeypatch.setenv("ROS_DISTRO", "humble")
    order = ["add", "subscriber", "listener", "--package-directory", "robot"]
    assert main([*order, "--distro", "jazzy"]) == 2
    assert "the package is for Kilted; `ros2-scaffold update" in capsys.readouterr().err
    assert main(order) == 0
    assert "with rclpy.init(args=args):" in Path("robot/robot/listener.py").read_text()
    assert checked_for(capsys) == ["kilted"]


def test_update_moves_a_package_to_another_distribution(
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert new("--build-type", "ament_python") == 0
    own = Path("robot", PUBLISHER)
    own.write_text(own.read_text().replace("import signal", "import signal  # mine"))
    assert main(["update", "robot", "--distro", "lyrical"]) == 0
    assert "The package is now for Lyrical." in capsys.readouterr().out
    assert targets() == ["lyrical"]
    assert "import signal  # mine" in own.read_text()
    assert "with rclpy.init(args=args):" in own.read_text()
    assert Path("robot/test/test_xmllint.py").exists()
    own.write_text(own.read_text().replace("  # mine", ""))
    assert checked_for(capsys) == ["lyrical"]

    assert main(["update", "robot"]) == 0
    assert "up to date" in capsys.readouterr().out
    assert targets() == ["lyrical"]


def test_check_uses_the_distribution_of_the_record_by_default(
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert new("--distro", "kilted") == 0
    assert checked_for(capsys) == ["kilted"]
    assert "not a context manager on Jazzy" in checked_for(capsys, "--distro", "jazzy")[1]
    Path("ros2-scaffold.toml").write_text('[check]\ndistribution = "lyrical"\n')
    assert checked_for(capsys) == ["lyrical"]


def test_changed_record_invalidates_the_cache(
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert new() == 0
    assert checked_for(capsys) == ["jazzy"]
    record = Path("robot", RECORD)
    record.write_text(record.read_text().replace('["jazzy"]', '["humble"]'))
    assert checked_for(capsys) == ["humble"]


def test_record_without_distributions_means_the_default(
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert new() == 0
    record = Path("robot", RECORD)
    record.write_text(record.read_text().replace('    "distro": ["jazzy"],\n', ""))
    assert checked_for(capsys) == ["jazzy"]
    assert main(["update", "robot"]) == 0
    assert "up to date" in capsys.readouterr().out


def test_each_package_is_checked_for_its_own_distribution(
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert new("--distro", "kilted") == 0
    assert new(package="other") == 0
    capsys.readouterr()
    assert main(["check", ".", "--no-types"]) == 0
    assert "2 packages, 24 files for Jazzy and Kilted: no findings" in capsys.readouterr().out
    assert main(["check", ".", "--fix"]) == 2
    assert (
        "the packages are for Jazzy and Kilted, which differ between them"
        in capsys.readouterr().err
    )
