"""A type checker is told what is put into dictionaries and lists, and what functions make."""

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


def written(source: str) -> str:
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
def test_what_is_put_into_a_container_is_its_contents(made: str, put: str, expected: str) -> None:
    text = written(KEEPER.replace("{}", put).replace(put, made, 1))
    assert f"self.latest = {expected}\n" in text
    assert f"        global _ros2_kept_0_0; _ros2_kept_0_0 = [msg]\n        {put}\n" in text


@pytest.mark.parametrize("made", ["{name: 1 for name in 'ab'}", "{1, 2}"])
def test_what_is_no_display_of_a_dictionary_stays(made: str) -> None:
    text = written(
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
def test_a_container_that_may_hold_anything_stays(put: str) -> None:
    source = KEEPER.replace("{}", f"self.latest['a'] = 1\n        {put}").replace(
        f"self.latest['a'] = 1\n        {put}", "{}", 1
    )
    assert "_ros2_dict" not in written(source)


def test_a_variable_of_one_function_is_not_that_of_another() -> None:
    source = (
        "def first(pose):\n    poses = []\n    poses.append(pose)\n    return poses\n\n\n"
        "def second(points):\n    poses = []\n    fill(poses)\n    return poses\n"
    )
    assert written(source).count("_ros2_list(_ros2_kept_0_0)") == 1


def test_a_function_that_makes_what_it_is_given_has_a_head_for_that() -> None:
    source = "def make(kind, frame=''):\n    msg = kind()\n    msg.frame = frame\n    return msg\n"
    text = written(source)
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
def test_other_functions_have_none(body: str) -> None:
    assert "_ros2_overload" not in written(f"def make(kind, frame=''):\n    {body}\n")


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
def test_callbacks_are_found_where_they_are_not_named(registered: str, expected: str) -> None:
    lines = "".join(f"        {line}\n" for line in registered.split("\n"))
    text = with_callback_types(TABLES.replace("{}\n", lines, 1).encode()).decode()
    assert f"def {expected}:" in text
