"""Gives the methods of mixins for nodes a ``self`` that is also a node, for the type checker.

A class without bases and constructor that calls ``self.create_timer(...)`` becomes a part of a
node: ``class Driver(StopMixin, Node)``.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from scaffold import lazy_re
from scaffold.types.rewriting.added_lines import Extended
from scaffold.types.rewriting.callbacks import function_body

_CLASS = lazy_re.compile(
    r"^class ([^\W\d]\w*)(?:\([ ]*(?:object|(?:abc\.)?ABC)?[ ]*\))?[ ]*:", re.MULTILINE
)
_USED = lazy_re.compile(
    r"\bself\.(create_(?:publisher|subscription|timer|service|client)|get_(?:logger|clock|parameter)"
    r"|declare_parameters?)\("
)
"""Matches the methods of a node that mixins call."""
# linear: the spaces at the start of a line
_METHOD = lazy_re.compile(
    r"^(?P<indent>[ ]+)(?:async )?def \w+\(\s*(?P<self>self)\b(?!\s*:)", re.MULTILINE
)
_NODE = "_Ros2Node"
_BOTH = "_Ros2Both"
_IMPORTS = (
    f"\nfrom rclpy.node import Node as {_NODE}\nfrom ty_extensions import Intersection as {_BOTH}\n"
)


def with_nodes_as_self(extended: Extended) -> Extended:
    """Return a file with annotated methods of mixins."""
    if b".create_" not in extended.data and b".get_" not in extended.data:
        return extended
    text = extended.data.decode()
    edits = [*_edits(text)]
    if not edits:
        return extended
    at = 0
    parts: list[str] = []
    classes: dict[str, None] = {}
    for place, class_ in edits:
        parts += text[at:place], f": '_Ros2SelfOf{class_}'"
        classes[class_] = None
        at = place
    aliases = [f"_Ros2SelfOf{name} = {_BOTH}[{name}, {_NODE}]\n" for name in classes]
    result = "".join([*parts, text[at:], _IMPORTS, *aliases])
    return extended._replace(data=result.encode())


def _edits(text: str) -> Iterator[tuple[int, str]]:
    """Yield the places after the ``self`` of methods of mixins, each with its class."""
    for class_ in _CLASS.finditer(text):
        start = class_.end()
        body = function_body(text, class_.start(), start - 1)
        used = set(_USED.findall(body))
        is_decorated = text[: class_.start()].rstrip("\n").rpartition("\n")[2].startswith("@")
        if not used or is_decorated or "def __init__(" in body:
            continue
        if any(f"def {name}(" in body or f"self.{name} =" in body for name in used):
            continue
        methods = [*_METHOD.finditer(text, start, start + len(body))]
        indent = min((method["indent"] for method in methods), key=len, default="")
        for method in methods:
            if method["indent"] == indent:
                yield method.end("self"), class_[1]
