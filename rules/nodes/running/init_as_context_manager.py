"""ND007: ``rclpy.init()`` is a context manager on newer distributions only."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, RclpyRule
from scaffold.api.distributions import target
from scaffold.api.rclpy import RclpyFile, known_names

_WITH = "import rclpy\n\n\ndef main():\n    with rclpy.init():\n        pass\n"
_PLAIN = "import rclpy\n\n\ndef main():\n    rclpy.init()\n"


class InitAsContextManager(RclpyRule):
    """``with rclpy.init()`` needs a newer ROS distribution than the one that is checked for.

    **Why.** On Humble and Jazzy ``init`` returns None: ``TypeError: 'NoneType' object does not
    support the context manager protocol``.

    **Fix.** Call ``rclpy.init(args=args)``, and ``rclpy.try_shutdown()`` in a ``finally``.

    **Source.** rclpy 7.4.0 (pull request 1298) introduced it: it is in Kilted and later.
    """

    code = "ND007"
    name = "init-as-context-manager"
    examples = (
        Example("a plain call", {"talker.py": _PLAIN}),
        Example(
            "a with statement",
            {"talker.py": _WITH},
            "5:10: rclpy.init() is not a context manager on Jazzy: TypeError at start",
        ),
    )

    def check_file(self, file: RclpyFile) -> Iterator[Diagnostic]:
        if "rclpy.InitContextManager" in known_names():
            return
        title = target().title
        for call in file.init_calls:
            if call.in_with:
                message = f"rclpy.init() is not a context manager on {title}: TypeError at start"
                yield self.report(call, message)
