"""``smoke.yaml``: expectations of the author, and errors in the file."""

from __future__ import annotations

import json
import subprocess
from pathlib import Path

import pytest

from scaffold.cli.main import main
from scaffold.errors import InputError
from scaffold.model.package import Package
from scaffold.smoke.expectation import Expectation, Publication
from scaffold.smoke.result import Answer, FieldFigures, Observation
from scaffold.smoke.scenario.model import (
    Call,
    FieldExpectation,
    Scenario,
    Stimulus,
    TopicExpectation,
)
from scaffold.smoke.scenario.reader import scenarios
from scaffold.smoke.scenario.verdicts import overridden, problems
from tests.smoke.smoke_packages import ONCE, python_package, talker, write
from tests.smoke.smoke_runs import NEEDS_ROS, command_line, variables

FULL = """\
duration: 2
executables:
  talker:
    arguments: [--fast, 3]
    parameters: {rate: 10.0, wheel: {left: true, names: [a, b]}}
    exit_code: 3
    topics:
      chatter:
        type: std_msgs/String
        rate: 2
        tolerance: 5 %
        fields:
          data: {changes: true}
          size: {minimum: 0, maximum: 1.5, equals: 1}
      /free: {rate: any, tolerance: 0.5}
    services:
      switch: {type: std_srvs/SetBool, request: {data: true}, answer: {success: true}}
    actions:
      count: {type: demo_interfaces/action/Count, goal: {order: 5}, result: {sum: 10}}
    publish:
      /cmd_vel: {type: geometry_msgs/msg/Twist, message: {linear: {x: 0.5}}, rate: 10}
  once: {skip: true, duration: 7}
  plain:
"""


def read(text: str, *executables: str) -> dict[str, Scenario]:
    return scenarios(Package.of({"package.xml": "<package/>", "smoke.yaml": text}), executables)


def test_all_keys_are_read() -> None:
    result = read(FULL)
    assert result["talker"] == Scenario(
        arguments=("--fast", "3"),
        parameters={"rate": 10.0, "wheel.left": True, "wheel.names": ["a", "b"]},
        topics=(
            TopicExpectation(
                "/chatter",
                "std_msgs/msg/String",
                rate_hz=2.0,
                tolerance=0.05,
                fields=(
                    FieldExpectation("data", changes=True),
                    FieldExpectation("size", None, 0.0, 1.5, equals=1, has_equals=True),
                ),
            ),
            TopicExpectation("/free", any_rate=True, tolerance=0.5),
        ),
        calls=(
            Call("service", "/switch", "std_srvs/srv/SetBool", {"data": True}, {"success": True}),
            Call("action", "/count", "demo_interfaces/action/Count", {"order": 5}, {"sum": 10}),
        ),
        stimuli=(Stimulus("/cmd_vel", "geometry_msgs/msg/Twist", {"linear": {"x": 0.5}}, 10.0),),
        duration=2.0,
        exit_code=3,
    )
    assert result["once"] == Scenario(skip=True, duration=7.0)
    assert result["plain"] == Scenario(duration=2.0)


def test_command_line_of_a_scenario() -> None:
    assert read(FULL)["talker"].command() == [
        "--fast", "3", "--ros-args", "-p", "rate:=10.0", "-p", "wheel.left:=true",
        "-p", 'wheel.names:=["a", "b"]',
    ]  # fmt: skip


def test_package_without_smoke_yaml_has_no_scenarios() -> None:
    assert scenarios(Package.of({"package.xml": "<package/>"}), ()) == {}
    assert read("") == {}


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("[1]", "1: smoke.yaml needs keys with values"),
        ("a: [", "1: not YAML: did not find expected node content while parsing a flow node"),
        ("executable: {}", "1: smoke.yaml has no key 'executable'; did you mean 'executables'?"),
        ("executables: 5", "1: executables needs keys with values"),
        ("a: 1\n---\nb: 2", "3: a second document; only one is allowed"),
        (
            "executables:\n  talkr: {}",
            "2: the package has no executable 'talkr'; did you mean 'talker'?",
        ),
        ("executables:\n  x: {}", "2: the package has no executable 'x'; it has listener, talker"),
        ("executables: {talker: {}, talker: {}}", "1: executables has the key 'talker' twice"),
        (
            "executables:\n  talker:\n    topcis: {}",
            "3: executable 'talker' has no key 'topcis'; did you mean 'topics'?",
        ),
        ("executables: {talker: {skip: maybe}}", "1: 'maybe' is not true or false"),
        ("executables: {talker: {exit_code: 1.5}}", "1: '1.5' is not a whole number"),
        ("executables: {talker: {duration: -1}}", "1: '-1' is not a number above 0"),
        ("executables: {talker: {duration: .nan}}", "1: '.nan' is not a number above 0"),
        ("executables: {talker: {arguments: a}}", "1: 'a' is not a list of strings"),
        ("executables: {talker: {arguments: &a [*a]}}", "1: not a string"),
        ("executables: {talker: {parameters: [1]}}", "1: not fields with their values"),
        (
            "executables: {talker: {topics: {a: {rate: fast}}}}",
            "1: 'fast' is not a rate in hertz above 0, or 'any'",
        ),
        (
            "executables: {talker: {topics: {a: {tolerance: 7}}}}",
            "1: '7' is not a tolerance above 0 up to 1, or a percentage such as '5 %'",
        ),
        (
            "executables: {talker: {topics: {a: {type: String}}}}",
            "1: 'String' is not a type such as 'package/msg/Name'",
        ),
        (
            "executables: {talker: {services: {a: {}}}}",
            "1: service '/a' needs the key 'type'",
        ),
        ("executables: {talker: {topics: {a b: {}}}}", "1: 'a b' is not a valid ROS name"),
        (
            "executables: {talker: {parameters: {a: *b}}}",
            "1: the alias *b: write its value instead",
        ),
    ],
)
def test_invalid_file_is_one_error_with_its_position(text: str, message: str) -> None:
    with pytest.raises(InputError) as caught:
        read(text, "talker", "listener")
    assert str(caught.value).endswith(f"smoke.yaml:{message}")


