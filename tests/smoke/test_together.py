"""``smoke --together``: nodes of a package in one domain, and why they do not connect."""

from __future__ import annotations

import json
import subprocess
from pathlib import Path
from typing import Any

import pytest

from scaffold.smoke.result import Endpoint, Observation, Topic
from scaffold.smoke.together import connections
from tests.smoke.smoke_packages import IGNORES_SIGINT, ONCE, PARENT, python_package, talker
from tests.smoke.smoke_runs import NEEDS_ROS, command_line, processes_of, variables

STRING = "std_msgs/msg/String"


def qos(**changes: object) -> dict[str, Any]:
    return {
        "reliability": "reliable", "durability": "volatile", "history": "unknown", "depth": 0,
        "deadline": None, "lifespan": None, "liveliness": "automatic", **changes,
    }  # fmt: skip


def topic(name: str, *endpoints: Endpoint) -> Topic:
    kinds = [endpoint.kind for endpoint in endpoints]
    return Topic(
        name,
        endpoints[0].type,
        kinds.count("publisher"),
        kinds.count("subscription"),
        endpoints=endpoints,
    )


def publisher(kind: str = STRING, **changes: object) -> Endpoint:
    return Endpoint("publisher", "/talker", kind, qos(**changes))


def subscription(kind: str = STRING, **changes: object) -> Endpoint:
    return Endpoint("subscription", "/listener", kind, qos(**changes))


@pytest.mark.parametrize(
    ("offered", "wanted", "reason"),
    [
        (publisher(), subscription(), None),
        (publisher(), subscription(reliability="best_effort"), None),
        (publisher(durability="transient_local"), subscription(), None),
        (publisher(deadline=1.0), subscription(deadline=2.0), None),
        (
            publisher(),
            subscription("std_msgs/msg/Bool"),
            "the types std_msgs/msg/String and std_msgs/msg/Bool differ",
        ),
        (
            publisher(reliability="best_effort"),
            subscription(),
            "the publisher offers best effort, the subscription requests reliable",
        ),
        (
            publisher(),
            subscription(durability="transient_local"),
            "the publisher offers volatile, the subscription requests transient local",
        ),
        (
            publisher(),
            subscription(deadline=2.0),
            "the subscription requests a deadline of 2 s, which the publisher does not offer",
        ),
        (
            publisher(),
            subscription(liveliness="manual_by_topic"),
            "the publisher offers automatic liveliness, the subscription requests manual by topic",
        ),
    ],
)
def test_incompatible_qos_is_reported(
    offered: Endpoint, wanted: Endpoint, reason: str | None
) -> None:
    result = [
        str(item) for item in connections(Observation(topics=(topic("/t", offered, wanted),)))
    ]
    expected = f"/t: /listener receives nothing from /talker: {reason}"
    assert result == ([expected] if reason else [])


def test_misspelled_topic_is_reported() -> None:
    seen = Observation(topics=(topic("/chatter", publisher()), topic("/chater", subscription())))
    assert [str(item) for item in connections(seen)] == [
        (
            "nothing publishes /chater, which /listener subscribes to; /talker publishes "
            "/chatter, which nobody subscribes to"
        )
    ]


@pytest.mark.parametrize(
    "other", [topic("/input", subscription()), topic("/chater", subscription("std_msgs/msg/Bool"))]
)
def test_topics_of_other_packages_are_not_reported(other: Topic) -> None:
    assert list(connections(Observation(topics=(topic("/chatter", publisher()), other)))) == []


LISTENER = talker(
    "/unused",
    node="listener",
    begin="""\
    from rclpy.qos import DurabilityPolicy, QoSProfile
    qos = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
    self.heard = self.create_subscription(String, '/numbers', print, qos)
    """,
)


@pytest.mark.build
@NEEDS_ROS
def test_unconnected_nodes_of_a_package(tmp_path: Path) -> None:
    modules = {"talker": talker("/numbers"), "listener": LISTENER, "once": ONCE}
    package = python_package(tmp_path / "src", "pair", modules)
    done = subprocess.run(
        command_line(package, "--together", "--duration", "2", "--format", "json"),
        env=variables(tmp_path),
        capture_output=True,
        text=True,
        check=False,
    )
    assert (done.returncode, done.stderr) == (1, "")
    (result,) = json.loads(done.stdout)["packages"]
    assert all(executable["ok"] for executable in result["executables"])
    together = result["together"]
    assert set(together["nodes"]) == {"/listener", "/talker"}
    assert together["problems"] == [
        (
            "/numbers: /listener receives nothing from /talker: the publisher offers volatile, the "
            "subscription requests "
            "transient local"
        )
    ]


KEEPS = talker(
    "/keeps",
    node="keeps",
    imports="""\
import os
import tempfile
from multiprocessing import resource_tracker, shared_memory""",
    begin="""\
    tempfile.mkdtemp()
    self.block = shared_memory.SharedMemory('scaffold_test_keeps', create=True, size=4096)
    resource_tracker.unregister(self.block._name, 'shared_memory')
    """,
    tick="if self.count == 15:\n    os.kill(os.getpid(), 9)",
)


@pytest.mark.build
@NEEDS_ROS
def test_leftovers_of_nodes_run_together_are_reported(tmp_path: Path) -> None:
    """A process, and the shared memory of a killed node."""
    modules = {"keeps": KEEPS, "parent": PARENT, "ignores": IGNORES_SIGINT}
    package = python_package(tmp_path / "src", "litter", modules)
    tmp = tmp_path / "tmp"
    tmp.mkdir()
    done = subprocess.run(
        command_line(package, "--together", "--duration", "3", "--format", "json"),
        env=variables(tmp),
        capture_output=True,
        text=True,
        check=False,
    )
    assert (done.returncode, done.stderr) == (1, "")
    (result,) = json.loads(done.stdout)["packages"]
    problems = [problem.splitlines()[0] for problem in result["together"]["problems"]]
    memory = "leaves shared memory behind: /dev/shm/scaffold_test_keeps"
    assert problems[:2] == [
        "keeps exited while running with the others, killed by SIGKILL",
        "ignores ignored SIGINT: still running after 5 s, SIGKILL ended it",
    ]
    assert problems[2].startswith("parent leaves a process running: ")
    assert problems[3:] == [f"keeps {memory}"]
    alone = {item["name"]: item["problems"] for item in result["executables"]}
    assert memory in alone["keeps"]
    assert processes_of(tmp) == []
    assert [*tmp.iterdir()] == []
    assert not Path("/dev/shm/scaffold_test_keeps").exists()  # noqa: S108  where it would be
