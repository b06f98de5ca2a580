"""TY006: operators work on the objects of ROS that they get."""

from __future__ import annotations

from scaffold.api import Diagnostic, Example, Report, TypeRule
from scaffold.api.types import TypeFinding, class_in, full_name, in_words, is_certain

_NODE = (
    "from rclpy.duration import Duration\nfrom rclpy.node import Node\n\n\n"
    "class Ticker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('ticker')\n"
    "        self.start = self.get_clock().now()\n\n"
    "    def tick(self):\n"
    "        return self.get_clock().now() - self.start > {}\n"
)
_NUMBERS = {
    "rclpy.time.Time": "compare .nanoseconds, or use Duration(seconds=...)",
    "rclpy.duration.Duration": "compare .nanoseconds, or use Duration(seconds=...)",
    "builtin_interfaces.msg.Time": "convert it with rclpy.time.Time.from_msg(...)",
    "builtin_interfaces.msg.Duration": "convert it with rclpy.duration.Duration.from_msg(...)",
    "rcl_interfaces.msg.ParameterValue": "use get_parameter(...).value",
    "rclpy.parameter.Parameter": "append .value",
}


class OperatorUnsupported(TypeRule):
    """An operator gets an object of ROS that it does not work on.

    **Why.** ``TypeError: '>' not supported between instances of 'Duration' and 'float'``.

    **Fix.** Use numbers on both sides, or objects of the same kind.

    **Source.** The operators that the classes of ROS 2 Jazzy define.
    """

    code = "TY006"
    name = "operator-unsupported"
    kinds = frozenset({"unsupported-operator"})
    examples = (
        Example("two durations", {"ticker.py": _NODE.format("Duration(seconds=1.0)")}),
        Example(
            "a duration and a number",
            {"ticker.py": _NODE.format("1.0")},
            Report(
                "11:16",
                "'>' does not work on a rclpy.duration.Duration and a float: "
                "TypeError; compare .nanoseconds, or use Duration(seconds=...)",
            ),
        ),
    )

    def judge(self, finding: TypeFinding) -> Diagnostic | None:
        matched = finding.match(
            r"Operator `(?P<operator>[^`]+)` is not supported between (?:two )?objects of type "
            r"`(?P<left>[^`]+)`(?: and `(?P<right>[^`]+)`)?"
        ) or finding.match(
            r"Unary operator `(?P<operator>[^`]+)` is not supported for object of type "
            r"`(?P<left>.+)`"
        )
        if matched is None:
            return None
        types = [matched["left"], matched.groupdict().get("right") or matched["left"]]
        classes = [class_in(type_) for type_ in types]
        if not any(classes) or not all(map(is_certain, types)):
            return None
        operator = matched["operator"]
        pair = " and ".join(dict.fromkeys(map(in_words, types)))
        hints = [_NUMBERS.get(full_name(class_), "") for class_ in classes if class_]
        hint = next(filter(None, hints), "")
        message = f"{operator!r} does not work on {pair}: TypeError"
        return self.report(finding, f"{message}; {hint}" if hint else message)
