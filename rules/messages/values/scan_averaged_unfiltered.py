"""MS032: distances of a scan are filtered before they are added up."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, MessageRule, Severity
from scaffold.api.messages import MessageTypes

_NODE = (
    "import math\n\nimport numpy as np\nfrom rclpy.node import Node\n"
    "from sensor_msgs.msg import LaserScan\n\n\n"
    "class Guard(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('guard')\n"
    "        self.create_subscription(LaserScan, 'scan', self.on_scan, 10)\n\n"
    "    def on_scan(self, msg):\n"
    "        near = {}\n"
    "        self.get_logger().info(f'{{near}} {{math.pi}} {{np.pi}}')\n"
)
_SUMS = frozenset(
    {"numpy.mean", "numpy.average", "numpy.sum", "numpy.std", "numpy.var", "statistics.mean"}
    | {"statistics.fmean", "math.fsum"}
)
_ARRAYS = frozenset({"numpy.array", "numpy.asarray"})
_FILTERS = frozenset(
    {"isfinite", "isinf", "isnan", "nan_to_num", "range_max", "range_min", "inf", "where", "clip"}
)


class ScanAveragedUnfiltered(MessageRule):
    """The distances of a laser scan are added up or averaged without filtering.

    **Why.** A beam without a return is ``inf`` or ``nan``, and so are the sum and the mean: a
    comparison with them never detects an obstacle.

    **Fix.** Use only finite values: ``ranges = np.array(msg.ranges)``, then
    ``ranges[np.isfinite(ranges)].mean()``.

    **Source.** ``sensor_msgs/msg/LaserScan``: values out of the range should be discarded; REP 117.
    """

    code = "MS032"
    name = "scan-averaged-unfiltered"
    severity = Severity.WARNING
    examples = (
        Example(
            "mean of finite ranges, minimum of all ranges",
            {
                "guard.py": _NODE.format("np.mean([x for x in msg.ranges if math.isfinite(x)])"),
                "a.py": _NODE.format("min(msg.ranges)"),
                "b.py": _NODE.format("sum(msg.ranges) / 360 if not math.isinf(1.0) else 0.0"),
            },
        ),
        Example(
            "mean and sum of unfiltered ranges",
            {"guard.py": _NODE.format("np.mean(msg.ranges[:30]), sum(msg.ranges)")},
            "14:16: beams without a return are inf, and so is this result; filter them with "
            "isfinite()",
            "14:42: beams without a return are inf, and so is this result; filter them with "
            "isfinite()",
        ),
        Example(
            "array with infinite values replaced, array filtered for one of two means",
            {
                "a.py": _NODE.format(
                    "0.0\n        values = np.array(msg.ranges)\n"
                    "        values[np.isinf(values)] = msg.range_max\n"
                    "        near = values.mean()"
                ),
                "b.py": _NODE.format(
                    "0.0\n        values = np.array(msg.ranges)\n"
                    "        near = values.mean() - values[np.isfinite(values)].mean()"
                ),
            },
            "b.py:16:16: beams without a return are inf, and so is this result; filter them with "
            "isfinite()",
        ),
        Example(
            "mean of an unfiltered NumPy array",
            {"guard.py": _NODE.format("np.array(msg.ranges).mean()")},
            "14:16: beams without a return are inf, and so is this result; filter them with "
            "isfinite()",
        ),
    )

    def check_file(self, types: MessageTypes) -> Iterator[Diagnostic]:
        for call in types.module.walk(ast.Call) if types.module.mentions("ranges") else ():
            summed = _summed(types, call)
            if (
                summed is not None
                and _is_of_scan(types, summed)
                and not _is_filtered(types, call, summed)
            ):
                message = (
                    "beams without a return are inf, and so is this result; filter them with "
                    "isfinite()"
                )
                yield self.report(types.module.location(call), message)


def _summed(types: MessageTypes, call: ast.Call) -> ast.expr | None:
    """Return the summed argument of a call."""
    match call:
        case ast.Call(func=ast.Name(id="sum"), args=[values]):
            return values
        case ast.Call(func=ast.Attribute(attr="mean" | "sum" | "std", value=values), args=[]):
            return values
        case ast.Call(args=[values, *_]) if types.module.qualified_name(call.func) in _SUMS:
            return values
    return None


def _is_of_scan(types: MessageTypes, node: ast.expr) -> bool:
    """Return whether an expression is the ranges of a scan, or a slice of them."""
    match node:
        case ast.Subscript(value=whole, slice=ast.Slice()):
            return _is_of_scan(types, whole)
        case ast.Call(func=func, args=[whole, *_]):
            is_array = types.module.qualified_name(func) in _ARRAYS
            return is_array and _is_of_scan(types, whole)
        case ast.Attribute(attr="ranges", value=holder):
            owner = types.type_of(holder)
            return owner is not None and owner.name == "sensor_msgs/msg/LaserScan"
        case ast.Name():
            value = types.file.evaluator.single_value(node)
            return value is not None and value is not node and _is_of_scan(types, value)
    return False


def _is_filtered(types: MessageTypes, call: ast.Call, summed: ast.expr) -> bool:
    """Return whether the function replaces or checks invalid ranges first."""
    function = types.module.enclosing_function(call) or types.module.tree
    if isinstance(summed, ast.Name):
        return any(
            isinstance(node.ctx, ast.Store)
            and isinstance(node.value, ast.Name)
            and node.value.id == summed.id
            for node in types.module.below(function, ast.Subscript)
        )
    words = {node.attr for node in types.module.below(function, ast.Attribute)}
    words |= {node.id for node in types.module.below(function, ast.Name)}
    return not words.isdisjoint(_FILTERS)
