"""MS023: messages are not used as lists or dicts, nor plain values as messages."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator, Mapping

from scaffold.api import Diagnostic, Example, MessageRule
from scaffold.api.messages import MessageClass, MessageTypes, is_error_expected, kind_of_field
from scaffold.api.python import is_expected

from . import _arrays

_NODE = (
    "from rclpy.node import Node\nfrom std_msgs.msg import Float32MultiArray, String\n\n\n"
    "class Listener(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('listener')\n"
    "        self.create_subscription(String, 'chatter', self.on_chatter, 10)\n"
    "        self.create_subscription(Float32MultiArray, 'row', self.on_row, 10)\n\n"
    "    def on_chatter(self, msg):\n"
    "        self.get_logger().info({})\n\n"
    "    def on_row(self, msg):\n"
    "        return {}\n"
)


class MessageUsedAsValue(MessageRule):
    """A message is used as a list, number, string or function, or a plain value as a message.

    **Why.** ``TypeError: 'String' object is not subscriptable``, ``AttributeError: 'str' object
    has no attribute 'data'``: in a callback, the first message crashes the node. ``msg == 'go'``
    is always false, and ``if msg:`` is always true, whatever the message contains.

    **Fix.** Read the field: ``msg.data``, ``msg.data[0]``, ``len(msg.data)``.

    **Source.** ``rosidl_generator_py``: messages are objects with one property for each field;
    fields of plain types are ``bool``, ``int``, ``float`` and ``str``.
    """

    code = "MS023"
    name = "message-used-as-value"
    examples = (
        Example(
            "fields used as values",
            {"listener.py": _NODE.format("msg.data.upper()", "len(msg.data), msg.data[0]")},
        ),
        Example(
            "fields written as JSON",
            {
                "listener.py": "import json\n\n"
                + _NODE.format("msg.data", "json.dumps([{'row': msg.data}, msg.layout])")
                + "\n    def on_row_sent(self, msg: Float32MultiArray):\n"
                "        row = {'row': list(msg.data)}\n"
                "        return json.dumps(row), json.dumps({'row': msg.data}, default=list)\n",
            },
            "17:36: JSON cannot contain msg.data, an array.array: TypeError; write list(msg.data)",
            "17:47: JSON cannot contain msg.layout, a std_msgs/msg/MultiArrayLayout: TypeError; "
            "write its fields",
        ),
        Example(
            "messages in format strings: plain, and formatted as numbers",
            {
                "listener.py": _NODE.format(
                    "f'{msg} {msg!r:>9} ' + '%s' % msg", "f'{msg:.2f}', '%d' % msg"
                )
            },
            "15:16: std_msgs/msg/Float32MultiArray takes no format specification: TypeError; use "
            "one of its fields",
            "15:30: std_msgs/msg/Float32MultiArray is not a number: TypeError; use one of its "
            "fields",
        ),
        Example(
            "messages indexed like a dict or a list",
            {"listener.py": _NODE.format("msg['data']", "len(msg), msg[0], msg.layout[0]")},
            "12:32: std_msgs/msg/String cannot be indexed: TypeError; use one of its fields",
            "15:16: std_msgs/msg/Float32MultiArray has no length: TypeError; use one of its fields",
            "15:26: std_msgs/msg/Float32MultiArray cannot be indexed: TypeError; use one of its "
            "fields",
            "15:34: std_msgs/msg/MultiArrayLayout cannot be indexed: TypeError; use one of its "
            "fields",
        ),
        Example(
            ".data of a str, field called like a method, loop over a message",
            {
                "listener.py": _NODE.format(
                    "msg.data.data", "msg.layout.data_offset(), [x for x in msg]"
                )
            },
            "12:32: msg.data is a str, which has no 'data': AttributeError",
            "15:16: msg.layout.data_offset is a field, not a method: TypeError; remove the ()",
            "15:54: std_msgs/msg/Float32MultiArray is not iterable: TypeError; use one of its "
            "fields",
        ),
        Example(
            "message used as JSON text and as a number",
            {
                "listener.py": "import json\n\n"
                + _NODE.format("json.loads(msg)['a']", "float(msg), msg + 1, msg > 1.0, 2 in msg")
            },
            "14:32: std_msgs/msg/String is not text: TypeError; use one of its fields",
            "17:16: std_msgs/msg/Float32MultiArray is not a number: TypeError; use one of its "
            "fields",
            "17:28: std_msgs/msg/Float32MultiArray cannot be used in arithmetic: TypeError; use "
            "one of its fields",
            "17:37: std_msgs/msg/Float32MultiArray cannot be ordered: TypeError; use one of its "
            "fields",
            "17:48: std_msgs/msg/Float32MultiArray is not iterable: TypeError; use one of its "
            "fields",
        ),
        Example(
            "fields used as JSON text and as numbers",
            {
                "listener.py": "import json\n\n"
                + _NODE.format(
                    "json.loads(msg.data)['a'] + msg.data if msg else str(msg)",
                    "float(msg.data[0]), msg.data[0] + 1, msg.data[0] > 1.0, 2 in msg.data",
                )
            },
        ),
        Example(
            "message compared with a str, message unpacked",
            {
                "listener.py": _NODE.format(
                    "msg == 'go'", "0\n\n    def on_reset(self):\n        a, b = String()"
                )
            },
            "12:32: std_msgs/msg/String never equals 'go'; compare one of its fields",
            "18:16: std_msgs/msg/String cannot be unpacked: TypeError; use one of its fields",
        ),
        Example(
            "Bool message as a condition",
            {"listener.py": _NODE.replace("String", "Bool").format("'on' if msg else 'off'", "0")},
            "12:40: std_msgs/msg/Bool is always true, whatever it holds; use its field 'data'",
        ),
        Example(
            "field as a condition, None check of a stored message",
            {
                "listener.py": _NODE.replace("String", "Bool").format(
                    "'on' if msg.data else 'off'",
                    "0\n\n    def on_reset(self):\n        self.last = None\n"
                    "        if self.last:\n            self.last = Bool()",
                )
            },
        ),
        Example(
            "for loop over a message",
            {
                "listener.py": _NODE.format("''", "0").replace(
                    "        return", "        for x in msg:\n            print(x)\n        return"
                )
            },
            "15:18: std_msgs/msg/Float32MultiArray is not iterable: TypeError; use one of its "
            "fields",
        ),
        Example(
            "length of an array field, comparison of one element",
            {
                "listener.py": _NODE.format(
                    "''", "[x for x in range(len(msg.data))], msg.data[0] > 1"
                )
            },
        ),
        Example(
            "array field used as a number",
            {
                "listener.py": _NODE.format(
                    "''", "range(msg.data), float(msg.data), msg.data > 1.0, range(msg.data[0])"
                )
            },
            "15:16: msg.data is an array, not a number: TypeError; use len(msg.data)",
            "15:33: msg.data is an array, not a number: TypeError; use one of its elements",
            "15:50: msg.data is an array, not a number: TypeError; compare its elements",
            "15:66: msg.data[0] is a float, not an integer: TypeError",
        ),
        Example(
            "array field used as a NumPy array, number concatenated with a str",
            {
                "listener.py": _NODE.format(
                    "''", "msg.data + 0.5, msg.data.min(), 'row ' + msg.data[0], msg.data * 2"
                )
            },
            "15:16: msg.data is an array.array, not a NumPy array: TypeError; use "
            "numpy.array(msg.data)",
            "15:32: msg.data is an array.array, not a NumPy array: it has no 'min': "
            "AttributeError; use numpy.array(msg.data)",
            "15:48: msg.data[0] is a number, which cannot be added to a str: TypeError; use an "
            "f-string",
        ),
        Example(
            "messages passed to NumPy and OpenCV functions",
            {
                "look.py": "import cv2\nimport numpy as np\nfrom geometry_msgs.msg import Point\n"
                "from rclpy.node import Node\nfrom sensor_msgs.msg import Image\n\n\n"
                "class Look(Node):\n"
                "    def __init__(self):\n"
                "        super().__init__('look')\n"
                "        self.create_subscription(Image, 'image', self.on_image, 10)\n"
                "        self.create_subscription(Point, 'point', self.on_point, 10)\n\n"
                "    def on_image(self, msg):\n"
                "        cv2.imwrite('a.png', msg)\n"
                "        cv2.line(np.zeros((msg.height, msg.width)), (0, 0), (9, 9), 255)\n\n"
                "    def on_point(self, msg):\n"
                "        return np.linalg.norm(msg), np.linalg.norm([msg.x, msg.y, msg.z])\n"
            },
            "15:9: sensor_msgs/msg/Image is not an image of OpenCV: cv2.error; convert it with "
            "CvBridge",
            "19:16: geometry_msgs/msg/Point is not a number: TypeError; use one of its fields",
        ),
        Example(
            "map data indexed by row and column",
            {
                "look.py": "import numpy as np\nfrom nav_msgs.msg import OccupancyGrid\n"
                "from rclpy.node import Node\n\n\n"
                "class Look(Node):\n"
                "    def __init__(self):\n"
                "        super().__init__('look')\n"
                "        self.grid = None\n"
                "        self.create_subscription(OccupancyGrid, 'map', self.on_map, 10)\n\n"
                "    def on_map(self, msg):\n"
                "        self.grid = msg\n"
                "        self.table = np.array(msg.data).reshape(10, 10)\n\n"
                "    def cell(self, x, y):\n"
                "        row = self.grid.data[y * 10:][x]\n"
                "        return self.grid.data[y][x], self.table[y][x], row\n"
            },
            "18:16: self.grid.data is one array, row by row, whose elements are numbers: "
            "TypeError; write self.grid.data[row * width + column]",
        ),
        Example(
            "array fields passed to NumPy and OpenCV, column of read_points()",
            {
                "look.py": "import cv2\nimport numpy as np\nfrom rclpy.node import Node\n"
                "from sensor_msgs.msg import CompressedImage, PointCloud2\n"
                "from sensor_msgs_py import point_cloud2\n\n\n"
                "class Look(Node):\n"
                "    def __init__(self):\n"
                "        super().__init__('look')\n"
                "        self.create_subscription(CompressedImage, 'image', self.on_image, 10)\n"
                "        self.create_subscription(PointCloud2, 'points', self.on_cloud, 10)\n\n"
                "    def on_image(self, msg):\n"
                "        cv2.imdecode(np.frombuffer(msg.data, np.uint8), 1)\n"
                "        cv2.imdecode(np.fromstring(msg.data, np.uint8), 1)\n"
                "        cv2.imdecode(msg.data, 1)\n\n"
                "    def on_cloud(self, msg):\n"
                "        points = point_cloud2.read_points(msg, field_names=['x', 'y', 'z'])\n"
                "        heights = points[:, 2]\n"
                "        rows = point_cloud2.read_points_numpy(msg)\n"
                "        return heights, points['z'], rows[:, 2]\n"
            },
            "16:22: np.fromstring() does not accept msg.data, an array.array: TypeError; use "
            "numpy.frombuffer()",
            "17:9: cv2.imdecode() does not accept msg.data, an array.array: cv2.error; use "
            "numpy.frombuffer(msg.data, numpy.uint8)",
            "21:19: read_points() returns an array with one dimension, whose fields have names: "
            "IndexError; write ['x'], or use read_points_numpy()",
        ),
        Example(
            "wrong number of values in a shape, wrong order in reshape(), mean of read_points()",
            {
                "look.py": "import numpy as np\nfrom cv_bridge import CvBridge\n"
                "from nav_msgs.msg import OccupancyGrid\n"
                "from sensor_msgs.msg import Image, PointCloud2\n"
                "from sensor_msgs_py.point_cloud2 import read_points\n\n\n"
                "class Look:\n"
                "    def decode(self, image: Image):\n"
                "        return CvBridge().imgmsg_to_cv2(image, 'bgr8')\n\n"
                "    def size(self, image: Image):\n"
                "        made = self.decode(image)\n"
                "        rows, columns = made.shape\n"
                "        rows, columns = made.shape[:2]\n"
                "        rows, columns, _ = made.shape\n"
                "        gray = CvBridge().imgmsg_to_cv2(image, 'mono8')\n"
                "        rows, columns, _ = gray.shape\n\n"
                "    def pixels(self, image: Image, grid: OccupancyGrid):\n"
                "        flat = np.frombuffer(image.data, dtype=np.uint8)\n"
                "        cells = np.array(grid.data).reshape(grid.info.height, grid.info.width)\n"
                "        return cells, flat.reshape((image.width, image.height, 3))\n\n"
                "    def middle(self, cloud: PointCloud2):\n"
                "        points = read_points(cloud, field_names=('x', 'y', 'z'))\n"
                "        return np.mean(points, axis=0), np.mean(points['x'])\n"
            },
            "14:25: made.shape has three values for bgr8: ValueError; write made.shape[:2] for "
            "rows and columns",
            "18:28: gray.shape has two values for mono8: ValueError",
            "23:23: the shape is (rows, columns); write image.height, image.width",
            "27:24: mean() cannot use structured points: TypeError; use read_points_numpy()",
        ),
        Example(
            "attribute that is False before it is a message, or its field",
            {
                f"{name}.py": "from rclpy.node import Node\nfrom std_msgs.msg import Bool\n\n\n"
                "class Watch(Node):\n"
                "    def __init__(self):\n"
                "        super().__init__('watch')\n"
                "        self.running = False\n"
                "        self.create_subscription(Bool, 'running', self.on_state, 10)\n\n"
                "    def on_state(self, msg):\n"
                f"        self.running = {value}\n\n"
                "    def check(self, level):\n"
                "        if self.running and level > 0.2:\n"
                "            self.get_logger().info('running')\n"
                for name, value in (("right", "msg.data"), ("wrong", "msg"))
            },
            "wrong.py:15:12: std_msgs/msg/Bool is always true, whatever it holds; use its field "
            "'data'",
        ),
        Example(
            "a message in a function of math",
            {"listener.py": "import math\n" + _NODE.format("msg.data", "math.sqrt(msg)")},
            "16:16: std_msgs/msg/Float32MultiArray is not a number: TypeError; use one of its "
            "fields",
        ),
    )

    def check_file(self, types: MessageTypes) -> Iterator[Diagnostic]:
        for node, problem in _problems(types):
            if is_error_expected(types.module, node):
                continue
            if not is_expected(types.module, node, "TypeError"):
                yield self.report(types.module.location(node), problem)


def _problems(types: MessageTypes) -> Iterator[tuple[ast.expr, str]]:
    module = types.module
    for node, value, problem in (*_uses_as_list(types), *_uses_as_value(types), *_in_texts(types)):
        owner = _message(types, value)
        if owner is not None:
            yield node, f"{owner.name} {problem}: {_HINTS.get(problem, _HINT)}"
    yield from _arrays.problems(types)
    for node in module.walk(ast.Compare):
        yield from _compared(types, node)
    yield from _always_true(types)
    for call in module.walk(ast.Call):
        if isinstance(call.func, ast.Attribute) and (
            types.type_of(call.func) or kind_of_field(types.field_type_of(call.func))
        ):
            yield (
                call,
                f"{module.text(call.func)} is a field, not a method: TypeError; remove the ()",
            )
    for node in module.walk(ast.Attribute):
        kind = kind_of_field(types.field_type_of(node.value))
        if kind and not hasattr(_arrays.KINDS[kind], node.attr):
            message = f"{module.text(node.value)} is a {kind}, which has no {node.attr!r}"
            yield node, f"{message}: AttributeError"


def _message(types: MessageTypes, node: ast.expr) -> MessageClass | None:
    """Return the message type of an expression; ND095 covers those of parameters."""
    owner = types.type_of(node)
    return None if owner and owner.interface.full_name == _PARAMETER_VALUE else owner


def _uses_as_value(types: MessageTypes) -> Iterator[tuple[ast.expr, ast.expr, str]]:
    """Yield uses that only numbers, strings or sequences support."""
    module = types.module
    for call in module.walk(ast.Call):
        match call:
            case ast.Call(func=func, args=[value, *_]):
                problem = _problem_in_call(types, func)
                if problem:
                    yield call, value, problem
                if (types.module.qualified_name(func) or "").startswith("cv2."):
                    yield from ((call, image, _NO_IMAGE) for image in call.args)
    for assignment in module.walk(ast.Assign):
        if isinstance(assignment.targets[0], ast.Tuple | ast.List):
            yield assignment.value, assignment.value, "cannot be unpacked"
    for node in module.walk(ast.BinOp):
        for value, other in ((node.left, node.right), (node.right, node.left)):
            if _message(types, value) and _is_plain(types, other) and not _is_format(node):
                yield node, value, "cannot be used in arithmetic"


def _in_texts(types: MessageTypes) -> Iterator[tuple[ast.expr, ast.expr, str]]:
    """Yield the values formatted as numbers."""
    for text in types.module.walk(ast.JoinedStr):
        for part in text.values:
            match part:
                case ast.FormattedValue(value=value, conversion=-1, format_spec=ast.expr()):
                    yield text, value, "takes no format specification"
    for node in types.module.walk(ast.BinOp):
        match node:
            case ast.BinOp(left=ast.Constant(value=str(form)), op=ast.Mod(), right=value):
                if _WANTS_NUMBER.search(form):
                    yield node, value, "is not a number"


def _problem_in_call(types: MessageTypes, func: ast.expr) -> str:
    if isinstance(func, ast.Name) and types.module.index.lookup(func.id, func) is None:
        return _REFUSED_BY.get(func.id, "")
    name = types.module.qualified_name(func) or ""
    if name in _OF_NUMBERS:
        return "is not a number"
    return _REFUSED_BY.get(name) or ("is not a number" if name.startswith("math.") else "")


def _compared(types: MessageTypes, node: ast.Compare) -> Iterator[tuple[ast.expr, str]]:
    """Yield the problem of a message that is compared with a plain value."""
    if len(node.ops) != 1:
        return
    right = node.comparators[0]
    operator = node.ops[0]
    if isinstance(operator, ast.In | ast.NotIn):
        owner = types.type_of(right)
        if owner is not None:
            yield node, f"{owner.name} is not iterable: TypeError; use one of its fields"
        return
    for value, other in ((node.left, right), (right, node.left)):
        owner = _message(types, value)
        if owner is None or not _is_plain(types, other):
            continue
        if isinstance(operator, ast.Eq | ast.NotEq):
            text = types.module.text(other)
            yield node, f"{owner.name} never equals {text}; compare one of its fields"
        elif isinstance(operator, ast.Lt | ast.LtE | ast.Gt | ast.GtE):
            yield node, f"{owner.name} cannot be ordered: TypeError; use one of its fields"


def _is_plain(types: MessageTypes, node: ast.expr) -> bool:
    """Return whether an expression is a constant, or a field of a plain type."""
    value = types.file.evaluator.evaluate(node)
    return type(value) in _arrays.KINDS.values() or bool(kind_of_field(types.field_type_of(node)))


def _is_format(node: ast.BinOp) -> bool:
    return isinstance(node.op, ast.Mod)


def _always_true(types: MessageTypes) -> Iterator[tuple[ast.expr, str]]:
    """Yield messages with a flag that are conditions themselves."""
    for node in _truth_tests(types):
        owner = types.type_of(node)
        is_certain = owner is not None and not _may_be_none(types, node)
        if owner is None and isinstance(node, ast.Attribute):
            owner = _type_besides_flags(types, node)
            is_certain = owner is not None
        fields = owner.section.fields if owner else ()
        if owner and is_certain and [field.type.name for field in fields] == ["bool"]:
            name = fields[0].name
            yield node, f"{owner.name} is always true, whatever it holds; use its field {name!r}"


def _type_besides_flags(types: MessageTypes, node: ast.Attribute) -> MessageClass | None:
    """Return the type of the messages that an attribute is set to, besides True and False."""
    values = types.file.evaluator.attribute_values(node) or ()
    flags = [x for x in values if isinstance(x, ast.Constant) and isinstance(x.value, bool)]
    owners = [types.type_of(value) for value in values if value not in flags]
    is_one = bool(flags and owners) and all(owner == owners[0] for owner in owners)
    return owners[0] if is_one else None


def _truth_tests(types: MessageTypes) -> Iterator[ast.expr]:
    tests = [node.test for node in types.module.walk(ast.If)]
    tests += [node.test for node in types.module.walk(ast.IfExp)]
    for test in tests:
        yield from test.values if isinstance(test, ast.BoolOp) else [test]
    for negation in types.module.walk(ast.UnaryOp):
        if isinstance(negation.op, ast.Not):
            yield negation.operand


def _may_be_none(types: MessageTypes, node: ast.expr) -> bool:
    """Return whether an expression is more than the argument of a callback or a field."""
    return types.file.parameter_of(node) is None and types.field_type_of(node) is None


def _uses_as_list(types: MessageTypes) -> Iterator[tuple[ast.expr, ast.expr, str]]:
    """Yield uses that only collections support: the expression, the collection, the problem."""
    for index in types.module.walk(ast.Subscript):
        yield index, index.value, "cannot be indexed"
    for call in types.module.walk(ast.Call):
        match call:
            case ast.Call(func=ast.Name(id="len"), args=[counted]):
                yield call, counted, "has no length"
    for loop in types.module.walk(ast.For):
        yield loop.iter, loop.iter, "is not iterable"
    for part in types.module.walk(ast.comprehension):
        yield part.iter, part.iter, "is not iterable"


_WANTS_NUMBER = re.compile(r"%[-+ #]*[0-9]*(?:\.[0-9]+)?[dioxXeEfFgG]")
"""Matches a number placeholder in a ``%`` format."""
_NO_IMAGE = "is not an image of OpenCV"
_HINT = "TypeError; use one of its fields"
_HINTS = {_NO_IMAGE: "cv2.error; convert it with CvBridge"}
_OF_NUMBERS = frozenset(
    {f"numpy.{name}" for name in ("sqrt", "sin", "cos", "tan", "arctan2", "hypot", "isnan", "exp")}
    | {"numpy.linalg.norm", "numpy.cross", "numpy.deg2rad", "numpy.rad2deg"}
)
"""NumPy functions of numbers or arrays of numbers."""
_PARAMETER_VALUE = "rcl_interfaces/msg/ParameterValue"
_REFUSED_BY: Mapping[str, str] = {
    **dict.fromkeys(("float", "int", "abs", "round"), "is not a number"),
    **dict.fromkeys(("list", "tuple", "set", "sorted", "sum", "enumerate"), "is not iterable"),
    "json.loads": "is not text",
}
"""The errors of functions that do not accept a message."""
