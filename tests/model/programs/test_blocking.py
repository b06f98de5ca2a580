"""Calls that block forever in a single-threaded program."""

from __future__ import annotations

import ast

import pytest

from scaffold.model.package import Package
from scaffold.model.programs.blocking import Waits, waits_alone, waits_in
from scaffold.model.rclpy.file import RclpyFile

SETUP = """\
from setuptools import setup

setup(name='demo', packages=['demo'],
      entry_points={'console_scripts': ['talker = demo.talker:main']})
"""
MANIFEST = (
    "<package><name>demo</name><export><build_type>ament_python</build_type></export></package>"
)
NODE = """\
import rclpy
import tf2_ros
from rclpy.executors import {executor}Executor
from rclpy.node import Node


class Talker(Node):
    def __init__(self):
        super().__init__('talker')
        self.rate = self.create_rate(2)
        {constructor}

    def tick(self):
        self.rate.sleep()


def main():
    rclpy.init()
    node = Talker()
    {main}
"""


def waits(main: str, constructor: str = "pass", executor: str = "SingleThreaded") -> list[str]:
    """Return the state of the blocked thread at each call of ``sleep``."""
    text = NODE.format(main=main, constructor=constructor, executor=executor)
    files = {"package.xml": MANIFEST, "setup.py": SETUP, "demo/talker.py": text}

    def is_sleep(_: RclpyFile, call: ast.Call) -> bool:
        return not call.args

    def waits_of(package: Package, path: str, function: str | None) -> Waits:
        return waits_in(package, (path, function), "sleep", is_sleep)

    return [where for _, where in waits_alone(Package.of(files), "sleep", waits_of)]


BLOCKED = "is blocked in this call"
THREAD = "import threading; threading.Thread(target"
TIMER = "self.create_timer(1.0, self.tick)"
SPIN = "executor = {}Executor(); executor.add_node(node); executor.spin()"


@pytest.mark.parametrize(
    ("main", "constructor", "where"),
    [
        ("rclpy.spin(node)", TIMER, "is in callback 'tick'"),
        (SPIN.format("SingleThreaded"), TIMER, "is in callback 'tick'"),
        ("node.tick()", "pass", BLOCKED),
        ("rclpy.spin(node)", "self.tick()", BLOCKED),
        ("import threading; node.tick()", "pass", BLOCKED),
        (f"{THREAD}=print).start(); node.tick()", "pass", BLOCKED),
        ("node.spin_speed = 1; node.tick(); print(node.spin_speed)", "pass", BLOCKED),
    ],
)
def test_blocks_if_no_other_thread_spins(main: str, constructor: str, where: str) -> None:
    assert waits(main, constructor) == [where]


@pytest.mark.parametrize(
    "main",
    [
        "rclpy.spin_once(node); node.tick()",
        "tf2_ros.TransformListener(1, node, spin_thread=True); node.tick()",
        f"{THREAD}=rclpy.spin, args=(node,)).start(); node.tick()",
        f"{THREAD}=lambda: rclpy.spin(node)).start(); node.tick()",
        "def work(): rclpy.spin(node)\n    " + f"{THREAD}=work).start(); node.tick()",
        "import thread_helpers; node.tick()",
        "start_spinning(node); node.tick()",
        "rclpy.spin(node)",
    ],
)
def test_does_not_block_if_another_thread_may_spin(main: str) -> None:
    assert waits(main) == []


def test_does_not_block_with_more_threads() -> None:
    assert waits(SPIN.format("MultiThreaded"), TIMER, "MultiThreaded") == []
