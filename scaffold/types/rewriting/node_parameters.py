"""Tells the type checker which parameters are nodes.

``def __init__(self, node, topic)`` that calls ``node.create_publisher(String, topic, 10)`` takes a
node of any class: it has the methods of rclpy's Node, and any other attributes. The same holds for
one that sets ``self.node = node`` in a class that calls ``self.node.create_publisher(...)``.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator

from scaffold import lazy_re

_PARAMETER = lazy_re.compile(
    r"(?:^|,)\s*(?P<name>(?:\w+_)?node)\b\s*(?::\s*(?:_|(?:\w+\.)*(?:Lifecycle)?Node)\s*)?"
    r"(?=,|=\s*None\b|\)?$)"
)
_CALLED = r"(?<![\w.])NAME\.create_(publisher|subscription|service|client|timer)\("
_CREATING = (
    r"(?<![\w.])NAME\.create_(?:(?:publisher|subscription|service|client)\(\s*[\w.]+\s*,"
    r"\s*(?!(?:\w+\.)*[A-Z]\w*[a-z])|timer\(\s*(?!['\"]))"
)
"""A call that creates something with the arguments of rclpy: the type before the name."""
_STORED = r"^[ ]*self\.(\w+)[ ]*(?::[^=\n]*)?=[ ]*NAME[ ]*(?:#[^\n]*)?$"
"""Matches a line that stores a parameter in an attribute."""
_OWN = ("def create_publisher(", "def create_subscription(", "def create_timer(", "rospy")
"""Text in files with another class of nodes."""
_SOME_NODE = "_Ros2SomeNode"
_AS_NODE = "_ros2_as_node"
_DEFINITION = f"""
from rclpy.node import Node as _Ros2NodeOfRclpy
from typing import Any as _Ros2AnyOfNode
class {_SOME_NODE}(_Ros2NodeOfRclpy):
    def __getattr__(self, name: str) -> _Ros2AnyOfNode: ...
def {_AS_NODE}(_: object) -> {_SOME_NODE}: ...
"""


def statements(
    text: str, parameters: str, body: str, class_: str, known: Collection[str]
) -> Iterator[str]:
    """Yield the statements to insert at the start of a function.

    Args:
        text: The file.
        parameters: The parameters of the function.
        body: Its body.
        class_: The class of the method; empty for a function.
        known: The parameters whose types are known.
    """
    for match in _PARAMETER.finditer(parameters):
        name = match["name"]
        aliases = re.findall(_STORED.replace("NAME", name), body, re.MULTILINE)
        uses = [(name, body), *((rf"self\.{alias}", class_) for alias in aliases)]
        count = sum(len(re.findall(_CREATING.replace("NAME", it), code)) for it, code in uses)
        called = sum(len(re.findall(_CALLED.replace("NAME", it), code)) for it, code in uses)
        if name in known or not count or count < called:
            continue
        if any(word in text for word in _OWN):
            continue
        yield f"{name} = {_AS_NODE}({name})"


def definition() -> str:
    """Return the definitions to append to the file."""
    return _DEFINITION
