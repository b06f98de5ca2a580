"""TY002: names imported from modules exist."""

from __future__ import annotations

import ast
import collections.abc
import sys

from scaffold.api import (
    Diagnostic,
    Edit,
    Effect,
    Example,
    Fix,
    Package,
    Report,
    TypeRule,
    closest_name,
)
from scaffold.api.distributions import removed_interface
from scaffold.api.install import is_installed_by_path
from scaffold.api.types import TypeFinding, module_names, modules_with

_IMPORTED = frozenset(
    {*sys.stdlib_module_names, "ament_index_python", "launch", "launch_ros", "rclpy", "yaml"}
)
"""Names that ROS modules import for internal use, which the stubs do not show."""
_FEW = 3
"""The maximum number of modules in a message."""


class NameNotInModule(TypeRule):
    """Code imports a name from a module that does not have it.

    **Why.** The program fails at start: ``ImportError: cannot import name 'Iterable' from
    'collections'``.

    **Fix.** Correct the name, or import it from the module that defines it:
    ``from collections.abc import Iterable``.

    **Source.** Python 3.12, which Jazzy runs on; the packages of ROS 2 Jazzy.
    """

    code = "TY002"
    name = "name-not-in-module"
    effect = Effect.STOPS_START
    kinds = frozenset({"missing-module-member"})
    examples = (
        Example(
            "name that this Python version defines",
            {"clock.py": "from datetime import UTC\n"},
        ),
        Example(
            "name that only a newer Python version defines",
            {"clock.py": "from datetime import UTC\n"},
            "1:22: 'datetime' has no 'UTC': ImportError",
            distro="humble",
        ),
        Example(
            "existing names",
            {
                "talker.py": "from rclpy.node import Node\n"
                "from tf2_ros import Buffer, TransformableObject\n"
            },
        ),
        Example(
            "names that a module imports but does not define",
            {
                "talker.py": "from rclpy.executors import time\n"
                "from launch_ros.substitutions.find_package import get_package_share_directory\n"
                "from rclpy.utilities import ament_index_python\n\n"
                "print(time.time(), get_package_share_directory('rclpy'))\n"
            },
        ),
        Example(
            "name that was moved to another module",
            {"talker.py": "from collections import Iterable\n"},
            Report(
                "1:25",
                "'collections' has no 'Iterable': ImportError; it is in 'collections.abc'",
                fix="Import from 'collections.abc'",
            ),
            fixed={"talker.py": "from collections.abc import Iterable\n"},
        ),
        Example(
            "misspelled names",
            {"talker.py": "from rclpy.node import Nod\nfrom std_msgs.msg import Sting\n"},
            "1:24: 'rclpy.node' has no 'Nod': ImportError; did you mean 'Node'?",
            "2:26: 'std_msgs.msg' has no 'Sting': ImportError; did you mean 'String'?",
        ),
        Example(
            "names from the wrong module",
            {
                "talk.launch.py": "from launch.actions import Node, TimerAction\n"
                "from launch.substitutions import FindPackageShare\n",
                "talker.py": "from std_msgs import Bool\nfrom std_msgs.msg import Twist\n",
            },
            "talk.launch.py:1:28: 'launch.actions' has no 'Node': ImportError; did you mean "
            "'launch_ros.actions.Node'?",
            "talk.launch.py:2:34: 'launch.substitutions' has no 'FindPackageShare': ImportError; "
            "did you mean 'launch_ros.substitutions.FindPackageShare'?",
            "talker.py:1:22: 'std_msgs' has no 'Bool': ImportError; did you mean "
            "'std_msgs.msg.Bool'?",
            "talker.py:2:26: 'std_msgs.msg' has no 'Twist': ImportError; did you mean "
            "'geometry_msgs.msg.Twist'?",
        ),
        Example(
            "misspelled message of another package in the workspace",
            {"talker.py": "from my_msgs.msg import Beat, Bet\n"},
            "1:31: 'my_msgs.msg' has no 'Bet': ImportError; did you mean 'Beat'?",
            neighbors={
                "my_msgs": {
                    "package.xml": "<package format='3'><name>my_msgs</name></package>\n",
                    "CMakeLists.txt": "project(my_msgs)\n"
                    "rosidl_generate_interfaces(${PROJECT_NAME} drums/msg/Beat.msg)\n",
                    "drums/msg/Beat.msg": "int32 count\n",
                }
            },
        ),
        Example(
            "message removed in this distribution",
            {"talker.py": "from geometry_msgs.msg import Pose2D\n"},
            "1:31: 'geometry_msgs.msg' has no 'Pose2D': ImportError; it was removed in Lyrical: "
            "use geometry_msgs/msg/Pose, or a message of your own with x, y and theta, depending "
            "on the subscribers (common_interfaces 283)",
            distro="lyrical",
        ),
    )

    def judge(self, finding: TypeFinding) -> Diagnostic | None:
        matched = finding.match(r"Module `([\w.]+)` has no member `(\w+)`")
        if matched is None:
            return None
        module, name = matched.groups()
        if module.split(".")[-1].startswith("_") or name.startswith("_"):
            return None
        if name in _IMPORTED:
            return None
        if any(is_installed_by_path(finding.package, x) for x in (module, f"{module}.{name}")):
            return None
        message = f"{module!r} has no {name!r}: ImportError"
        if module == "collections" and name in collections.abc.__all__:
            fix = self._fix(finding)
            return self.report(finding, f"{message}; it is in 'collections.abc'", fix)
        return self.report(finding, f"{message}{_replacement(finding.package, module, name)}")

    def _fix(self, finding: TypeFinding) -> Fix | None:
        for node in finding.module.walk(ast.ImportFrom):
            at = finding.module.location(node)
            if at.line != finding.location.line or node.module != "collections":
                continue
            if all(alias.name in collections.abc.__all__ for alias in node.names):
                start, _ = finding.module.span(node)
                start = finding.module.source.text.index("collections", start)
                edit = Edit(finding.path, start, start + len("collections"), "collections.abc")
                return Fix("Import from 'collections.abc'", (edit,))
        return None


def _replacement(package: Package, module: str, name: str) -> str:
    """Return the import to use instead: the same name from elsewhere, or a similar name."""
    change = removed_interface(f"{module}.{name}".replace(".", "/"))
    if change is not None:
        return f"; it {change.state}: {change.advice} ({change.source})"
    modules = modules_with(package, name, module)
    if 0 < len(modules) <= _FEW:
        likely = [repr(f"{item}.{name}") for item in modules]
        return f"; did you mean {' or '.join(likely)}?"
    closest = closest_name(package, name, module_names(package, module), 0.6)
    return f"; did you mean {closest!r}?" if closest else ""
