"""Fields with the lower and the upper limit of other values."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Mapping

from scaffold.api.messages import MessageTypes

_LIMITS: Mapping[str, tuple[str, str]] = {
    "sensor_msgs/msg/LaserScan": ("range_min", "range_max"),
    "sensor_msgs/msg/MultiEchoLaserScan": ("range_min", "range_max"),
    "sensor_msgs/msg/Range": ("min_range", "max_range"),
}


def flaws(types: MessageTypes) -> Iterator[tuple[ast.expr, str]]:
    """Yield lower limits that are greater than the upper ones, so that every reading is invalid."""
    set_together: dict[tuple[ast.AST | None, str, str], dict[str, ast.expr]] = {}
    for item in types.assigned:
        if item.field.name in _LIMITS.get(item.owner.name, ()):
            at = item.holder if isinstance(item.holder, ast.Call) else None
            place: ast.AST | None = at or types.module.enclosing_function(item.holder)
            key = (place, types.module.text(item.holder), item.owner.name)
            set_together.setdefault(key, {})[item.field.name] = item.value
    for (_, _, owner), values in set_together.items():
        low, high = _LIMITS[owner]
        least, most = (types.file.evaluator.number(values.get(name)) for name in (low, high))
        if isinstance(least, int | float) and isinstance(most, int | float) and least > most:
            problem = f"{low} {least:g} is greater than {high} {most:g}: all readings are invalid"
            yield values[low], problem
