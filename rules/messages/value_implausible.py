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
    other_severities = {
        Severity.WARNING: "it is a range or an encoding that other programs may accept"
    }
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
            "yaws: of a quaternion, and for one",
            {
                "turn.py": "import math\n\nfrom geometry_msgs.msg import Pose, Quaternion\n\n\n"
                "def turned(yaw):\n"
                "    half_yaw = yaw / 2\n"
                "    yield Quaternion(z=math.sin(half_yaw), w=math.cos(half_yaw))\n"
                "    yield Quaternion(z=math.sin(yaw / 2), w=math.cos(yaw / 2))\n"
                "    yield Quaternion(z=math.sin(yaw), w=math.cos(yaw))\n\n\n"
                "def yaws(pose: Pose):\n"
                "    yaw = 2 * math.atan2(pose.orientation.z, pose.orientation.w)\n"
                "    yaw = math.atan2(pose.orientation.z, pose.orientation.w)\n"
                "    yaw = pose.orientation.z\n"
                "    half = math.atan2(pose.orientation.z, pose.orientation.w)\n"
                "    return yaw, half\n"
            },
            Report(
                "10:24",
                "a quaternion takes half the angle: write sin(yaw / 2.0) and cos(yaw / 2.0)",
            ),
            Report("15:11", "this is half of the angle: multiply by 2.0"),
            Report(
                "16:11",
                "z of a quaternion is no angle: write 2.0 * "
                "math.atan2(pose.orientation.z, pose.orientation.w), or "
                "euler_from_quaternion()",
            ),
        ),
        Example(
            "the diagonal of a covariance, its first row",
            {
                "odom.py": "from nav_msgs.msg import Odometry\n\n\n"
                "def filled():\n"
                "    odometry = Odometry()\n"
                "    for i in range(6):\n"
                "        odometry.pose.covariance[7 * i] = 0.1\n"
                "    for i in range(6):\n"
                "        odometry.twist.covariance[i] = 0.1\n"
                "    covariance = [0.0] * 9\n"
                "    for i in range(3):\n"
                "        covariance[i] = 0.1\n"
                "    for i in range(36):\n"
                "        odometry.twist.covariance[i] = 0.0\n"
                "    return odometry\n"
            },
            Report(
                "9:9",
                "this fills the first row of the matrix; the variances are on its "
                "diagonal: write [7 * i]",
            ),
            Report(
                "12:9",
                "this fills the first row of the matrix; the variances are on its "
                "diagonal: write [4 * i]",
            ),
        ),
        Example(
            "shapes of an image",
            {
                "look.py": "import numpy as np\nfrom sensor_msgs.msg import Image\n\n\n"
                "def wrong(image: Image):\n"
                "    data = np.frombuffer(image.data, np.uint8)\n"
                "    return data.reshape(image.width, image.height)\n\n\n"
                "def right(image: Image):\n"
                "    width, height = image.width, image.height\n"
                "    return np.frombuffer(image.data, np.uint8).reshape((height, width))\n\n\n"
                "def sizes(pixels):\n"
                "    height, width = pixels.shape[:2]\n"
                "    w, h, _ = pixels.shape\n"
                "    return height, width, w, h\n\n\n"
                "def turned(image: Image):\n"
                "    data = np.frombuffer(image.data, np.uint8)\n"
                "    return data.reshape((image.width, image.height)).T\n"
            },
            Report(
                "7:25", "an image or a map has rows first: write reshape(image.height, image.width)"
            ),
            Report("17:5", "a shape has the height first: write height, width = ....shape[:2]"),
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
            turned = _turned_shape(types, call)
            if turned:
                message = f"an image or a map has rows first: write reshape({turned})"
                yield self.report(module.location(call.args[0]), message)
        for assigned in module.walk(ast.Assign):
            yield from self._check_yaw(types, assigned)
            if _is_shape_turned(assigned) and not module.mentions(*_SHAPED):
                message = "a shape has the height first: write height, width = ....shape[:2]"
                yield self.report(module.location(assigned.targets[0]), message)
            count = _first_row(types, assigned)
            if count:
                message = (
                    f"this fills the first row of the matrix; the variances are on its diagonal: "
                    f"write [{count + 1} * {module.text(_index(assigned.targets[0]))}]"
                )
                yield self.report(module.location(assigned.targets[0]), message)

    def _check_yaw(self, types: MessageTypes, assigned: ast.Assign) -> Iterator[Diagnostic]:
        """Report a yaw that is read from a quaternion as it is, or as half of it."""
        match assigned:
            case ast.Assign(targets=[ast.Name() | ast.Attribute() as name], value=value) if (
                _is_angle(name)
            ):
                problem = _yaw_problem(types, value)
                if problem:
                    yield self.report(types.module.location(value), problem)

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
            elif key == ("geometry_msgs/msg/Quaternion", "z") and (
                angle := _whole_angle(types, item.holder, item.value)
            ):
                message = f"a quaternion takes half the angle: write sin({angle} / 2.0) and "
                yield self.report(at, message + f"cos({angle} / 2.0)")
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


def _whole_angle(types: MessageTypes, holder: ast.expr, z: ast.expr) -> str:
    """Return the yaw whose sine and cosine are z and w, without being halved; empty if none."""
    angle = _argument_of(types, z, "sin")
    if angle is None or not _is_angle(angle):
        return ""
    if isinstance(types.facts.evaluator.single_value(angle), ast.BinOp):
        return ""
    text = types.module.text(angle)
    function = types.module.enclosing_function(holder)
    for item in types.assigned:
        if item.field.name == "w" and types.module.text(item.holder) == types.module.text(holder):
            other = _argument_of(types, item.value, "cos")
            if other is not None and types.module.text(other) == text:
                return text if types.module.enclosing_function(item.holder) is function else ""
    return ""


def _argument_of(types: MessageTypes, node: ast.expr, function: str) -> ast.expr | None:
    """Return the argument of a function of math or numpy."""
    match node:
        case ast.Call(args=[argument]):
            name = types.module.qualified_name(node.func) or ""
            return argument if name in {f"math.{function}", f"numpy.{function}"} else None
    return None


def _yaw_problem(types: MessageTypes, value: ast.expr) -> str:
    """Return what is wrong with a yaw that is read from a quaternion; empty if nothing."""
    match value:
        case ast.Attribute(attr="z", value=holder) if _is_quaternion(types, holder):
            text = types.module.text(holder)
            return (
                "z of a quaternion is no angle: write "
                f"2.0 * math.atan2({text}.z, {text}.w), or euler_from_quaternion()"
            )
        case ast.Call(
            args=[ast.Attribute(attr="z", value=first), ast.Attribute(attr="w", value=second)]
        ) if types.module.text(first) == types.module.text(second):
            name = types.module.qualified_name(value.func)
            is_half = name in {"math.atan2", "numpy.arctan2"} and _is_quaternion(types, first)
            return "this is half of the angle: multiply by 2.0" if is_half else ""
    return ""


def _is_quaternion(types: MessageTypes, node: ast.expr) -> bool:
    """Tell whether an expression is a quaternion: by its type, or as what messages call one."""
    owner = types.type_of(node)
    if owner is not None:
        return owner.name == "geometry_msgs/msg/Quaternion"
    value = types.facts.evaluator.single_value(node)
    return isinstance(value, ast.Attribute) and value.attr in {"orientation", "rotation"}


_SIZES = {36: 6, 9: 3}
"""The rows of the matrices in messages, by their elements."""


def _index(target: ast.expr) -> ast.expr:
    return target.slice if isinstance(target, ast.Subscript) else target


def _first_row(types: MessageTypes, assigned: ast.Assign) -> int:
    """Return the rows of a covariance of which a loop fills the first; 0 for other assignments."""
    match assigned:
        case ast.Assign(targets=[ast.Subscript(value=matrix, slice=ast.Name(id=name))]):
            rows = _SIZES.get(_elements_of(types, matrix), 0)
            loop = types.module.parent(assigned)
            match loop:
                case ast.For(
                    target=ast.Name(id=counter), iter=ast.Call(func=ast.Name("range"), args=[end])
                ) if counter == name and types.facts.evaluator.evaluate(end) == rows:
                    return rows
    return 0


def _elements_of(types: MessageTypes, matrix: ast.expr) -> int:
    """Return the number of elements of a covariance: a field, or a list that is named so."""
    match matrix:
        case ast.Attribute(attr=name) if name.endswith("covariance"):
            type_ = types.field_type_of(matrix)
            return (type_.array_size or 0) if type_ is not None else 0
        case ast.Name(id=name) if "cov" in name:
            match types.facts.evaluator.single_value(matrix):
                case ast.BinOp(left=ast.List(elts=[_]), op=ast.Mult(), right=count):
                    number = types.facts.evaluator.evaluate(count)
                    return number if isinstance(number, int) else 0
    return 0


def _turned_shape(types: MessageTypes, call: ast.Call) -> str:
    """Return the right shape where data of a message is reshaped with its width first."""
    module = types.module
    shape = call.args[0].elts if call.args and isinstance(call.args[0], ast.Tuple) else call.args
    match call.func, [types.facts.evaluator.single_value(item) for item in shape[:2]]:
        case ast.Attribute(attr="reshape"), [
            ast.Attribute(attr="width", value=first),
            ast.Attribute(attr="height", value=second),
        ] if module.text(first) == module.text(second):
            function = module.enclosing_function(call)
            text = module.text(function or module.tree)
            if any(word in text for word in _TURNED):
                return ""
            if any(word.arg == "order" for word in call.keywords):
                return ""
            words = [module.text(item) for item in (shape[1], shape[0], *shape[2:])]
            return ", ".join(words)
    return ""


_ACROSS = frozenset({"w", "width", "cols", "columns", "img_w", "img_width", "image_width"})
_DOWN = frozenset({"h", "height", "rows", "img_h", "img_height", "image_height"})


_SHAPED = (".shape = ", "reshape((w", "reshape(w")
"""What code contains that gives its arrays their width first."""


def _is_shape_turned(assigned: ast.Assign) -> bool:
    """Tell whether the first two numbers of the shape of an image are taken the wrong way."""
    match assigned:
        case ast.Assign(
            targets=[ast.Tuple(elts=[ast.Name(id=first), ast.Name(id=second), *_])],
            value=ast.Attribute(attr="shape", value=image)
            | ast.Subscript(value=ast.Attribute(attr="shape", value=image)),
        ):
            is_plain = not any(word in ast.unparse(image) for word in _TURNED)
            return is_plain and first in _ACROSS and second in _DOWN
    return False
