"""MS026: values of messages are in the unit and the range that their definitions name."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator, Mapping

from scaffold.api import Diagnostic, Example, MessageRule, Report, Severity
from scaffold.api.messages import MessageTypes

_NODE = (
    "from rclpy.node import Node\nfrom sensor_msgs.msg import BatteryState, Image\n"
    "from geometry_msgs.msg import Quaternion\n\n\n"
    "class Talker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('talker')\n"
    "        self.yaw = 0.0\n\n"
    "    def fill(self, width):\n"
    "        battery = BatteryState()\n"
    "        battery.percentage = {}\n"
    "        image = Image()\n"
    "        image.width = width\n"
    "        image.encoding = '{}'\n"
    "        image.step = {}\n"
    "        return battery, image, Quaternion(z={}, w=1.0)\n"
)
_GOOD = ("0.8", "bgr8", "3 * width", "0.0")
_TURN = 6.3
_RANGES: Mapping[tuple[str, str], tuple[float, float, str]] = {
    ("sensor_msgs/msg/BatteryState", "percentage"): (0, 1, "a share from 0 to 1"),
    ("sensor_msgs/msg/RelativeHumidity", "relative_humidity"): (0, 1, "a share from 0 to 1"),
    ("sensor_msgs/msg/LaserScan", "angle_min"): (-_TURN, _TURN, "in radians"),
    ("sensor_msgs/msg/LaserScan", "angle_max"): (-_TURN, _TURN, "in radians"),
    ("sensor_msgs/msg/LaserScan", "angle_increment"): (-_TURN, _TURN, "in radians"),
    ("sensor_msgs/msg/Range", "field_of_view"): (0, _TURN, "in radians"),
    ("sensor_msgs/msg/NavSatFix", "latitude"): (-90, 90, "in degrees from -90 to 90"),
    ("sensor_msgs/msg/NavSatFix", "longitude"): (-180, 180, "in degrees from -180 to 180"),
    ("vision_msgs/msg/ObjectHypothesis", "score"): (0, 1, "a share from 0 to 1"),
    ("builtin_interfaces/msg/Time", "nanosec"): (0, 999_999_999, "less than a second"),
    ("builtin_interfaces/msg/Duration", "nanosec"): (0, 999_999_999, "less than a second"),
    **{("std_msgs/msg/ColorRGBA", name): (0, 1, "a share from 0 to 1") for name in "rgba"},
    **{("geometry_msgs/msg/Quaternion", name): (-1, 1, "between -1 and 1") for name in "xyzw"},
}
"""What the comments of the definitions say."""
_SHARES = frozenset(key for key, (low, high, _) in _RANGES.items() if (low, high) == (0, 1))
_COLORS = ("rgb", "rgba", "bgr", "bgra")
_BAYER = ("rggb", "bggr", "gbrg", "grbg")
_ENCODINGS = frozenset(
    {f"{name}{bits}" for name in (*_COLORS, "mono") for bits in (8, 16)}
    | {f"bayer_{name}{bits}" for name in _BAYER for bits in (8, 16)}
    | {f"{kind}C{count}" for kind in ("8U", "8S", "16U", "16S", "32S") for count in (1, 2, 3, 4)}
    | {f"{kind}C{count}" for kind in ("32F", "64F") for count in (1, 2, 3, 4)}
    | {"yuv422", "uyvy", "yuv422_yuy2", "yuyv", "nv21", "nv24", "passthrough"}
)
_SHORT = {"bgr": "bgr8", "rgb": "rgb8", "rgba": "rgba8", "bgra": "bgra8"} | dict.fromkeys(
    ("mono", "gray", "grey", "gray8", "grayscale", "greyscale"), "mono8"
)
_OF_CV_BRIDGE = {"imgmsg_to_cv2": 1, "compressed_imgmsg_to_cv2": 1, "cv2_to_imgmsg": 1}
_PERCENT = 100
_WORDS = frozenset({"yaw", "theta", "heading", "psi"})


class ValueImplausible(MessageRule):
    """A message field gets a value that its unit or its definition rules out.

    **Why.** Nothing complains where it is sent: a battery of 8000 %, a robot that turns about
    itself, colors that are white. cv_bridge refuses encodings it does not know:
    ``Unrecognized image encoding [BGR8]``.

    **Fix.** The comments of the definition say the unit: ``ros2 interface show
    sensor_msgs/msg/BatteryState``; a yaw is ``z=sin(yaw / 2)``, ``w=cos(yaw / 2)``.

    **Source.** The definitions in common_interfaces; ``sensor_msgs/image_encodings.hpp``; REP-103.
    """

    code = "MS026"
    name = "value-implausible"
    other_severities = {Severity.WARNING: "a range or an encoding that other programs may accept"}
    examples = (
        Example("plausible", {"talker.py": _NODE.format(*_GOOD)}),
        Example(
            "a percentage; an encoding in capitals; bytes of a row; a yaw",
            {"talker.py": _NODE.format("80.0", "BGR8", "width", "self.yaw")},
            Report("13:30", "percentage is a share from 0 to 1, not 80", severity=Severity.WARNING),
            Report("16:26", "unknown encoding 'BGR8': cv_bridge raises an error; write 'bgr8'"),
            Report("17:22", "step is in bytes: a row of 'bgr8' has 3 * width"),
            Report(
                "18:45",
                "z of a quaternion is no angle: write z=sin(self.yaw / 2.0) and "
                "w=cos(self.yaw / 2.0)",
            ),
        ),
        Example(
            "a share times 100; an encoding of one's own; a color",
            {
                "talker.py": _NODE.format("100.0 * width", "h264", *_GOOD[2:]),
                "b.py": "from std_msgs.msg import ColorRGBA\n\n\n"
                "def white():\n    return ColorRGBA(r=255.0, a=1.0)\n",
            },
            Report("b.py:5:24", "r is a share from 0 to 1, not 255", severity=Severity.WARNING),
            Report(
                "talker.py:13:30",
                "percentage is a share from 0 to 1, not a percentage; leave out 100",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "an encoding for cv_bridge",
            {
                "b.py": "from cv_bridge import CvBridge\nfrom sensor_msgs.msg import Image\n\n\n"
                "def convert(image: Image):\n"
                "    bridge = CvBridge()\n"
                "    frame = bridge.imgmsg_to_cv2(image, desired_encoding='BGR8')\n"
                "    return bridge.cv2_to_imgmsg(frame, 'bgr')\n",
            },
            Report("7:58", "unknown encoding 'BGR8': CvBridgeError; write 'bgr8'"),
            Report("8:40", "unknown encoding 'bgr': CvBridgeError; write 'bgr8'"),
        ),
        Example(
            "rows for columns",
            {
                "map.py": "from nav_msgs.msg import MapMetaData\n\n\n"
                "def describe(grid):\n    info = MapMetaData()\n"
                "    info.width = grid.shape[0]\n    info.height = grid.shape[1]\n"
                "    return info\n\n\n"
                "def turned(grid):\n    info = MapMetaData()\n"
                "    info.width = grid.shape[0]\n    info.height = grid.shape[1]\n"
                "    return info, grid.T\n"
            },
            Report(
                "6:18", "grid.shape[0] is the number of rows, the height; width is grid.shape[1]"
            ),
        ),
    )

    def check_file(self, types: MessageTypes) -> Iterator[Diagnostic]:
        yield from self._check_values(types)
        module = types.module
        for item in types.assigned:
            key = (item.owner.name, item.field.name)
            if key in _WIDTHS and _is_height(types, item.holder, item.value):
                text = module.text(item.value).rpartition("[")[0]
                message = f"{text}[0] is the number of rows, the height; width is {text}[1]"
                yield self.report(module.location(item.value), message)
        for call in module.walk(ast.Call):
            yield from self._check_call(types, call)

    def _check_values(self, types: MessageTypes) -> Iterator[Diagnostic]:
        module = types.module
        for item in types.assigned:
            key = (item.owner.name, item.field.name)
            at = module.location(item.value)
            value = types.facts.evaluator.evaluate(item.value)
            if key == ("geometry_msgs/msg/Quaternion", "z") and _is_angle(item.value):
                text = module.text(item.value)
                message = (
                    f"z of a quaternion is no angle: write z=sin({text} / 2.0) and "
                    f"w=cos({text} / 2.0)"
                )
                yield self.report(at, message)
            elif key in _RANGES and isinstance(value, int | float) and not isinstance(value, bool):
                low, high, meaning = _RANGES[key]
                if value < low or value > high:
                    message = f"{item.field.name} is {meaning}, not {value:g}"
                    yield self.report(at, message, severity=Severity.WARNING)
            elif key in _SHARES and _is_times_hundred(types, item.value):
                message = (
                    f"{item.field.name} is a share from 0 to 1, not a percentage; leave out 100"
                )
                yield self.report(at, message, severity=Severity.WARNING)
            elif key == ("sensor_msgs/msg/Image", "encoding") and isinstance(value, str):
                near = _meant(value)
                if near:
                    message = (
                        f"unknown encoding {value!r}: cv_bridge raises an error; write {near!r}"
                    )
                    yield self.report(at, message)
            elif key == ("sensor_msgs/msg/Image", "step"):
                yield from self._check_step(types, item.holder, item.value)

    def _check_step(
        self, types: MessageTypes, holder: ast.expr, step: ast.expr
    ) -> Iterator[Diagnostic]:
        """Report a row with as many bytes as pixels, although a pixel has several."""
        module = types.module
        name = module.text(holder)
        function = module.enclosing_function(holder)
        given = {
            item.field.name: item.value
            for item in types.assigned
            if module.text(item.holder) == name
            and module.enclosing_function(item.holder) is function
        }
        encoding = types.facts.evaluator.evaluate(given["encoding"]) if "encoding" in given else ""
        if not isinstance(encoding, str) or "width" not in given:
            return
        encoding = encoding.lower()
        width = module.text(given["width"])
        count = len(encoding.rstrip("168")) if encoding.rstrip("168") in _COLORS else 1
        count *= 2 if encoding.endswith("16") else 1
        if count > 1 and module.text(step) in {width, f"{name}.width"}:
            message = f"step is in bytes: a row of {encoding!r} has {count} * {width}"
            yield self.report(module.location(step), message)

    def _check_call(self, types: MessageTypes, call: ast.Call) -> Iterator[Diagnostic]:
        """Report encodings that cv_bridge does not know."""
        module = types.module
        name = call.func.attr if isinstance(call.func, ast.Attribute) else ""
        if name not in _OF_CV_BRIDGE or "cv_bridge" not in module.imports_by_root:
            return
        given = call.args[1:2] + [
            word.value for word in call.keywords if word.arg in {"desired_encoding", "encoding"}
        ]
        for node in given:
            value = types.facts.evaluator.evaluate(node)
            near = _meant(value) if isinstance(value, str) else ""
            if near:
                message = f"unknown encoding {value!r}: CvBridgeError; write {near!r}"
                yield self.report(module.location(node), message)


_WIDTHS = frozenset(
    {("nav_msgs/msg/MapMetaData", "width"), ("sensor_msgs/msg/Image", "width")}
    | {("sensor_msgs/msg/CameraInfo", "width")}
)
_TURNED = (".T", "transpose", "swapaxes", "rot90", "'F'", '"F"', "moveaxis")


def _is_height(types: MessageTypes, holder: ast.expr, width: ast.expr) -> bool:
    """Tell whether ``width`` is ``shape[0]`` and ``height`` ``shape[1]`` of an array as it is."""
    module = types.module
    function = module.enclosing_function(holder)
    match width:
        case ast.Subscript(value=ast.Attribute(attr="shape"), slice=ast.Constant(value=0)) if (
            function is not None and not any(word in module.text(function) for word in _TURNED)
        ):
            rows = module.text(width.value)
            return any(
                item.field.name == "height"
                and module.text(item.holder) == module.text(holder)
                and module.text(item.value) == f"{rows}[1]"
                for item in types.assigned
                if module.enclosing_function(item.holder) is function
            )
    return False


def _meant(encoding: str) -> str:
    """Return the encoding that an unknown one stands for; empty if it may be one of its own."""
    if encoding in _ENCODINGS or re.fullmatch(r"(8|16|32|64)[USF]C\d+", encoding):
        return ""
    known = {name.lower(): name for name in _ENCODINGS}
    lower = encoding.lower().replace("-", "").replace(" ", "")
    letters = sorted(lower)
    near = (name for name in sorted(known) if sorted(name) == letters)
    return _SHORT.get(lower) or known.get(lower) or next(near, "")


def _is_times_hundred(types: MessageTypes, node: ast.expr) -> bool:
    """Tell whether an expression is a product with 100."""
    if not (isinstance(node, ast.BinOp) and isinstance(node.op, ast.Mult)):
        return False
    values = [types.facts.evaluator.evaluate(part) for part in (node.left, node.right)]
    return any(value == _PERCENT for value in values)


def _is_angle(node: ast.expr) -> bool:
    """Tell whether an expression is a yaw by its name."""
    match node:
        case ast.Name(id=name) | ast.Attribute(attr=name):
            return not _WORDS.isdisjoint(re.split(r"[_\d]+", name.lower()))
        case ast.Call(args=[value], func=ast.Name(id="float") | ast.Attribute(attr="radians")):
            return _is_angle(value)
    return False
