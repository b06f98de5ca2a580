"""TY008: objects of ROS are called, indexed and looped over only where they can be."""

from __future__ import annotations

from scaffold.api import Diagnostic, Example, Report, TypeRule
from scaffold.api.types import TypeFinding, class_in, in_words, is_certain, is_function

_DOES = {
    "not-callable": "cannot be called",
    "not-subscriptable": "has no elements",
    "not-iterable": "cannot be looped over",
    "invalid-await": "cannot be awaited",
    "invalid-context-manager": "cannot be used in `with`",
    "invalid-raise": "cannot be raised",
}
_NODE = (
    "from geometry_msgs.msg import Point\n\n\n"
    "def height():\n"
    "    point = Point(z=0.5)\n"
    "    return {}\n"
)


class ObjectMisused(TypeRule):
    """An object of ROS is called, indexed, looped over or awaited, and is not made for it.

    **Why.** ``TypeError: 'Point' object is not subscriptable`` as soon as the line runs.

    **Fix.** Use the attributes and methods that the class has.

    **Source.** The classes of ROS 2 Jazzy.
    """

    code = "TY008"
    name = "object-misused"
    kinds = frozenset(_DOES)
    examples = (
        Example("a field", {"height.py": _NODE.format("point.z")}),
        Example(
            "elements of what another function makes of an object",
            {
                "plan.py": "from plans import nested\nfrom rclpy.node import Node\n\n\n"
                "class Planner(Node):\n"
                "    def __init__(self):\n"
                "        super().__init__('planner')\n"
                "        self.plans = self.get_parameters_by_prefix('plans')\n"
                "        self.plans = nested(self.plans)\n\n"
                "    def start(self):\n"
                "        return [plan['start'] for plan in self.plans.values()]\n"
            },
        ),
        Example(
            "an element",
            {"height.py": _NODE.format("point[2]")},
            Report("6:12", "a geometry_msgs.msg.Point has no elements: TypeError"),
        ),
    )

    def judge(self, finding: TypeFinding) -> Diagnostic | None:
        matched = finding.match(
            r"(?:Object of type|Cannot subscript object of type|Cannot raise object of type) "
            r"`(?P<type>[^`]+)`.*"
        ) or finding.match(r"`(?P<type>[^`]+)` is not awaitable.*")
        if matched is None:
            return None
        type_ = matched["type"]
        is_known = class_in(type_) and is_certain(type_)
        if not is_known and not (is_function(type_) and finding.kind != "not-callable"):
            return None
        message = f"{in_words(type_)} {_DOES[finding.kind]}: TypeError"
        return self.report(finding, message)
