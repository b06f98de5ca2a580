"""ND112: tf2 buffers have a listener before transforms are looked up."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, RclpyRule, Report, Severity
from scaffold.api.install import is_uncalled
from scaffold.api.programs import in_constructors, phases_of, spins_elsewhere
from scaffold.api.python import caught_around
from scaffold.api.rclpy import (
    RclpyFile,
    buffer_made,
    buffers_in,
    is_spun_by_listener,
    is_used_elsewhere,
    lookups_in,
)

_ASKING = ("lookup_transform", "can_transform", "transform", "wait_for_transform")
_NODE = (
    "from rclpy.node import Node\nfrom rclpy.time import Time\n"
    "from tf2_ros import Buffer, TransformListener\n\n\n"
    "class Follower(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('follower')\n"
    "        self.buffer = Buffer()\n"
    "{}\n"
    "    def tick(self):\n"
    "        self.buffer.lookup_transform('map', 'base_link', Time())\n"
)
_LISTEN = "        self.listener = TransformListener(self.buffer, self)\n"


class TransformBufferEmpty(RclpyRule):
    """Transforms are looked up in a buffer without a listener, or before any can arrive.

    **Why.** ``LookupException: "map" passed to lookupTransform argument target_frame does not
    exist``, every time: a ``Buffer`` only gets transforms from a ``TransformListener``, which only
    receives them while the node is spun.

    **Fix.** Create ``self.listener = TransformListener(self.buffer, self)``; look transforms up in
    callbacks.

    **Source.** ``tf2_ros/transform_listener.py``.
    """

    code = "ND112"
    name = "transform-buffer-empty"
    other_severities = {Severity.WARNING: "nothing calls the methods that look transforms up"}
    examples = (
        Example("a listener", {"follower.py": _NODE.format(_LISTEN)}),
        Example(
            "no listener",
            {"follower.py": _NODE.format("")},
            "9:23: no TransformListener fills this buffer: every lookup fails; add "
            "TransformListener(buffer, node)",
        ),
        Example(
            "no listener, and a program that never looks anything up",
            {
                "follower.py": _NODE.format("")
                + "\n\ndef main():\n    rclpy.init()\n    rclpy.spin(Follower())\n"
            },
            Report(
                "9:23",
                "no TransformListener fills this buffer: every lookup fails; add "
                "TransformListener(buffer, node)",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "looked up in the constructor",
            {"follower.py": _NODE.format(_LISTEN + "        self.tick()\n")},
            "14:9: lookup_transform() in the constructor of Follower: no transform is received "
            "before the node is spun; look up transforms in a callback",
        ),
        Example(
            "created in a callback",
            {
                "follower.py": "from rclpy.node import Node\nfrom rclpy.time import Time\n"
                "from tf2_ros import Buffer, TransformListener\n\n\n"
                "class Follower(Node):\n"
                "    def __init__(self):\n"
                "        super().__init__('follower')\n"
                "        self.create_timer(1.0, self.tick)\n\n"
                "    def tick(self):\n"
                "        buffer = Buffer()\n"
                "        TransformListener(buffer, self)\n"
                "        self.at = buffer.lookup_transform('map', 'base_link', Time())\n"
            },
            "12:18: this buffer is created on every call, so it is empty: every lookup fails; "
            "create buffer and listener in the constructor",
        ),
        Example(
            "passed to another object",
            {"follower.py": _NODE.format("        self.fill(self.buffer)\n")},
        ),
    )

    def check_in(self, package: Package, file: RclpyFile) -> Iterator[Diagnostic]:
        if not file.module.mentions("tf2_ros") or file.module.in_tests:
            return
        for made in buffers_in(file):
            lookups = _only_lookups(package, file, made)
            if lookups:
                message = (
                    "no TransformListener fills this buffer: every lookup fails; "
                    "add TransformListener(buffer, node)"
                )
                path = file.module.path
                is_unused = all(is_uncalled(package, path, item.lineno) for item in lookups)
                severity = Severity.WARNING if is_unused else None
                yield self.report(file.module.location(made), message, severity=severity)
            elif _is_made_to_ask(file, made):
                message = (
                    "this buffer is created on every call, so it is empty: every lookup fails; "
                    "create buffer and listener in the constructor"
                )
                yield self.report(file.module.location(made), message)
        if is_spun_by_listener(file) or spins_elsewhere(file):
            return
        functions = {executed.function: executed.origin for executed in in_constructors(file)}
        for lookup in lookups_in(file):
            function = file.function_of(lookup.call)
            if function not in functions or lookup.method not in _ASKING:
                continue
            if any(spin.function in functions for spin in file.spin_calls):
                continue
            if function is None or caught_around(file.module, lookup.call):
                continue
            message = (
                f"{lookup.method}() in {functions[function]}: no transform is received before the "
                f"node is spun; look up transforms in a callback"
            )
            yield self.report(file.module.location(lookup.call), message)


def _is_made_to_ask(file: RclpyFile, made: ast.Call) -> bool:
    """Return whether a callback creates a buffer for its own lookups."""
    function = file.function_of(made)
    return (
        function in phases_of(file).running
        and not file.is_conditional(made)
        and not is_spun_by_listener(file)
        and any(
            buffer_made(file, lookup.buffer) is made and file.function_of(lookup.call) is function
            for lookup in lookups_in(file)
        )
    )


def _only_lookups(package: Package, file: RclpyFile, made: ast.Call) -> list[ast.expr]:
    """Return the uses of a buffer if all of them look up transforms."""
    attribute, variable = file.stored_in(made)
    uses: list[ast.expr]
    if attribute:
        uses = [x for x in file.module.index.attributes(attribute) if isinstance(x.ctx, ast.Load)]
        if is_used_elsewhere(package, file, attribute):
            return []
    elif variable:
        uses = [x for x in file.module.index.names(variable) if isinstance(x.ctx, ast.Load)]
    else:
        return []
    parents = [file.module.parent(use) for use in uses]
    is_asked = all(
        isinstance(parent, ast.Attribute) and parent.attr.startswith(_ASKING) for parent in parents
    )
    return uses if is_asked else []
