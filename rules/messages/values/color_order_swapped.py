"""MS031: images are converted from their actual color order."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, MessageRule
from scaffold.api.messages import MessageTypes
from scaffold.api.python import argument_of

_NODE = (
    "import cv2\nfrom cv_bridge import CvBridge\nfrom sensor_msgs.msg import Image\n\n\n"
    "def find(msg: Image):\n"
    "    bridge = CvBridge()\n"
    "    frame = bridge.imgmsg_to_cv2(msg, {})\n"
    "    swapped = cv2.cvtColor(frame, cv2.{})\n"
    "    return frame, swapped, cv2.cvtColor(frame, cv2.{})\n"
)
_FILE = (
    "import cv2\nfrom cv_bridge import CvBridge\nfrom sensor_msgs.msg import Image\n\n\n"
    "def load(path, bridge: CvBridge) -> Image:\n"
    "    frame = cv2.imread(path)\n"
    "    return bridge.cv2_to_imgmsg(frame, encoding='{}')\n"
)
_ORDER = {"bgr8": "BGR", "bgra8": "BGR", "rgb8": "RGB", "rgba8": "RGB"}
_OTHER = {"BGR": "RGB", "RGB": "BGR"}
# linear: a name of OpenCV
_CODE = re.compile(r"COLOR_(BGR|RGB)A?2(?!BGR|RGB)\w+")


# linear: a name of OpenCV
_CONVERTED = re.compile(r"COLOR_(?:BGR2(?=RGB)|RGB2(?=BGR)|(?:GRAY|HSV|HLS|YUV|LAB)2)(BGR|RGB)")


class ColorOrderSwapped(MessageRule):
    """An RGB image is treated as BGR, or the reverse.

    **Why.** Red and blue are swapped without an error: HSV thresholds match nothing, or the wrong
    object. For a gray image with a color encoding, cv_bridge raises ``CvBridgeError``.

    **Fix.** Request ``bgr8``, the order of OpenCV, from cv_bridge, or convert the image with
    ``COLOR_RGB2...``.

    **Source.** OpenCV, ``cvtColor``; cv_bridge tutorial: "bgr8" is what OpenCV expects.
    """

    code = "MS031"
    name = "color-order-swapped"
    examples = (
        Example(
            "bgr8, the order that OpenCV expects",
            {"a.py": _NODE.format("'bgr8'", *["COLOR_BGR2HSV"] * 2)},
        ),
        Example(
            "rgb8 converted with COLOR_BGR2RGB",
            {"a.py": _NODE.format("'rgb8'", *["COLOR_BGR2RGB"] * 2)},
        ),
        Example(
            "encoding from a variable", {"a.py": _NODE.format("ORDER", *["COLOR_BGR2HSV"] * 2)}
        ),
        Example(
            "image of unknown encoding, converted twice",
            {
                "a.py": _FILE.format("rgb8").replace(
                    "cv2.imread(path)",
                    "bridge.imgmsg_to_cv2(path)\n"
                    "    frame = cv2.cvtColor(frame, cv2.COLOR_BGR2RGB)\n"
                    "    frame = cv2.cvtColor(frame, cv2.COLOR_RGB2BGR)",
                )
            },
        ),
        Example(
            "rgb8 image treated as BGR, BGR image published as rgb8",
            {
                "a.py": _NODE.format("desired_encoding='rgb8'", "COLOR_BGR2HSV", "COLOR_RGB2GRAY"),
                "b.py": _FILE.format("rgb8"),
                "c.py": _FILE.format("bgr8"),
            },
            "a.py:9:35: 'frame' is RGB, but COLOR_BGR2HSV takes BGR: red and blue are swapped; "
            "use COLOR_RGB2HSV",
            "b.py:8:12: 'frame' is BGR, but is sent as RGB: red and blue are swapped",
        ),
        Example(
            "gray image published as bgr8 and rgb8",
            {
                "a.py": _FILE.format("bgr8").replace(
                    "cv2.imread(path)", "cv2.cvtColor(path, cv2.COLOR_BGR2GRAY)"
                ),
                "b.py": _FILE.format("rgb8").replace(
                    "frame = cv2.imread(path)",
                    "gray = cv2.cvtColor(path, cv2.COLOR_BGR2GRAY)\n"
                    "    _, frame = cv2.threshold(gray, 120, 255, cv2.THRESH_BINARY)",
                ),
                "c.py": _FILE.format("mono8").replace("imread(path)", "inRange(path, 1, 2)"),
            },
            "a.py:8:12: 'frame' is gray, but is sent as BGR: CvBridgeError; write 'mono8'",
            "b.py:9:12: 'frame' is gray, but is sent as RGB: CvBridgeError; write 'mono8'",
        ),
        Example(
            "bgr8 image passed to a method that treats it as RGB",
            {
                "a.py": "import cv2\nfrom cv_bridge import CvBridge\n"
                "from sensor_msgs.msg import Image\n\n\n"
                "class Finder:\n"
                "    def on_image(self, msg: Image):\n"
                "        image = CvBridge().imgmsg_to_cv2(msg, 'bgr8')\n"
                "        self.find(image)\n\n"
                "    def find(self, frame):\n"
                "        return cv2.cvtColor(frame, cv2.COLOR_RGB2HSV)\n"
            },
            "12:36: 'frame' is BGR, but COLOR_RGB2HSV takes RGB: red and blue are swapped; use "
            "COLOR_BGR2HSV",
        ),
        Example(
            "converted images and camera frames published with the wrong encoding",
            {
                "a.py": _FILE.format("bgr8").replace(
                    "cv2.imread(path)", "cv2.cvtColor(path, cv2.COLOR_BGR2RGB)"
                ),
                "b.py": _FILE.format("rgb8").replace(
                    "frame = cv2.imread(path)",
                    "camera = cv2.VideoCapture(path)\n    ok, frame = camera.read()",
                ),
                "c.py": _FILE.format("rgb8").replace(
                    "cv2.imread(path)", "cv2.cvtColor(path, cv2.COLOR_BGR2RGB)"
                ),
                "e.py": _FILE.format("bgr8").replace(
                    "frame = cv2.imread(path)",
                    "frame = cv2.imread(path)\n    frame = cv2.cvtColor(frame, cv2.COLOR_BGR2RGB)",
                ),
                "f.py": _FILE.format("rgb8").replace("encoding=", ""),
                "d.py": _FILE.format("bgr8").replace(
                    "frame = cv2.imread(path)",
                    "image = bridge.imgmsg_to_cv2(path, 'rgb8')\n"
                    "    frame = cv2.cvtColor(image, cv2.COLOR_BGR2RGB)",
                ),
            },
            "a.py:8:12: 'frame' is RGB, but is sent as BGR: red and blue are swapped",
            "b.py:9:12: 'frame' is BGR, but is sent as RGB: red and blue are swapped",
            "e.py:9:12: 'frame' is RGB, but is sent as BGR: red and blue are swapped",
            "f.py:8:12: 'frame' is BGR, but is sent as RGB: red and blue are swapped",
        ),
    )

    def check_file(self, types: MessageTypes) -> Iterator[Diagnostic]:
        module = types.module
        if module.in_tests or not {"cv2", "cv_bridge"} <= module.imports_by_root.keys():
            return
        for call in module.walk(ast.Call):
            match call:
                case ast.Call(args=[ast.Name() as image, code, *_]) if (
                    module.qualified_name(call.func) == "cv2.cvtColor"
                ):
                    name = (module.qualified_name(code) or "").removeprefix("cv2.")
                    wanted = _CODE.fullmatch(name)
                    order = _color_order(types, image)
                    if wanted is not None and order == _OTHER[wanted[1]]:
                        message = (
                            f"{image.id!r} is {order}, but {name} takes {wanted[1]}: red and blue "
                            f"are swapped; use {name.replace(wanted[1], order, 1)}"
                        )
                        yield self.report(module.location(code), message)
                case ast.Call(
                    func=ast.Attribute(attr="cv2_to_imgmsg"), args=[ast.Name() as image, *_]
                ):
                    problem = _sent_problem(types, call, image)
                    if problem:
                        yield self.report(module.location(call), problem)


def _sent_problem(types: MessageTypes, call: ast.Call, image: ast.Name) -> str:
    """Return why an image does not match the encoding it is sent with; empty if it may."""
    wanted = _ORDER.get(_encoding(types, call, "encoding"), "")
    if wanted and _is_gray(types, image):
        return f"{image.id!r} is gray, but is sent as {wanted}: CvBridgeError; write 'mono8'"
    order = _color_order(types, image)
    if order and wanted and order != wanted:
        return f"{image.id!r} is {order}, but is sent as {wanted}: red and blue are swapped"
    return ""


def _is_gray(types: MessageTypes, image: ast.Name) -> bool:
    """Return whether an image was converted to grayscale or a mask, and only filtered since."""
    for _ in range(_MAX_DEPTH):
        made = _thresholded(types, image) or _made(types, image)
        if not isinstance(made, ast.Call) or not made.args:
            return False
        names = [types.module.qualified_name(node) or "" for node in (made.func, *made.args[1:2])]
        if names[0] in {"cv2.cvtColor", "cv2.inRange"}:
            return names[0] == "cv2.inRange" or names[-1].endswith("2GRAY")
        if names[0] not in _FILTERS or not isinstance(made.args[0], ast.Name):
            return False
        image = made.args[0]
    return False


def _thresholded(types: MessageTypes, image: ast.Name) -> ast.Call | None:
    """Return the ``cv2.threshold`` call if it is the only value of an image."""
    bound = types.module.index.only_node(image)
    if bound is None:
        return None
    match types.module.parent(types.module.parent(bound) or image):
        case ast.Assign(
            targets=[ast.Tuple(elts=[_, ast.Name(id=name)])], value=ast.Call() as made
        ) if name == image.id:
            is_threshold = types.module.qualified_name(made.func) == "cv2.threshold"
            return made if is_threshold else None
    return None


_FILTERS = frozenset(
    f"cv2.{name}"
    for name in (
        *("GaussianBlur", "medianBlur", "blur", "bilateralFilter", "resize", "flip", "rotate"),
        *("equalizeHist", "dilate", "erode", "Canny", "threshold", "adaptiveThreshold"),
    )
)
_MAX_DEPTH = 5
"""The maximum number of conversions to trace an image through."""


def _color_order(types: MessageTypes, image: ast.Name, depth: int = _MAX_DEPTH) -> str:
    """Return the color order of an image; empty if unknown."""
    if _is_frame(types, image):
        return "BGR"
    passed = _passed(types, image)
    if passed is not None:
        return _color_order(types, passed, depth - 1) if depth else ""
    made = _made(types, image)
    if not isinstance(made, ast.Call):
        return ""
    if types.module.qualified_name(made.func) == "cv2.imread":
        return "BGR" if len(made.args) == 1 and not made.keywords else ""
    if isinstance(made.func, ast.Attribute) and made.func.attr == "imgmsg_to_cv2":
        return _ORDER.get(_encoding(types, made, "desired_encoding"), "")
    return _converted_order(types, made, depth)


def _passed(types: MessageTypes, image: ast.Name) -> ast.Name | None:
    """Return the image passed for a parameter in the only call of a function."""
    module = types.module
    parameter = types.file.parameter_of(image)
    function = module.enclosing_function(image)
    if parameter is None or function is None or _value_before(types, image) is not None:
        return None
    names = [argument.arg for argument in function.args.args]
    uses = [*module.index.names(function.name), *module.index.attributes(function.name)]
    match [module.parent(use) for use in uses], uses:
        case [ast.Call(func=called, args=given, keywords=[]) as call], [use] if called is use:
            place = names.index(parameter.arg) - int(isinstance(use, ast.Attribute))
            value = given[place] if 0 <= place < len(given) else None
            is_own = types.file.callback(call.func).function is function
            return value if is_own and isinstance(value, ast.Name) else None
    return None


def _converted_order(types: MessageTypes, call: ast.Call, depth: int) -> str:
    """Return the color order of the result of ``cv2.cvtColor``; empty for other calls."""
    if types.module.qualified_name(call.func) != "cv2.cvtColor" or not call.args[1:]:
        return ""
    code = (types.module.qualified_name(call.args[1]) or "").removeprefix("cv2.")
    converted = _CONVERTED.fullmatch(code)
    if converted is None:
        return ""
    image = call.args[0]
    if not code.startswith(("COLOR_BGR", "COLOR_RGB")) or not isinstance(image, ast.Name):
        return converted[1]
    before = _color_order(types, image, depth - 1) if depth else ""
    # What unknown code passes has the order that the name of the conversion says.
    is_given = types.file.parameter_of(image) is not None and _passed(types, image) is None
    return _OTHER.get(before) or (converted[1] if is_given else "")


def _made(types: MessageTypes, image: ast.Name) -> object:
    """Return the expression that an image is the value of, if any."""
    return _value_before(types, image) or types.file.evaluator.single_value(image)


def _value_before(types: MessageTypes, image: ast.Name) -> ast.expr | None:
    """Return the last value of a name that is set several times in the same block."""
    module = types.module
    lookup = module.index.lookup(image.id, image)
    statement = module.enclosing(image, ast.stmt)
    if lookup is None or len(lookup[1]) < _SEVERAL or statement is None:
        return None
    block = getattr(module.parent(statement), "body", [])
    before = block[: block.index(statement)] if statement in block else []
    for earlier in reversed(before):
        match earlier:
            case ast.Assign(targets=[ast.Name(id=name)], value=value) if name == image.id:
                return value
        names = [x for x in ast.walk(earlier) if isinstance(x, ast.Name)]
        if any(x.id == image.id and not isinstance(x.ctx, ast.Load) for x in names):
            return None
    return None


_SEVERAL = 2


def _is_frame(types: MessageTypes, image: ast.Name) -> bool:
    """Return whether an image is from an OpenCV camera: ``ok, frame = capture.read()``."""
    bound = types.module.index.only_node(image)
    if bound is None:
        return False
    match types.module.parent(types.module.parent(bound) or image):
        case ast.Assign(
            targets=[ast.Tuple(elts=[_, ast.Name(id=name)])],
            value=ast.Call(func=ast.Attribute(attr="read", value=camera), args=[], keywords=[]),
        ) if name == image.id:
            made = types.file.evaluator.single_value(camera)
            return (
                isinstance(made, ast.Call)
                and types.module.qualified_name(made.func) == "cv2.VideoCapture"
                and not types.module.mentions("CAP_PROP_CONVERT_RGB")
            )
    return False


def _encoding(types: MessageTypes, call: ast.Call, keyword: str) -> str:
    given = argument_of(call, keyword, 1)
    value = types.file.evaluator.evaluate(given) if given is not None else ""
    return value if isinstance(value, str) else ""
