"""Quality of service: parsing, generated code, and what rclpy makes of it."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path
from textwrap import dedent

import pytest

from scaffold.errors import InputError
from scaffold.generate.questions.answer_types import quality
from scaffold.generate.questions.qos import NAMES, Qos, qos
from scaffold.smoke import environment

needs_ros = pytest.mark.skipif(
    find_spec("rclpy") is None and not Path("/opt/ros").exists(),
    reason="no ROS 2: install the extra 'ros' of this project",
)

SETTINGS: dict[str, dict[str, object]] = {
    "7": {"depth": 7},
    "depth=7": {"depth": 7},
    "best_effort": {"depth": 10, "reliability": "BEST_EFFORT"},
    "reliability=best_effort, depth=5": {"depth": 5, "reliability": "BEST_EFFORT"},
    "5,best_effort": {"depth": 5, "reliability": "BEST_EFFORT"},
    "sensor_data,depth=20": {"depth": 20, "reliability": "BEST_EFFORT"},
    "latched": {"depth": 1, "durability": "TRANSIENT_LOCAL"},
    "latched,depth=4": {"depth": 4, "durability": "TRANSIENT_LOCAL"},
    "default,transient_local": {"depth": 10, "durability": "TRANSIENT_LOCAL"},
    "keep_all": {"depth": 10, "history": "KEEP_ALL"},
    "history=keep_last,depth=3,volatile": {"depth": 3},
    "deadline=0.5,lifespan=2": {"depth": 10, "deadline": 0.5, "lifespan": 2.0},
    "manual_by_topic,liveliness_lease_duration=1.5": {
        "depth": 10,
        "liveliness": "MANUAL_BY_TOPIC",
        "liveliness_lease_duration": 1.5,
    },
    "system_default,depth=2": {
        "depth": 2,
        "history": "SYSTEM_DEFAULT",
        "reliability": "SYSTEM_DEFAULT",
        "durability": "SYSTEM_DEFAULT",
    },
}
DEFAULTS: dict[str, object] = {
    "history": "KEEP_LAST",
    "reliability": "RELIABLE",
    "durability": "VOLATILE",
    "liveliness": "SYSTEM_DEFAULT",
    **dict.fromkeys(("deadline", "lifespan", "liveliness_lease_duration"), 0.0),
}
"""What rclpy has for a depth alone."""

EVALUATE = dedent("""\
    import json
    import sys

    found = []
    for code in json.load(sys.stdin):
        names = {}
        exec(code, names)
        quality = names['QOS']
        if isinstance(quality, int):
            from rclpy.qos import QoSProfile
            quality = QoSProfile(depth=quality)
        durations = ('deadline', 'lifespan', 'liveliness_lease_duration')
        found.append({
            'depth': quality.depth,
            **{key: getattr(quality, key).name
               for key in ('history', 'reliability', 'durability', 'liveliness')},
            **{key: getattr(quality, key).nanoseconds / 1e9 for key in durations},
        })
    print(json.dumps(found))
""")


@needs_ros
def test_rclpy_profile_has_the_requested_settings() -> None:
    code = ["\n".join((*item.imports, item.assignment)) for item in map(qos, SETTINGS)]
    done = subprocess.run(
        [sys.executable, "-c", EVALUATE],
        input=json.dumps(code),
        env=dict(environment.select(os.environ).variables),
        capture_output=True,
        text=True,
        check=True,
    )
    findings = dict(zip(SETTINGS, json.loads(done.stdout), strict=True))
    assert findings == {text: {**DEFAULTS, **wanted} for text, wanted in SETTINGS.items()}


def test_depth_or_predefined_profile_needs_no_constant() -> None:
    assert qos("7") == Qos("7", (), "reliable, depth 7", text="7")
    assert qos("depth=7") == qos("7")._replace(text="depth=7")
    assert qos("default") == qos("10")._replace(text="default")
    for name in NAMES[1:]:
        if name != "latched":
            assert qos(name).expression == f"qos_profile_{name}"
            assert qos(name).constants == ()


def test_settings_become_a_constant() -> None:
    short = qos("best_effort,depth=5")
    assert short.expression == "QOS"
    assert short.imports == ("from rclpy.qos import QoSProfile, ReliabilityPolicy",)
    assert short.constants == (
        "QOS = QoSProfile(depth=5, reliability=ReliabilityPolicy.BEST_EFFORT)",
    )
    assert short.summary == "best effort, depth 5"
    long = qos("latched,deadline=0.5")
    assert long.constants == (
        "QOS = QoSProfile(",
        "    depth=1,",
        "    reliability=ReliabilityPolicy.RELIABLE,",
        "    durability=DurabilityPolicy.TRANSIENT_LOCAL,",
        "    deadline=Duration(seconds=0.5),",
        ")",
    )
    assert "from rclpy.duration import Duration" in long.imports
    assert long.summary == "reliable, transient local, depth 1, deadline 0.5 s"
    assert qos("latched").summary == "latched: reliable, transient local, depth 1"


def test_settings_as_a_mapping() -> None:
    mapped = quality({"reliability": "best_effort", "depth": 5})
    assert mapped == qos("best_effort,depth=5")._replace(text=mapped.text)
    assert qos(mapped.text) == mapped
    with pytest.raises(InputError, match=r"unknown setting 'dept=5'.*did you mean depth"):
        quality({"dept": 5})


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("best_efort", "; did you mean best_effort"),
        ("sensor-data", "; did you mean sensor_data"),
        ("best_effort,dept=3", "unknown setting 'dept=3'.*; did you mean depth"),
        ("best_effort,reliable", "sets reliability twice: best_effort and reliable"),
        ("10,20", "sets depth twice: 10 and 20"),
        ("depth=0", "the depth is 1 to 10000, not '0'"),
        ("durability=reliable", "durability is volatile or transient_local, not 'reliable'"),
        ("deadline=soon", "deadline is a number of seconds, not 'soon'"),
        ("deadline=0", "deadline is a number of seconds, not '0'"),
        ("10,sensor_data", "unknown setting 'sensor_data'"),
        ("best_effort,", "unknown setting ''"),
    ],
)
def test_misspelled_settings_get_a_suggestion(text: str, message: str) -> None:
    with pytest.raises(InputError, match=f"^the quality of service '{text}'.*{message}"):
        qos(text)


@pytest.mark.parametrize("text", ["0", "-1", "10001", "1.5", "best", "", "٣"])
def test_invalid_qos_is_rejected(text: str) -> None:
    with pytest.raises(InputError, match="neither a depth from 1 to 10000 nor one of default, "):
        qos(text)