def test_invalid_file_is_reported_before_the_build(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    package = python_package(tmp_path, "demo", {"once": ONCE})
    write(package, {"smoke.yaml": "executables:\n  onec: {}\n"})
    assert main(["smoke", str(package)]) == 2
    assert capsys.readouterr().err == (
        f"ros2-scaffold: error: {package}/smoke.yaml:2: the package has no executable 'onec'; "
        "did you mean 'once'?\n"
    )


def test_smoke_yaml_overrides_expectations_from_the_source() -> None:
    derived = Expectation(
        (
            Publication("/chatter", "std_msgs/msg/String", 10.0, timer_hz=10.0),
            Publication("/other", rate_hz=1.0),
        )
    )
    topics = (
        TopicExpectation("/chatter", any_rate=True),
        TopicExpectation("/more", "std_msgs/msg/Bool", 5.0, tolerance=0.2),
    )
    result = overridden(derived, Scenario(topics=topics))
    chatter, other, more = result.publications
    assert (chatter.type, chatter.rate_hz, chatter.timer_hz) == ("std_msgs/msg/String", None, None)
    assert (chatter.certain, chatter.stated_by) == (True, "smoke.yaml")
    assert other == derived.publications[1]
    assert (more.type, more.rate_hz, more.tolerance) == ("std_msgs/msg/Bool", 5.0, 0.2)


def field(first: object, last: object, changes: int) -> FieldFigures:
    numbers = [value for value in (first, last) if isinstance(value, (int, float))]
    least, greatest = (min(numbers), max(numbers)) if numbers else (None, None)
    return FieldFigures(5, changes, first, last, least, greatest)


@pytest.mark.parametrize(
    ("expected", "seen", "problem"),
    [
        (FieldExpectation("x", changes=True), field(1, 2, 1), None),
        (
            FieldExpectation("x", changes=True),
            field(1, 1, 0),
            "x of /t is always 1: smoke.yaml expects it to change",
        ),
        (
            FieldExpectation("x", changes=False),
            field("a", "b", 1),
            'x of /t changes from "a" to "b": smoke.yaml expects it to stay constant',
        ),
        (FieldExpectation("x", equals=0.1, has_equals=True), field(0.1 + 1e-9, 0.1, 0), None),
        (
            FieldExpectation("x", equals="map", has_equals=True),
            field("odom", "odom", 0),
            'x of /t is "odom": smoke.yaml expects "map"',
        ),
        (
            FieldExpectation("x", minimum=0.0, maximum=1.0),
            field(-1.0, 0.5, 3),
            "x of /t is -1: smoke.yaml expects at least 0",
        ),
        (
            FieldExpectation("x", minimum=0.0, maximum=1.0),
            field(0.5, 2.0, 3),
            "x of /t is 2: smoke.yaml expects at most 1",
        ),
        (
            FieldExpectation("x", minimum=0.0),
            field("a", "a", 0),
            'x of /t is "a": smoke.yaml expects a number',
        ),
        (FieldExpectation("x"), None, "x of /t was not seen: no message was received"),
        (
            FieldExpectation("x"),
            FieldFigures(0, 0, None, None, None, None, "no field 'x'"),
            "x of /t was not seen: no field 'x'",
        ),
    ],
)
def test_expected_values_of_a_field(
    expected: FieldExpectation, seen: FieldFigures | None, problem: str | None
) -> None:
    scenario = Scenario(topics=(TopicExpectation("/t", fields=(expected,)),))
    observation = Observation(fields={"/t": {} if seen is None else {"x": seen}})
    findings = [str(item) for item in problems(scenario, observation)]
    assert findings == ([] if problem is None else [problem])


@pytest.mark.parametrize(
    ("expected", "answer", "problem"),
    [
        ({"sum": 3}, Answer({"sum": 3, "more": 1}), None),
        ({"a": {"b": [0.1, 2]}}, Answer({"a": {"b": [0.1, 2], "c": 0}}), None),
        ({"sum": 3}, Answer({"sum": 4}), " returned sum: 4: smoke.yaml expects 3"),
        ({}, Answer(None, "it does not respond within 5 s"), ": it does not respond within 5 s"),
        ({"a": [1]}, Answer({"a": [1, 2]}), " returned a: [1, 2]: smoke.yaml expects [1]"),
    ],
)
def test_expected_response_of_a_service(
    expected: dict[str, object], answer: Answer, problem: str | None
) -> None:
    scenario = Scenario(calls=(Call("service", "/add", "demo/srv/Add", answer=expected),))
    observation = Observation(answers={("service", "/add"): answer})
    findings = [str(item) for item in problems(scenario, observation)]
    assert findings == ([] if problem is None else [f"service /add{problem}"])


# -- nodes

SERVER = '''\
"""Answer, react and fail on demand."""

import sys

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from std_msgs.msg import Float64, String
from std_srvs.srv import SetBool


class Server(Node):
    """Doubles what it receives."""

    def __init__(self):
        """Create all."""
        super().__init__('server')
        self.declare_parameter('factor', 2.0)
        self.doubled = self.create_publisher(Float64, 'doubled', 10)
        self.words = self.create_publisher(String, 'words', 10)
        self.input = self.create_subscription(Float64, 'input', self.on_input, 10)
        self.switch = self.create_service(SetBool, 'switch', self.on_switch)
        self.timer = self.create_timer(0.1, lambda: self.words.publish(String(data=sys.argv[1])))

    def on_input(self, message):
        """Publish the product."""
        factor = self.get_parameter('factor').value
        self.doubled.publish(Float64(data=factor * message.data))

    def on_switch(self, request, response):
        """Answer a request."""
        response.success = request.data
        response.message = 'on' if request.data else 'off'
        return response


def main():
    """Run the node until it is interrupted."""
    try:
        rclpy.init()
        rclpy.spin(Server())
    except (KeyboardInterrupt, ExternalShutdownException):
        sys.exit(3)
    finally:
        rclpy.try_shutdown()
'''

GOOD = """\
duration: 2
executables:
  server:
    arguments: [hello]
    parameters: {factor: 3.0}
    exit_code: 3
    publish:
      /input: {type: std_msgs/Float64, message: {data: 1.5}, rate: 10}
    topics:
      /words: {rate: 10, fields: {data: {equals: hello, changes: false}}}
      /doubled: {type: std_msgs/Float64, fields: {data: {minimum: 4.5, maximum: 4.5}}}
    services:
      /switch: {type: std_srvs/SetBool, request: {data: true}, answer: {message: 'on'}}
  talker: {skip: true}
"""


def smoke_report(package: Path, tmp_path: Path) -> list[dict[str, object]]:
    done = subprocess.run(
        command_line(package, "--duration", "2", "--format", "json"),
        env=variables(tmp_path),
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.stderr == ""
    executables: list[dict[str, object]] = json.loads(done.stdout)["packages"][0]["executables"]
    return executables


@pytest.mark.build
@NEEDS_ROS
def test_node_that_meets_its_expectations(tmp_path: Path) -> None:
    package = python_package(tmp_path, "demo", {"server": SERVER, "talker": talker("/t")})
    write(package, {"smoke.yaml": GOOD})
    (server,) = smoke_report(package, tmp_path)
    assert (server["name"], server["problems"]) == ("server", [])


@pytest.mark.build
@NEEDS_ROS
def test_node_that_misses_its_expectations(tmp_path: Path) -> None:
    package = python_package(tmp_path, "demo", {"server": SERVER})
    text = (
        GOOD.replace("exit_code: 3", "exit_code: 0")
        .replace("equals: hello", "equals: bye")
        .replace("minimum: 4.5", "minimum: 5")
        .replace("message: 'on'", "message: 'off'")
        .replace("rate: 10, fields", "rate: 30, fields")
        .replace("  talker: {skip: true}\n", "")
    )
    write(package, {"smoke.yaml": text})
    (server,) = smoke_report(package, tmp_path)
    expected = (
        "does not stop cleanly on SIGINT, exit code 3, but smoke.yaml expects 0",
        ": smoke.yaml expects std_msgs/msg/String at 30 Hz",
        'data of /words is "hello": smoke.yaml expects "bye"',
        "data of /doubled is 4.5: smoke.yaml expects at least 5",
        'service /switch returned message: "on": smoke.yaml expects "off"',
    )
    findings = server["problems"]
    assert isinstance(findings, list)
    assert len(findings) == len(expected)
    for text in expected:
        assert any(text in problem for problem in findings), text


def test_documented_example_is_valid() -> None:
    page = Path(__file__).parents[2].joinpath("docs", "smoke.md").read_text(encoding="utf-8")
    text = page.partition("```yaml\n")[2].partition("```")[0]
    result = read(text, "driver", "calibrate")
    assert (len(result["driver"].calls), len(result["driver"].topics[0].fields)) == (2, 3)
    assert result["calibrate"].skip
