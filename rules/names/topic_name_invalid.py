"""NM001: names of topics, services and actions are accepted."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, RclpyRule, Report
from scaffold.api.python import is_guarded_by
from scaffold.api.rclpy import RclpyFile, topic_problem

_NODE = (
    "from rclpy.node import Node\nfrom std_msgs.msg import String\n\n\n"
    "class Talker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('talker')\n"
    "        self.create_publisher(String, '{}', 10)\n"
)
_TOPICS = (
    "from dataclasses import dataclass\n\nFRONT = 'front-scan'\n\n\n"
    "@dataclass\nclass Topics:\n    back: str = 'back-scan'\n"
)
_OTHER = (
    "from rclpy.node import Node\nfrom std_msgs.msg import String\n"
    "import topics\n\n\n"
    "class Talker(Node):\n"
    "    def __init__(self, names):\n"
    "        super().__init__('talker')\n{}"
    "        self.create_publisher(String, topics.FRONT, 10)\n"
    "        self.names = topics.Topics()\n"
    "        self.create_publisher(String, self.names.back, 10)\n"
)
_SETTING = "        topics.FRONT = 'front'\n        names.back = 'back'\n"


class TopicNameInvalid(RclpyRule):
    """A topic, service or action has a name that ROS 2 does not accept.

    **Why.** ``rclpy.exceptions.InvalidTopicNameException`` at start.

    **Fix.** Use letters, digits, ``_`` and ``/``; no digit after a ``/``, no ``/`` at the end.

    **Source.** design.ros2.org, "Topic and service name mapping"; ``rcl/validate_topic_name.c``.
    """

    code = "NM001"
    name = "topic-name-invalid"
    examples = (
        Example("accepted", {"talker.py": _NODE.format("~/scan_2d/front")}),
        Example(
            "a parameter that somebody sets",
            {
                "talker.py": _NODE.replace("'{}'", "topic").replace(
                    "        self.create",
                    "        topic = self.declare_parameter('topic', '').value\n"
                    "        self.create",
                )
            },
        ),
        Example(
            "a part of the name is a parameter that somebody sets",
            {
                "talker.py": _NODE.replace("'{}'", "f'robot/{name}/scan'").replace(
                    "        self.create",
                    "        name = self.declare_parameter('name', '').value\n        self.create",
                )
            },
        ),
        Example(
            "constants of another module that the file sets, and an object that it changes",
            {"topics.py": _TOPICS, "talker.py": _OTHER.format(_SETTING)},
        ),
        Example(
            "constants of another module, and the default of its dataclass",
            {"topics.py": _TOPICS, "talker.py": _OTHER.format("")},
            Report("talker.py:9:39", "ROS 2 refuses the name 'front-scan': '-' is not allowed"),
            Report("talker.py:11:39", "ROS 2 refuses the name 'back-scan': '-' is not allowed"),
        ),
        Example(
            "a dash",
            {"talker.py": _NODE.format("front-scan")},
            Report("8:39", "ROS 2 refuses the name 'front-scan': '-' is not allowed"),
        ),
        Example(
            "a digit first",
            {"talker.py": _NODE.format("scan/2d")},
            Report("8:39", "ROS 2 refuses the name 'scan/2d': '2d' begins with a digit"),
        ),
    )

    def check_file(self, file: RclpyFile) -> Iterator[Diagnostic]:
        for entity in file.endpoints:
            argument = entity.name_argument
            if argument is None or not isinstance(entity.name, str):
                continue
            # An empty default is there to be replaced.
            if entity.from_parameter and _has_gap(entity.name):
                continue
            if not entity.name and is_guarded_by(file.module, entity.call, argument.node):
                continue
            problem = topic_problem(entity.name)
            if problem:
                yield self.report(argument, f"ROS 2 refuses the name {entity.name!r}: {problem}")


def _has_gap(name: str) -> bool:
    """Tell whether a part of a name is empty."""
    return not name or "//" in name or name.endswith("/")
