"""Conventions for message types: the table is consistent, and nodes follow it."""

from __future__ import annotations

import pytest

from scaffold.generate import payload
from scaffold.generate.payload import conventions, effects, processing
from scaffold.generate.questions import names
from scaffold.generate.questions.qos import qos

TYPES = sorted({full_name for full_name, _ in conventions.table()})


@pytest.mark.parametrize("full_name", TYPES)
def test_each_row_of_the_table_is_valid(full_name: str) -> None:
    assert payload.payload(full_name).type == full_name
    for (name, topic), row in conventions.table().items():
        if name == full_name:
            assert names.topic(row.topic) == row.topic
            assert topic in {"", row.topic}
            offered, requested = qos(row.offered), qos(row.requested)
            assert (offered.reliability, requested.reliability) != ("best_effort", "reliable")
            assert (offered.durability, requested.durability) != ("volatile", "transient_local")


@pytest.mark.parametrize(
    ("full_name", "topic", "usual"),
    [
        ("sensor_msgs/msg/LaserScan", "scan", ("10", "sensor_data", 10.0)),
        ("nav_msgs/msg/OccupancyGrid", "map", ("latched", "latched", 1.0)),
        ("std_msgs/msg/String", "example_topic", ("10", "10", 2.0)),
        ("std_msgs/msg/String", "/robot_description", ("latched", "latched", 1.0)),
        ("geometry_msgs/msg/InertiaStamped", "inertia_stamped", ("10", "10", 2.0)),
    ],
)
def test_conventions_of_a_topic(full_name: str, topic: str, usual: tuple[str, str, float]) -> None:
    row = conventions.of_topic(full_name, topic)
    assert (row.offered, row.requested, row.rate) == usual
    assert row.topic == topic.strip("/")


def test_services_and_actions_are_named_after_their_type() -> None:
    assert payload.service("std_srvs/srv/SetBool").usual_name == "set_bool"
    assert payload.action("example_interfaces/action/Fibonacci").usual_name == "fibonacci"


def test_goal_of_the_readme_command_is_accepted() -> None:
    action = payload.action("example_interfaces/action/Fibonacci")
    assert action.goal.example == "{order: 10}"
    assert "goal.order" in action.refused


@pytest.mark.parametrize(("received", "published"), sorted(processing.PROCESSES))
def test_generated_processing_code_compiles(received: str, published: str) -> None:
    process = payload.payload(received).processed(payload.payload(published))
    assert process is not None
    compile("\n".join([*process.constants, *process.lines]), received, "exec")
    compile(process.expected, received, "eval")
    assert "item" in process.check
    assert "message" in process.check


def test_effects_of_statements_are_the_checks_of_a_test() -> None:
    lines = [
        "msg.header.stamp = self.get_clock().now().to_msg()",
        "msg.header.frame_id = self.frame_id",
        "msg.height = 1",
        "msg.is_empty = False",
        "msg.status = Status.OK",
        "msg.width = WIDTH",
        "angle = self.count / 10.0",
        "msg.point.x = math.cos(angle)",
        "for index in range(3):",
        "    msg.points.append(index * angle)",
        "seconds = msg.header.stamp.sec",
        "msg.covariance[::4] = 0.01",
        "msg.time = seconds",
    ]
    assert effects.of_statements(lines, "msg") == effects.Effects(
        constant=(("height", "1"),),
        changing=("header.stamp", "point.x", "points", "time"),
        filled=("width", "covariance"),
        frames=("header.frame_id",),
    )
