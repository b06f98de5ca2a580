"""What waits for ever in a program with one thread, and what may not."""

from __future__ import annotations

import ast

import pytest

from scaffold.model.package import Package
from scaffold.model.programs.blocking import waits_alone
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
    """Return what the waiting thread does at each call of ``sleep``."""
    text = NODE.format(main=main, constructor=constructor, executor=executor)
    files = {"package.xml": MANIFEST, "setup.py": SETUP, "demo/talker.py": text}

    def is_sleep(_: RclpyFile, call: ast.Call) -> bool:
        return not call.args

    return [found.where for found in waits_alone(Package.of(files), "sleep", is_sleep)]


TIMER = "self.create_timer(1.0, self.tick)"
SPIN = "executor = {}Executor(); executor.add_node(node); executor.spin()"


@pytest.mark.parametrize(
    ("main", "constructor", "where"),
    [
        ("rclpy.spin(node)", TIMER, "is in callback 'tick'"),
        (SPIN.format("SingleThreaded"), TIMER, "is in callback 'tick'"),
        ("node.tick()", "pass", "is blocked in this call"),
        ("rclpy.spin(node)", "self.tick()", "is blocked in this call"),
    ],
)
def test_nobody_else_spins(main: str, constructor: str, where: str) -> None:
    assert waits(main, constructor) == [where]


@pytest.mark.parametrize(
    "main",
    [
        "rclpy.spin_once(node); node.tick()",
        "tf2_ros.TransformListener(1, node, spin_thread=True); node.tick()",
        "import threading; node.tick()",
        "start_spinning(node); node.tick()",
        "rclpy.spin(node)",
    ],
)
def test_somebody_may_spin(main: str) -> None:
    assert waits(main) == []


def test_more_threads() -> None:
    assert waits(SPIN.format("MultiThreaded"), TIMER, "MultiThreaded") == []
