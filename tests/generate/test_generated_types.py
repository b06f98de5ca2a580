"""Generated packages pass type checkers that use the stubs of `ros2-scaffold stubs`."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from scaffold.cli.main import main
from tests.generate.test_generated import KINDS, TEMPLATES, missing_libraries, write

TYPED_KINDS = [
    kind
    for kind in KINDS
    if "python3-serial" not in TEMPLATES[kind].depends["exec"]
    and not any(name.startswith("python3-") for name in missing_libraries(kind))
]
"""All but those whose libraries come from elsewhere than ROS, and have no types here."""

CHECKERS = {
    "mypy": ["--no-error-summary"],
    "basedpyright": ["--outputjson"],
    "ty": [
        "check",
        *("--output-format=concise", "--exclude=typings", "--extra-search-path=typings"),
    ],
}
"""What checks all files of the package in the working directory, by its module."""


@pytest.fixture(scope="module")
def package(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Write a package with a node of every kind, and the stubs of its imports."""
    root = tmp_path_factory.mktemp("typed")
    parts: list[object] = [
        *({"kind": kind, "name": f"{kind}_node"} for kind in TYPED_KINDS),
        {"kind": "publisher", "name": "laser", "message_type": "sensor_msgs/msg/LaserScan"},
        {"kind": "lifecycle", "name": "camera", "message_type": "sensor_msgs/msg/Image"},
        {
            "kind": "publisher_subscriber",
            "name": "planner",
            "input_type": "nav_msgs/msg/Odometry",
            "message_type": "nav_msgs/msg/Path",
        },
        {
            "kind": "action_client",
            "name": "driver",
            "action_type": "nav2_msgs/action/NavigateToPose",
        },
        {
            "kind": "action_server",
            "name": "arm",
            "action_type": "control_msgs/action/FollowJointTrajectory",
        },
    ]
    directory = write(
        root,
        package="typed_package",
        add=parts,
        extras=["bag_test", "description", "launch", "launch_test", "types"],
    )
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(directory)
        patch.delenv("AMENT_PREFIX_PATH", raising=False)
        assert main(["stubs"]) == 0
    return directory


@pytest.mark.parametrize("version", ["3.10", "3.12"])
@pytest.mark.parametrize("checker", CHECKERS)
def test_every_kind_of_node_passes_type_checkers(
    package: Path, checker: str, version: str, tmp_path: Path
) -> None:
    arguments = list(CHECKERS[checker])
    if checker == "basedpyright":
        settings = json.loads((package / "pyrightconfig.json").read_text())
        settings |= {"pythonVersion": version, "typeCheckingMode": "standard"}
        (package / "settings.json").write_text(json.dumps(settings))
        arguments.append("--project=settings.json")
    else:
        arguments.append(f"--python-version={version}")
    done = subprocess.run(
        [sys.executable, "-m", checker, *arguments, *(["."] if checker != "basedpyright" else [])],
        cwd=package,
        env={**os.environ, "MYPY_CACHE_DIR": str(tmp_path)},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stdout + done.stderr


def test_nodes_pass_strict_mypy(package: Path, tmp_path: Path) -> None:
    done = subprocess.run(
        [sys.executable, "-m", "mypy", "--strict", "--no-error-summary", package.name],
        cwd=package,
        env={**os.environ, "MYPY_CACHE_DIR": str(tmp_path)},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stdout + done.stderr
