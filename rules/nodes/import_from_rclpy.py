"""ND012: Node is imported from where it is."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Rule

PLACES = {
    "Node": "rclpy.node",
    "LifecycleNode": "rclpy.lifecycle",
    "QoSProfile": "rclpy.qos",
    "qos_profile_sensor_data": "rclpy.qos",
    "ReliabilityPolicy": "rclpy.qos",
    "DurabilityPolicy": "rclpy.qos",
    "ActionServer": "rclpy.action",
    "ActionClient": "rclpy.action",
    "MultiThreadedExecutor": "rclpy.executors",
    "SingleThreadedExecutor": "rclpy.executors",
    "ExternalShutdownException": "rclpy.executors",
    "ReentrantCallbackGroup": "rclpy.callback_groups",
    "MutuallyExclusiveCallbackGroup": "rclpy.callback_groups",
    "Duration": "rclpy.duration",
    "Time": "rclpy.time",
}


class ImportFromRclpy(Rule):
    """A name is imported from rclpy that rclpy does not have.

    **Why.** ``ImportError: cannot import name 'Node' from 'rclpy'`` at start.

    **Fix.** Import it from its module: ``from rclpy.node import Node``.

    **Source.** ``rclpy/__init__.py``.
    """

    code = "ND012"
    name = "import-from-rclpy"
    examples = (
        Example("from its module", {"talker.py": "from rclpy.node import Node\n"}),
        Example("from the top", {"talker.py": "from rclpy import Node\n"}, at=("talker.py:1",)),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for module in package.modules():
            for one in module.imports_by_root.get("rclpy", ()):
                if one.module != "rclpy":
                    continue
                for name in one.names:
                    place = PLACES.get(name.name)
                    if place is not None:
                        message = f"rclpy has no {name.name!r}; import it from {place}"
                        yield self.report(name, message)
