"""The measurements of the observer: statistics in bounded memory, and the interfaces of a node."""

from __future__ import annotations

import json
import re
import statistics
import struct
import subprocess
from importlib.util import find_spec
from io import StringIO
from pathlib import Path
from typing import Any

import pytest

from scaffold.smoke.probe import messages
from scaffold.smoke.probe.building import fill
from scaffold.smoke.probe.fields import Field
from scaffold.smoke.probe.statistics import MOST_POINTS, Moments, Spread, stamp
from scaffold.smoke.probe.topics import QUEUE_BYTES, QUEUE_DEPTH, Topic
from scaffold.smoke.reports import report
from scaffold.smoke.result import (
    Build,
    Endpoint,
    Executable,
    Log,
    LogLine,
    Observation,
    PackageResult,
    Smoke,
    Usage,
)
from scaffold.smoke.result import Spread as Figures
from scaffold.smoke.result import Topic as SeenTopic
from tests.smoke.smoke_packages import python_package
from tests.smoke.smoke_runs import NEEDS_ROS, command_line, variables

needs_messages = pytest.mark.skipif(find_spec("std_msgs") is None, reason="no ROS messages")

SENSOR = '''\
"""Publish ranges with all that an observer can see."""

import rclpy
from rclpy.duration import Duration
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.qos import QoSProfile, ReliabilityPolicy
from sensor_msgs.msg import Range


class Sensor(Node):
    """Publishes ranges whose stamps are a second old."""

    def __init__(self):
        """Create all."""
        super().__init__('sensor')
        self.declare_parameter('frame_id', 'front')
        self.declare_parameter('limits', [0.1, 4.0])
        self.get_logger().error('not <b>calibrated</b>')
        qos = QoSProfile(
            depth=3, reliability=ReliabilityPolicy.BEST_EFFORT, deadline=Duration(seconds=2)
        )
        self.publisher = self.create_publisher(Range, 'range', qos)
        self.timer = self.create_timer(0.1, self.on_timer)

    def on_timer(self):
        """Publish a range."""
        message = Range()
        message.header.frame_id = self.get_parameter('frame_id').value
        message.header.stamp = (self.get_clock().now() - Duration(seconds=1)).to_msg()
        self.publisher.publish(message)


def main(args=None):
    """Run the node until it is interrupted."""
    try:
        rclpy.init(args=args)
        rclpy.spin(Sensor())
    except (KeyboardInterrupt, ExternalShutdownException):
        pass
    finally:
        rclpy.try_shutdown()
'''


# -- figures


def test_spread_statistics() -> None:
    values = [3.0, 1.0, 4.0, 1.0, 5.0]
    spread = Spread()
    assert spread.as_data() is None
    for value in values:
        spread.add(value)
    assert spread.as_data() == {
        "count": 5,
        "mean": pytest.approx(statistics.fmean(values)),
        "deviation": pytest.approx(statistics.pstdev(values)),
        "least": 1.0,
        "greatest": 5.0,
    }


def test_all_rates_of_few_messages_are_kept() -> None:
    moments = Moments()
    for moment in (10.0, 10.5, 11.0, 11.1):
        moments.add(moment)
    assert moments.rates() == [[0.5, 2.0], [1.0, 2.0], [1.1, 10.0]]


def test_rates_of_many_messages_are_bounded() -> None:
    moments = Moments()
    for number in range(10_000):
        moments.add(number / 1000)
    rates = moments.rates()
    assert MOST_POINTS / 2 - 1 <= len(rates) <= MOST_POINTS
    assert rates[-1][0] > 9.5
    assert {round(rate) for _, rate in rates} == {1000}


@pytest.mark.parametrize(
    ("data", "time"),
    [
        (b"\0\1\0\0" + struct.pack("<iI", 12, 500_000_000), 12.5),
        (b"\0\0\0\0" + struct.pack(">iI", 12, 500_000_000), 12.5),
        (b"\0\1\0\0" + bytes(8), None),
        (b"\0\1\0\0\1", None),
    ],
)
def test_stamp_of_a_header(data: bytes, time: float | None) -> None:
    assert stamp(data) == time


