"""Return values of functions, and whether they may end without one."""

from __future__ import annotations

import ast

import pytest

from scaffold.model.python.evaluation.returns import may_end


@pytest.mark.parametrize(
    ("body", "ends"),
    [
        ("    return 1\n", False),
        ("    try:\n        return Answer.YES\n    except OSError:\n        log()\n", False),
        ("    try:\n        return ask()\n    except OSError:\n        log()\n", True),
        ("    try:\n        return ask()\n    except OSError:\n        raise\n", False),
    ],
)
def test_handlers_of_code_that_cannot_raise_are_unreachable(body: str, ends: bool) -> None:
    function = ast.parse(f"def f():\n{body}").body[0]
    assert isinstance(function, ast.FunctionDef)
    assert may_end(function) is ends


@pytest.mark.parametrize(
    ("condition", "ends"),
    [("True", False), ("rclpy.ok()", False), ("rclpy.ok() and self.is_busy", True), ("0", True)],
)
def test_loop_until_shutdown_does_not_end_early(condition: str, *, ends: bool) -> None:
    function = ast.parse(f"def f():\n    while {condition}:\n        step()\n").body[0]
    assert isinstance(function, ast.FunctionDef)
    assert may_end(function) is ends
