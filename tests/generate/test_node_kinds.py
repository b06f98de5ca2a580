"""The kinds of nodes: how answers change the generated code."""

from __future__ import annotations

from collections.abc import Mapping

import pytest

from scaffold.check.rules import registry
from scaffold.configuration import content
from scaffold.errors import InputError
from scaffold.generate import checking, draft
from scaffold.generate.questions import questions
from scaffold.generate.questions.defaults import User
from scaffold.generate.questions.questions import Given
from scaffold.generate.templates import filters, loading

ROOTS = content.roots("templates")
TEMPLATES = loading.load(ROOTS)


def files_of(kind: str, **answers: object) -> Mapping[str, str]:
    """Return the files of a package with one node, which every rule accepts."""
    given: dict[str, object] = {
        "package": "talker",
        "node_kind": kind,
        "node_name": "worker",
        "maintainer_name": "Ada",
        "maintainer_email": "ada@example.com",
        **answers,
    }
    asked = {name: Given(value, name) for name, value in given.items()}
    made = draft.draft(ROOTS, TEMPLATES, asked, User("."))
    assert checking.defects(made, registry.load(content.roots("rules"))) == []
    return made.rendered.files


def test_subscriber_does_not_index_possibly_empty_arrays() -> None:
    node = files_of("subscriber", message_type="sensor_msgs/msg/JointState")["talker/worker.py"]
    assert "{msg.name[0]}" not in node
    assert "f'Received: name: {len(msg.name)}, position: {len(msg.position)}'" in node


@pytest.mark.parametrize(
    ("kind", "question"),
    [
        ("publisher", "message_type"),
        ("subscriber", "message_type"),
        ("publisher_subscriber", "input_type"),
    ],
)
@pytest.mark.parametrize("type_", ["std_msgs/msg/String", "sensor_msgs/msg/Image"])
def test_readme_says_how_often_messages_are_logged(kind: str, question: str, type_: str) -> None:
    files = files_of(kind, **{question: type_})
    is_throttled = "throttle_duration_sec=1.0" in files["talker/worker.py"]
    assert is_throttled is (type_ == "sensor_msgs/msg/Image")
    said = "at most one message per second" if is_throttled else "each message"
    assert f"It logs {said} " in files["README.md"]


def test_subscriber_imports_only_what_its_log_needs() -> None:
    files = files_of("subscriber", message_type="geometry_msgs/msg/PoseStamped")
    assert "import math\n" not in files["talker/worker.py"]
    assert "import math\n" in files["test/test_worker.py"]


@pytest.mark.parametrize(
    ("kind", "answers"),
    [
        *((kind, ("message_type",)) for kind in ("subscriber", "diagnostics", "publisher")),
        *((kind, ("message_type",)) for kind in ("lifecycle", "composed_nodes")),
        ("synchronizer", ("first_type",)),
        ("publisher_subscriber", ("input_type",)),
        ("publisher_subscriber", ("message_type",)),
        ("publisher_subscriber", ("input_type", "message_type")),
    ],
)
def test_imported_libraries_are_dependencies(kind: str, answers: tuple[str, ...]) -> None:
    files = files_of(kind, **dict.fromkeys(answers, "sensor_msgs/msg/PointCloud2"))
    expected = ""
    for path, tag in (("test/test_worker.py", "test"), ("talker/worker.py", "exec")):
        if "from sensor_msgs_py." in files[path]:
            expected = f"  <{tag}_depend>sensor_msgs_py</{tag}_depend>"
    declared = [line for line in files["package.xml"].splitlines() if "sensor_msgs_py" in line]
    assert "".join(declared) == expected


def test_relay_imports_only_its_message() -> None:
    node = files_of("publisher_subscriber", message_type="geometry_msgs/msg/PoseStamped")
    code = node["talker/worker.py"]
    assert "        return msg\n" in code
    for word in ("math", "self.count", "frame_id"):
        assert word not in code


def test_processed_message_keeps_stamp_and_frame() -> None:
    files = files_of(
        "publisher_subscriber",
        input_type="sensor_msgs/msg/LaserScan",
        message_type="geometry_msgs/msg/TwistStamped",
    )
    code = files["talker/worker.py"]
    assert "        msg.header = received.header  # " in code
    assert "get_clock" not in code
    assert "frame_id" not in code
    assert "frame_id" not in files["README.md"]


def test_nested_headers_of_processed_message_use_the_frame_parameter() -> None:
    code = files_of(
        "publisher_subscriber",
        input_type="sensor_msgs/msg/LaserScan",
        message_type="nav_msgs/msg/Path",
    )["talker/worker.py"]
    assert "        msg.header = received.header  # " in code
    assert ("self.frame_id = self.declare_parameter" in code) is ("= self.frame_id" in code)


@pytest.mark.parametrize(("input_topic", "topic"), [("a", "a"), ("/a", "a"), ("~/a", "/worker/a")])
def test_subscribing_to_the_own_topic_is_rejected(input_topic: str, topic: str) -> None:
    message = "--input-topic and --topic are both '.*': the node would receive its own messages"
    with pytest.raises(InputError, match=message):
        files_of("publisher_subscriber", input_topic=input_topic, topic=topic)


@pytest.mark.parametrize("quality", ["latched", "best_effort,depth=5", "latched,deadline=0.5"])
@pytest.mark.parametrize("kind", ["subscriber", "publisher_subscriber"])
def test_qos_settings_become_a_constant(kind: str, quality: str) -> None:
    files = files_of(kind, qos=quality)
    for path in ("talker/worker.py", "test/test_worker.py"):
        assert "\nQOS = QoSProfile(" in files[path]
    assert ", QOS)" in files["talker/worker.py"]


def test_imports_of_one_module_are_merged() -> None:
    lines = ["from a.b import C, d", "import os", "from a.b import B", "from a.b import C"]
    assert filters.import_block(lines) == "import os\n\nfrom a.b import B, C, d"
    long = [f"from a.b import {letter * 50}" for letter in "YX"]
    assert filters.import_block(long) == "\n".join(sorted(long))
    mixed = [f"from a import {name * 40}" for name in ("b", "C", "d")]
    assert filters.import_block(reversed(mixed)) == "\n".join(mixed)
    commented = ["from a.b import C  # why", "from a.b import D"]
    assert filters.import_block(commented) == "\n".join(commented)


def test_help_of_shared_flag_covers_each_kind() -> None:
    kinds = [TEMPLATES[kind] for kind in ("publisher", "subscriber", "timer")]
    result = {question.name: question for question in questions.shared(kinds)}
    usual = "(default: the usual one of the type, such as scan)"
    assert result["topic"].help == f"topic to publish on {usual}; topic to subscribe to {usual}"
    assert result["topic"].default == "{{ message_type.topic }}"
    assert result["node_name"].help == "name of the node, its module and its executable"
    assert result["node_name"].default is None