def message_info(sent: float, number: int) -> dict[str, int]:
    nanoseconds = int(sent * 1e9)
    return {
        "source_timestamp": nanoseconds,
        "received_timestamp": nanoseconds + 1_000_000,
        "publication_sequence_number": number,
    }


@needs_messages
def test_lost_messages_are_counted() -> None:
    kind = messages.find_type("std_msgs/msg/Header")
    topic = Topic()
    for number in (1, 2, 4):
        topic.take(bytes(20 * number), message_info(1000.0 + number, number), kind)
    data = topic.as_report(publishers=1)
    assert (data["count"], data["lost"], data["bytes"]) == (3, 1, 140)
    assert topic.as_report(publishers=2)["lost"] is None
    assert data["transport"] == {
        "count": 3, "mean": pytest.approx(0.001), "deviation": pytest.approx(0, abs=1e-6),
        "least": pytest.approx(0.001), "greatest": pytest.approx(0.001),
    }  # fmt: skip
    assert data["delay"] is None  # the stamp is the message: there is no header


@needs_messages
def test_queue_depth_shrinks_for_late_large_messages(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    kind = messages.find_type("std_msgs/msg/UInt8MultiArray")
    monkeypatch.setattr("time.time", lambda: 1000.0)
    in_time, late = Topic(), Topic()
    in_time.take(bytes(QUEUE_BYTES // 4), message_info(999.9, 1), kind)
    assert in_time.fitting_depth() == QUEUE_DEPTH
    late.take(bytes(QUEUE_BYTES // 4), message_info(990.0, 1), kind)
    assert late.fitting_depth() == 4
    late.take(bytes(2 * QUEUE_BYTES), message_info(990.0, 2), kind)
    assert late.fitting_depth() == 1


class Reading:
    """A message whose field is read."""

    def __init__(self, value: object) -> None:
        self.inner = [self]
        self.value = value


@pytest.mark.parametrize(
    ("values", "least", "greatest"),
    [((2.0, 1.0, 3.0), 1.0, 3.0), ((1.0, float("nan")), None, None), (("a", "b"), None, None)],
)
def test_least_and_greatest_value_of_a_field(
    values: tuple[object, ...], least: float | None, greatest: float | None
) -> None:
    field = Field("inner[0].value")
    for value in values:
        field.take(Reading(value))
    data = field.as_data()
    assert (data["least"], data["greatest"]) == (least, greatest)
    assert (data["count"], data["changes"]) == (len(values), len(values) - 1)


def test_missing_field() -> None:
    field = Field("inner[1]")
    field.take(Reading(1))
    assert (field.as_data()["count"], field.as_data()["error"]) == (0, "no field 'inner[1]'")


@needs_messages
def test_message_is_filled_from_plain_data() -> None:
    data = {"layout": {"dim": [{"label": "x", "size": 2}]}, "data": [1, 2.5]}
    message = fill(messages.find_type("std_msgs/msg/Float32MultiArray")(), data)
    assert messages.as_data(message) == {
        "layout": {"dim": [{"label": "x", "size": 2, "stride": 0}], "data_offset": 0},
        "data": [1.0, 2.5],
    }
    byte = fill(messages.find_type("std_msgs/msg/Byte")(), {"data": 7})
    assert byte.data == b"\x07"


@needs_messages
@pytest.mark.parametrize(
    ("values", "reason"),
    [
        ({"date": 1}, "no field 'date'; there are data"),
        ({"data": "one"}, "'data' cannot be 'one': "),
        ({"data": 2**70}, "'data' cannot be "),
    ],
)
def test_data_that_does_not_fit_the_message(values: dict[str, object], reason: str) -> None:
    with pytest.raises(ValueError, match=re.escape(reason)):
        fill(messages.find_type("std_msgs/msg/Int32")(), values)


# -- text


def smoke_of(observation: Observation) -> Smoke:
    executable = Executable("sensor", observation)
    packages = (PackageResult("demo", Build(ok=True), (executable,)),)
    return Smoke({"kind": "wheels", "prefix": "/opt", "rmw": "rmw"}, packages)


OBSERVATION = Observation(
    nodes=("/sensor",),
    topics=(
        SeenTopic(
            "/range", "sensor_msgs/msg/Range", 1, count=10, rate_hz=10.0,
            endpoints=(
                Endpoint(
                    "publisher", "/sensor", "sensor_msgs/msg/Range",
                    {
                        "reliability": "best_effort", "durability": "volatile",
                        "history": "keep_last", "depth": 3, "deadline": 2.0, "lifespan": None,
                    },
                ),
            ),
            first_after=0.5, lost=2, interval=Figures(9, 0.1, 0.001, 0.098, 0.102),
            bytes=520, size=Figures(10, 52.0, 0.0, 52.0, 52.0),
        ),
    ),
    parameters={"/sensor": {"frame_id": "front", "use_sim_time": False}, "/deaf": None},
    log=Log({"error": 1, "info": 3}, (LogLine("error", "sensor", "not calibrated", 5.0),)),
    usage=Usage(1.0, 12.3, 70_000_000, 71_000_000),
)  # fmt: skip


def test_text_has_one_line_per_topic_and_the_first_error() -> None:
    out = StringIO()
    report(smoke_of(OBSERVATION), "text", out)
    assert out.getvalue().splitlines()[3:7] == [
        "  sensor: ok",
        "    node /sensor",
        "    /range  sensor_msgs/msg/Range  1 publisher  10.00 Hz  10 messages",
        "    logged 1 error: not calibrated",
    ]


def test_verbose_text_shows_all_measurements() -> None:
    out = StringIO()
    report(smoke_of(OBSERVATION), "text", out, verbose=True)
    assert out.getvalue().splitlines()[6:17] == [
        "      first message 0.50 s after the start",
        "      interval 100.00 ms, deviation 1.00 ms, 98.00 to 102.00 ms",
        "      size 52 B, 520 B/s",
        "      2 messages lost between node and observer",
        "      publisher of /sensor: best effort, volatile, keep last 3, deadline 2 s",
        '    parameter frame_id = "front"',
        "    parameters of /deaf: no answer",
        "    logged 1 error, 3 info",
        "      ERROR sensor: not calibrated",
        "    memory 70.0 MB, at most 71.0 MB, 12 % of a core",
        "",
    ]


# -- a node


@pytest.mark.build
@NEEDS_ROS
def test_all_interfaces_of_a_node_are_observed(tmp_path: Path) -> None:
    package = python_package(tmp_path, "observed", {"sensor": SENSOR})
    done = subprocess.run(
        command_line(package, "--duration", "3", "--format", "json"),
        env=variables(tmp_path),
        capture_output=True,
        text=True,
        check=False,
    )
    assert (done.returncode, done.stderr) == (0, "")
    (sensor,) = json.loads(done.stdout)["packages"][0]["executables"]
    (topic,) = sensor["topics"]
    _check_messages(topic)
    (endpoint,) = topic["endpoints"]
    assert (endpoint["kind"], endpoint["node"]) == ("publisher", "/sensor")
    assert endpoint["qos"]["reliability"] == "best_effort"
    assert (endpoint["qos"]["deadline"], endpoint["qos"]["lifespan"]) == (2.0, None)
    values = sensor["parameters"]["/sensor"]
    assert (values["frame_id"], values["limits"]) == ("front", [0.1, 4.0])
    assert sensor["log"]["counts"] == {"error": 1}
    (line,) = sensor["log"]["lines"]
    assert (line["level"], line["node"]) == ("error", "sensor")
    assert line["text"] == "not <b>calibrated</b>"
    assert sensor["usage"]["memory_peak"] >= sensor["usage"]["memory"] > 2**20
    assert sensor["usage"]["cpu_seconds"] > 0


def _check_messages(topic: dict[str, Any]) -> None:
    assert topic["bytes"] == topic["count"] * topic["size"]["mean"]
    assert topic["bandwidth"] == pytest.approx(topic["rate_hz"] * topic["size"]["mean"])
    interval = topic["interval"]
    assert interval["count"] == topic["count"] - 1
    assert interval["least"] <= interval["mean"] <= interval["greatest"]
    assert topic["lost"] == 0
    assert len(topic["rates"]) == topic["count"] - 1
    assert topic["first_after"] > 0
    assert topic["delay"]["least"] >= 1.0
    assert topic["transport"]["least"] >= 0
