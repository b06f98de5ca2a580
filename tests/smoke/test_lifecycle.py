"""Managed nodes: taken through their states and observed while active."""

from __future__ import annotations

import json
import subprocess
from typing import Any

import jsonschema
import pytest

from scaffold.smoke.lifecycle import problems
from scaffold.smoke.reports.schema import schema
from scaffold.smoke.result import Transition
from scaffold.smoke.scenario.model import TRANSITIONS, Scenario
from tests.smoke.smoke_packages import python_package
from tests.smoke.smoke_runs import NEEDS_ROS, command_line, variables

MANAGED = '''\
"""Publish while active."""

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.lifecycle import LifecycleNode, TransitionCallbackReturn
from std_msgs.msg import String


class Managed(LifecycleNode):
    """Publishes while it is active."""

    def __init__(self):
        """Create nothing yet."""
        super().__init__('{name}')

    def on_configure(self, state):
        """Create the publisher."""
        self.publisher = self.create_lifecycle_publisher(String, '/{name}', 10)
        self.timer = self.create_timer(0.1, self.on_timer)
        return TransitionCallbackReturn.SUCCESS

    def on_activate(self, state):
        """Begin, or fail to."""
        super().on_activate(state)
        return TransitionCallbackReturn.{outcome}

    def on_timer(self):
        """Publish."""
        self.publisher.publish(String(data='active'))


def main(args=None):
    """Run the node until it is interrupted."""
    try:
        rclpy.init(args=args)
        rclpy.spin(Managed())
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        rclpy.try_shutdown()
'''


@pytest.fixture(scope="module")
def executables(tmp_path_factory: pytest.TempPathFactory) -> dict[str, dict[str, Any]]:
    """Run a node that obeys, one that fails to activate, and one that is to stay inactive."""
    root = tmp_path_factory.mktemp("managed")
    modules = {
        "obeys": MANAGED.format(name="obeys", outcome="SUCCESS"),
        "refuses": MANAGED.format(name="refuses", outcome="FAILURE"),
        "waits": MANAGED.format(name="waits", outcome="SUCCESS"),
    }
    package = python_package(root, "managed_py", modules)
    (package / "smoke.yaml").write_text("executables: {waits: {transitions: [configure]}}\n")
    done = subprocess.run(
        command_line(package, "--duration", "2", "--format", "json"),
        env=variables(root),
        capture_output=True,
        text=True,
        check=False,
    )
    data = json.loads(done.stdout)
    jsonschema.validate(data, schema())
    assert data["packages"][0]["build"]["errors"] == []
    return {executable["name"]: executable for executable in data["packages"][0]["executables"]}


def steps(executable: dict[str, Any]) -> list[tuple[str, str, str]]:
    return [(item["name"], item["before"], item["after"]) for item in executable["transitions"]]


@NEEDS_ROS
@pytest.mark.build
def test_managed_node_goes_through_all_states(
    executables: dict[str, dict[str, Any]],
) -> None:
    obeys = executables["obeys"]
    assert obeys["problems"] == []
    assert steps(obeys) == [
        ("configure", "unconfigured", "inactive"),
        ("activate", "inactive", "active"),
        ("deactivate", "active", "inactive"),
        ("cleanup", "inactive", "unconfigured"),
        ("shutdown", "unconfigured", "finalized"),
    ]
    (topic,) = (topic for topic in obeys["topics"] if topic["name"] == "/obeys")
    assert topic["rate_hz"] == pytest.approx(10, rel=0.1)


@NEEDS_ROS
@pytest.mark.build
def test_failed_transition_is_a_problem(executables: dict[str, dict[str, Any]]) -> None:
    refuses = executables["refuses"]
    assert steps(refuses)[1] == ("activate", "inactive", "inactive")
    assert len(refuses["transitions"]) == len(("configure", "activate"))
    (problem,) = refuses["problems"]
    assert problem.startswith("/refuses does not activate from inactive: rejected")


@NEEDS_ROS
@pytest.mark.build
def test_smoke_yaml_sets_the_transitions(executables: dict[str, dict[str, Any]]) -> None:
    assert steps(executables["waits"]) == [("configure", "unconfigured", "inactive")]
    assert executables["waits"]["problems"] == []


def test_transitions_before_and_after_the_observation() -> None:
    assert Scenario().transitions_up == ("configure", "activate")
    assert Scenario().transitions_down == TRANSITIONS[2:]
    assert Scenario(transitions=("configure", "shutdown")).transitions_down == ("shutdown",)
    assert Scenario(transitions=()).transitions_up == ()


def test_unanswered_transition_is_a_problem() -> None:
    failed = Transition("/a", "cleanup", "inactive", "unknown", 1.0, "it does not respond")
    (problem,) = problems([failed, Transition("/a", "activate", "inactive", "active", 0.1)])
    assert problem.message == "/a does not clean up from inactive: it does not respond"
