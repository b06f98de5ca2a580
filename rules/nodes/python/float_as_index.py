"""ND135: indices are integers."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, PythonRule
from scaffold.api.python import PythonModule, is_expected
from scaffold.api.rclpy import RclpyFile, rclpy_file

_HEAD = (
    "from rclpy.node import Node\nfrom sensor_msgs.msg import LaserScan\n\n\n"
    "class Front(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('front')\n"
    "        self.create_subscription(LaserScan, 'scan', self.on_scan, 10)\n\n"
    "    def on_scan(self, scan):\n"
)
_NODE = _HEAD + (
    "        middle = len(scan.ranges) {} 2\n"
    "        front = scan.ranges[middle - 5:middle + 5]\n"
    "        for number in range(len(front) {} 2):\n"
    "            self.near = front[number] < 1.0\n"
)
_AHEAD = _HEAD + (
    "        middle = len(scan.ranges) {0} 2\n"
    "        self.ahead = scan.ranges[middle] + scan.ranges[len(scan.ranges) {0} 4]\n"
)


class FloatAsIndex(PythonRule):
    """The result of a division is an index, or bounds a slice or a range.

    **Why.** ``/`` always returns a float: ``TypeError: slice indices must be integers``, or
    ``'float' object cannot be interpreted as an integer``.

    **Fix.** Use ``//`` or ``int(...)``.

    **Source.** Python documentation, "Numeric Types".
    """

    code = "ND135"
    name = "float-as-index"
    examples = (
        Example("integers", {"front.py": _NODE.format("//", "//")}),
        Example("the middle beam of a scan", {"front.py": _AHEAD.format("//")}),
        Example(
            "the middle beam of a scan, by a division",
            {"front.py": _AHEAD.format("/")},
            "12:34: a float cannot be an index: TypeError; divide with //",
            "12:56: a float cannot be an index: TypeError; divide with //",
        ),
        Example(
            "divisions",
            {"front.py": _NODE.format("/", "/")},
            "12:29: a float cannot be a slice index: TypeError; divide with //",
            "12:40: a float cannot be a slice index: TypeError; divide with //",
            "13:29: range() does not accept a float: TypeError; divide with //",
        ),
        Example(
            "converted later",
            {
                "front.py": _NODE.format("/", "//").replace(
                    "        front =", "        middle = int(middle)\n        front ="
                )
            },
        ),
        Example(
            "numpy.arange, and a path as a key",
            {
                "other.py": "import numpy as np\n\n\n"
                "def numbers(count, folder, files):\n"
                "    return np.arange(count / 2), files[folder / 'a.yaml']\n"
            },
        ),
        Example(
            "pixels of OpenCV, and the size of an array",
            {
                "mark.py": "import cv2\nimport numpy as np\n\n\n"
                "def mark(image):\n"
                "    height, width = image.shape[:2]\n"
                "    middle = (width / 2, height // 2)\n"
                "    cv2.circle(image, middle, 5, (0, 0, 255), -1)\n"
                "    cv2.line(image, (0, 0), (width // 2, int(height / 2)), (0, 0, 255))\n"
                "    return np.zeros((height, width / 2))\n"
            },
            "7:15: cv2.circle() does not accept a float here: it fails; divide with //",
            "10:30: numpy.zeros() does not accept a float here: it fails; divide with //",
        ),
    )

    def check_in(self, package: Package, module: PythonModule) -> Iterator[Diagnostic]:
        file = rclpy_file(package, module.path)
        yield from self._check_slices(file)
        for subscript in module.walk(ast.Subscript):
            if _is_of_own_length(file, subscript) and not is_expected(
                module, subscript, "TypeError"
            ):
                message = "a float cannot be an index: TypeError; divide with //"
                yield self.report(module.location(subscript.slice), message)
        for call in module.calls_of("range"):
            for given in call.args:
                if _is_quotient(file, given) and not is_expected(module, call, "TypeError"):
                    message = "range() does not accept a float: TypeError; divide with //"
                    yield self.report(module.location(given), message)

        for name, places in _OF_INTEGERS.items():
            for call in module.calls_of(name):
                for at in places:
                    for given in call.args[at : at + 1]:
                        yield from self._check_pair(file, name, given)

    def _check_pair(self, file: RclpyFile, name: str, given: ast.expr) -> Iterator[Diagnostic]:
        """Check a position or size that is a pair of integers."""
        pair = file.evaluator.single_value(given)
        for part in pair.elts if isinstance(pair, ast.Tuple) else ():
            if _is_quotient(file, part) and not is_expected(file.module, given, "TypeError"):
                message = f"{name}() does not accept a float here: it fails; divide with //"
                yield self.report(file.module.location(part), message)
                break

    def _check_slices(self, file: RclpyFile) -> Iterator[Diagnostic]:
        module = file.module
        for node in module.walk(ast.Slice):
            if _is_of_labels(module, node):
                continue
            for bound in (node.lower, node.upper, node.step):
                if bound is not None and _is_quotient(file, bound):
                    message = "a float cannot be a slice index: TypeError; divide with //"
                    if not is_expected(module, node, "TypeError"):
                        yield self.report(module.location(bound), message)


_OF_INTEGERS = {
    **dict.fromkeys(("cv2.circle", "cv2.drawMarker", "cv2.resize", "cv2.ellipse"), (1,)),
    **dict.fromkeys(("cv2.line", "cv2.rectangle", "cv2.arrowedLine"), (1, 2)),
    "cv2.putText": (2,),
    **dict.fromkeys(("numpy.zeros", "numpy.ones", "numpy.empty", "numpy.full"), (0,)),
}
"""Functions of OpenCV and NumPy with positions or sizes, and the argument indexes."""


def _is_of_labels(module: PythonModule, node: ast.Slice) -> bool:
    """Return whether a slice is one of pandas, where labels may have any type."""
    subscript = module.enclosing(node, ast.Subscript)
    holder = subscript.value if subscript is not None else None
    return isinstance(holder, ast.Attribute) and holder.attr == "loc"


def _is_of_own_length(file: RclpyFile, node: ast.Subscript) -> bool:
    """Return whether an index is a quotient of the length of the indexed list."""
    index = file.evaluator.single_value(node.slice) or node.slice
    if not isinstance(node.slice, ast.Name | ast.BinOp) or not _is_quotient(file, index):
        return False
    holder = ast.dump(node.value)
    lengths = (
        call.args[0]
        for call in ast.walk(index)
        if isinstance(call, ast.Call)
        and isinstance(call.func, ast.Name)
        and call.func.id == "len"
        and len(call.args) == 1
    )
    return any(ast.dump(measured) == holder for measured in lengths)


def _is_quotient(file: RclpyFile, node: ast.expr) -> bool:
    """Return whether a value is certainly computed by a division."""
    match node:
        case ast.BinOp(op=ast.Div(), left=left, right=right):
            texts = (x.value for x in (left, right) if isinstance(x, ast.Constant))
            return not any(isinstance(text, str) for text in texts)
        case ast.BinOp(op=ast.Add() | ast.Sub() | ast.Mult(), left=left, right=right):
            return _is_quotient(file, left) or _is_quotient(file, right)
        case ast.Name():
            value = file.evaluator.single_value(node)
            return value is not node and _is_quotient(file, value)
    return False
