"""MS031: images are converted from the order of colors that they have."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, MessageRule, Report
from scaffold.api.messages import MessageTypes

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


class ColorOrderSwapped(MessageRule):
    """An image with red first is treated as one with blue first, or the other way round.

    **Why.** Red and blue are swapped, and nothing complains: thresholds in HSV find nothing, or
    the wrong object.

    **Fix.** Ask cv_bridge for ``bgr8``, which OpenCV works with, or use ``COLOR_RGB2...``.

    **Source.** OpenCV, ``cvtColor``; cv_bridge tutorial: "bgr8" is what OpenCV expects.
    """

    code = "MS031"
    name = "color-order-swapped"
    examples = (
        Example("as OpenCV expects it", {"a.py": _NODE.format("'bgr8'", *["COLOR_BGR2HSV"] * 2)}),
        Example("swapped on purpose", {"a.py": _NODE.format("'rgb8'", *["COLOR_BGR2RGB"] * 2)}),
        Example(
            "an order that is not known", {"a.py": _NODE.format("ORDER", *["COLOR_BGR2HSV"] * 2)}
        ),
        Example(
            "red for blue",
            {
                "a.py": _NODE.format("desired_encoding='rgb8'", "COLOR_BGR2HSV", "COLOR_RGB2GRAY"),
                "b.py": _FILE.format("rgb8"),
                "c.py": _FILE.format("bgr8"),
            },
            Report(
                "a.py:9:35",
                "'frame' is RGB, but COLOR_BGR2HSV takes BGR: red and blue are "
                "swapped; use COLOR_RGB2HSV",
            ),
            Report("b.py:8:12", "'frame' is BGR, but is sent as RGB: red and blue are swapped"),
        ),
    )

    def check_file(self, types: MessageTypes) -> Iterator[Diagnostic]:
        module = types.module
        if not {"cv2", "cv_bridge"} <= module.imports_by_root.keys():
            return
        for call in module.walk(ast.Call):
            match call:
                case ast.Call(args=[ast.Name() as image, code, *_]) if (
                    module.qualified_name(call.func) == "cv2.cvtColor"
                ):
                    name = (module.qualified_name(code) or "").removeprefix("cv2.")
                    wanted = _CODE.fullmatch(name)
                    order = _order(types, image)
                    if wanted is not None and order == _OTHER[wanted[1]]:
                        message = (
                            f"{image.id!r} is {order}, but {name} takes {wanted[1]}: red and blue "
                            f"are swapped; use {name.replace(wanted[1], order, 1)}"
                        )
                        yield self.report(module.location(code), message)
                case ast.Call(func=ast.Attribute(attr="cv2_to_imgmsg"), args=[ast.Name() as image]):
                    order = _order(types, image)
                    wanted_order = _ORDER.get(_encoding(types, call, "encoding"), "")
                    if order and wanted_order and order != wanted_order:
                        message = (
                            f"{image.id!r} is {order}, but is sent as {wanted_order}: red and "
                            "blue are swapped"
                        )
                        yield self.report(module.location(call), message)


def _order(types: MessageTypes, image: ast.Name) -> str:
    """Return the order of colors that an image has; empty if it is not known."""
    made = types.facts.evaluator.single_value(image)
    if not isinstance(made, ast.Call):
        return ""
    if types.module.qualified_name(made.func) == "cv2.imread":
        return "BGR" if len(made.args) == 1 and not made.keywords else ""
    if isinstance(made.func, ast.Attribute) and made.func.attr == "imgmsg_to_cv2":
        return _ORDER.get(_encoding(types, made, "desired_encoding"), "")
    return ""


def _encoding(types: MessageTypes, call: ast.Call, keyword: str) -> str:
    given = [word.value for word in call.keywords if word.arg == keyword] or call.args[1:2]
    value = types.facts.evaluator.evaluate(given[0]) if given else ""
    return value if isinstance(value, str) else ""
