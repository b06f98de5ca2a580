"""Inserted lines that tell the type checker the contents of containers and results of factories."""

from __future__ import annotations

import ast

import pytest

from scaffold.types.rewriting.arguments import with_arguments
from scaffold.types.rewriting.callbacks import with_callback_types

KEEPER = """\
class Keeper:
    def __init__(self):
        self.latest = {}

    def on_odom(self, msg):
        {}

    def report(self):
        return len(self.latest)
"""


def rewritten(source: str) -> str:
    text = with_arguments(source.encode()).data.decode()
    ast.parse(text)
    return text


@pytest.mark.parametrize(
    ("made", "put", "expected"),
    [
        ("{}", "self.latest[msg.name] = msg", "_ros2_dict(_ros2_kept_0_0)"),
        ("[]", "self.latest.append(msg)", "_ros2_list(_ros2_kept_0_0)"),
        ("deque(maxlen=3)", "self.latest.appendleft(msg)", "_ros2_deque(_ros2_kept_0_0)"),
        ("{}", "last = self.latest.setdefault(1, msg)", "_ros2_dict(_ros2_kept_0_0)"),
        ("{'a': None}", "self.latest['a'] = msg", "{'a': None, **_ros2_dict(_ros2_kept_0_0)}"),
    ],
)
def test_type_of_container_follows_from_inserted_values(made: str, put: str, expected: str) -> None:
    text = rewritten(KEEPER.replace("{}", put).replace(put, made, 1))
    assert f"self.latest = {expected}\n" in text
    assert f"        global _ros2_kept_0_0; _ros2_kept_0_0 = [msg]\n        {put}\n" in text


@pytest.mark.parametrize("made", ["{name: 1 for name in 'ab'}", "{1, 2}"])
def test_other_containers_are_unchanged(made: str) -> None:
    text = rewritten(
        KEEPER.replace("{}", "self.latest[1] = msg").replace("self.latest[1] = msg", made, 1)
    )
    assert f"self.latest = {made}\n" in text


@pytest.mark.parametrize(
    "put",
    [
        "self.latest.update(msg)",
        "fill(self.latest)",
        "other = self.latest",
        "self.latest[0], a = msg",
        "self.latest[0] += msg",
        "self.latest[0] = lambda: msg",
        "self.latest[0] = [*self.latest, msg]",
        "if msg: self.latest[0] = msg",
    ],
)
def test_container_with_unknown_contents_is_unchanged(put: str) -> None:
    source = KEEPER.replace("{}", f"self.latest['a'] = 1\n        {put}").replace(
        f"self.latest['a'] = 1\n        {put}", "{}", 1
    )
    assert "_ros2_dict" not in rewritten(source)


def test_equal_local_names_of_functions_are_separate() -> None:
    source = (
        "def first(pose):\n    poses = []\n    poses.append(pose)\n    return poses\n\n\n"
        "def second(points):\n    poses = []\n    fill(poses)\n    return poses\n"
    )
    assert rewritten(source).count("_ros2_list(_ros2_kept_0_0)") == 1


def test_factory_of_a_given_class_gets_an_overload() -> None:
    source = "def make(kind, frame=''):\n    msg = kind()\n    msg.frame = frame\n    return msg\n"
    text = rewritten(source)
    head = 'def make(kind: "_Ros2Callable[..., _Ros2Made]", frame=\'\') -> "_Ros2Made": ...\n'
    assert f"@_ros2_overload\n{head}{source}" in text


@pytest.mark.parametrize(
    "body",
    [
        "return kind",
        "kind = other\n    return kind()",
        "if frame:\n        return 1\n    return kind()",
    ],
)
def test_other_functions_get_no_overload(body: str) -> None:
    assert "_ros2_overload" not in rewritten(f"def make(kind, frame=''):\n    {body}\n")


TABLES = """\
class Listener:
    def __init__(self):
{}

    def on_odom(self, msg):
        pass

    def on_imu(self, side, msg):
        pass
"""


@pytest.mark.parametrize(
    ("registered", "expected"),
    [
        (
            (
                "for kind, callback in [(Odometry, self.on_odom), (Imu, other)]:\n"
                "    self.create_subscription(kind, 'a', callback, 10)"
            ),
            'on_odom(self, msg: "Odometry")',
        ),
        (
            (
                "self.table = {'a': self.on_odom}\n"
                "for name, callback in self.table.items():\n"
                "    self.create_subscription(Odometry, name, callback, 10)"
            ),
            'on_odom(self, msg: "Odometry")',
        ),
        (
            "self.create_subscription(Imu, 'a', partial(self.on_imu, 'left'), 10)",
            'on_imu(self, side, msg: "Imu")',
        ),
        (
            "self.create_subscription(Imu, 'a', lambda msg: self.on_imu('left', msg), 10)",
            'on_imu(self, side, msg: "Imu")',
        ),
        (
            "self.create_subscription(Imu, 'a', self.on_odom if left else self.other, 10)",
            'on_odom(self, msg: "Imu")',
        ),
    ],
)
def test_callbacks_in_tables_and_loops_are_found(registered: str, expected: str) -> None:
    lines = "".join(f"        {line}\n" for line in registered.split("\n"))
    text = with_callback_types(TABLES.replace("{}\n", lines, 1).encode()).decode()
    assert f"def {expected}:" in text
