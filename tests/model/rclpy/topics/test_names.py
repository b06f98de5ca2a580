"""ROS names: checks equal those of rclpy, where it is installed."""

from __future__ import annotations

import random
from collections.abc import Callable

import pytest

from scaffold.model.rclpy.topics.names import namespace_problem, node_problem, topic_problem

PIECES = ("a", "B", "_", "/", "~", "{", "}", "1", "-", " ", "node", "{ns}", "{node}", "é")


@pytest.mark.parametrize(
    ("name", "problem"),
    [
        ("chatter", None),
        ("~/scan_2d", None),
        ("{node}/scan", None),
        ("", "it is empty"),
        ("front scan", "whitespace is not allowed"),
        ("front-scan", "'-' is not allowed"),
        ("scan/2d", "'2d' begins with a digit"),
        ("scan/", "it ends with '/'"),
        ("a//b", "'//' is not allowed"),
        ("a/~", "'~' is allowed only at the beginning"),
        ("{robot}/a", "'{robot}' is not one of {node}, {ns} and {namespace}"),
    ],
)
def test_topic_problems(name: str, problem: str | None) -> None:
    assert topic_problem(name) == problem


def accepts(*checks: Callable[[str], object]) -> Callable[[str], bool]:
    """Return a function that tells whether rclpy accepts a name."""

    def verdict(name: str) -> bool:
        try:
            for check in checks:
                check(name)
        except Exception:  # noqa: BLE001  each validator has exceptions of its own
            return False
        return True

    return verdict


def test_rclpy_agrees() -> None:
    pytest.importorskip("rclpy", reason="rclpy is in the extra [ros]")
    from rclpy.expand_topic_name import expand_topic_name
    from rclpy.validate_full_topic_name import validate_full_topic_name
    from rclpy.validate_namespace import validate_namespace
    from rclpy.validate_node_name import validate_node_name
    from rclpy.validate_topic_name import validate_topic_name

    topic = accepts(
        validate_topic_name,
        lambda name: validate_full_topic_name(expand_topic_name(name, "node", "/ns")),
    )
    node = accepts(validate_node_name)
    namespace = accepts(
        lambda name: validate_namespace(name if name.startswith("/") else f"/{name}")
    )
    chance = random.Random(1)  # noqa: S311  chance, not secrecy
    for _ in range(3000):
        name = "".join(chance.choice(PIECES) for _ in range(chance.randint(0, 6)))
        assert (topic_problem(name) is None) == topic(name), name
        assert (node_problem(name) is None) == node(name), name
        assert (namespace_problem(name) is None) == namespace(name), name
