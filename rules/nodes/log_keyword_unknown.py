"""ND059: loggers get known options."""

from __future__ import annotations

from collections.abc import Iterator
from difflib import get_close_matches

from scaffold.api import Diagnostic, Example, RclpyRule, Report
from scaffold.api.rclpy import RclpyFile, log_calls

_KNOWN = ("throttle_duration_sec", "throttle_time_source_type", "skip_first", "once", "name")
_NODE = (
    "from rclpy.node import Node\n\n\n"
    "class Talker(Node):\n"
    "    def tell(self, text):\n"
    "        self.get_logger().info({})\n"
)


class LogKeywordUnknown(RclpyRule):
    """A logger gets an unknown option.

    **Why.** ``TypeError: parameter "throttle" is not one of the recognized logging options``.

    **Fix.** ``throttle_duration_sec``, ``skip_first``, ``once``.

    **Source.** ``rclpy/impl/rcutils_logger.py``.
    """

    code = "ND059"
    name = "log-keyword-unknown"
    examples = (
        Example(
            "known option", {"talker.py": _NODE.format("f'{text}', throttle_duration_sec=1.0")}
        ),
        Example(
            "an option of another logger",
            {
                "talker.py": _NODE.format("text, internal=True")
                + "\n    def get_logger(self):\n        return self.log\n"
            },
        ),
        Example(
            "unknown option",
            {"talker.py": _NODE.format("text, throttle=1.0")},
            Report(
                "6:38",
                "a logger has no option 'throttle': TypeError; did you mean "
                "'throttle_duration_sec'?",
            ),
        ),
    )

    def check_file(self, file: RclpyFile) -> Iterator[Diagnostic]:
        for call in log_calls(file):
            for word in call.keywords:
                if word.arg is None or word.arg in (*_KNOWN, "message"):
                    continue
                near = get_close_matches(word.arg, _KNOWN, 1, 0.5)
                hint = f"; did you mean {near[0]!r}?" if near else ""
                message = f"a logger has no option {word.arg!r}: TypeError{hint}"
                yield self.report(file.module.location(word), message)
