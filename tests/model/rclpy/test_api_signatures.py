"""The table of arguments says what rclpy itself says."""

from __future__ import annotations

import importlib
import inspect
from collections.abc import Callable

import pytest

from scaffold.model.python.module import PythonModule
from scaffold.model.rclpy.api_signatures import FUNCTIONS, METHODS, Signature, excess_arguments
from scaffold.model.rclpy.file import RclpyFile
from scaffold.source import Source

NODE = """\
import rclpy
from rclpy.node import Node

class Talker(Node):
    def __init__(self):
        {}

{}
"""


def signature_of(function: Callable[..., object]) -> Signature:
    """Return the parameters of a real function."""
    parameters = inspect.signature(function).parameters.values()
    positional = [p.name for p in parameters if p.kind is p.POSITIONAL_OR_KEYWORD]
    keywords = [p.name for p in parameters if p.kind is p.KEYWORD_ONLY]
    return Signature(tuple(p for p in positional if p != "self"), frozenset(keywords))


@pytest.mark.parametrize("name", [name for name in FUNCTIONS if name != "rclpy.qos.QoSProfile"])
def test_functions_of_rclpy(name: str) -> None:
    pytest.importorskip("rclpy", reason="rclpy is in the extra [ros]")
    module, _, attribute = name.rpartition(".")
    assert FUNCTIONS[name] == signature_of(getattr(importlib.import_module(module), attribute))


@pytest.mark.parametrize("name", METHODS)
def test_methods_of_a_node(name: str) -> None:
    pytest.importorskip("rclpy", reason="rclpy is in the extra [ros]")
    from rclpy.node import Node

    assert METHODS[name] == signature_of(getattr(Node, name))


def test_keywords_of_a_profile() -> None:
    pytest.importorskip("rclpy", reason="rclpy is in the extra [ros]")
    from rclpy.qos import QoSProfile

    slots = {name.removeprefix("_") for name in QoSProfile.__slots__}
    assert FUNCTIONS["rclpy.qos.QoSProfile"] == Signature((), frozenset(slots))


def excess(line: str, more: str = "") -> list[str]:
    """Return how the arguments read that rclpy does not take."""
    text = NODE.format(line, more)
    facts = RclpyFile.of(PythonModule.parse(Source("talker.py", text)))
    return [facts.module.text(item.node) for item in excess_arguments(facts)]


def test_parameters_have_no_default_when_read() -> None:
    assert excess("self.get_parameter('rate', 10)") == ["10"]


@pytest.mark.parametrize(
    "line",
    [
        "super().__init__('talker', '/robot')",
        "Node.__init__(self, 'talker', '/robot')",
        "self.create_client(Trigger, 'reset', '/robot')",
        "rclpy.create_node('talker', '/robot')",
        "rclpy.create_node('talker').create_client(Trigger, 'reset', '/robot')",
    ],
)
def test_one_position_too_many(line: str) -> None:
    assert excess(line) == ["'/robot'"]


@pytest.mark.parametrize(
    "line",
    [
        "rclpy.init(*args)",
        "rclpy.init(**options)",
        "self.client.create_client(Trigger, 'reset', 10)",
        "self.create_client(*both, 10)",
    ],
)
def test_what_may_fit(line: str) -> None:
    assert excess(line) == []


def test_method_of_its_own() -> None:
    own = "    def create_client(self, kind, name, wait):\n        pass\n"
    assert excess("self.create_client(Trigger, 'reset', 10)", own) == []
