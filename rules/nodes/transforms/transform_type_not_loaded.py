"""ND111: the conversions for transformed types are imported."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, MessageRule, Package, closure
from scaffold.api.messages import MessageTypes
from scaffold.api.rclpy import CONVERSIONS, lookups_in

_MODULES = {"geometry_msgs": "tf2_geometry_msgs", "sensor_msgs": "tf2_sensor_msgs"}
"""The modules with the conversions for the messages of packages."""
_NODE = (
    "from geometry_msgs.msg import PointStamped\nfrom rclpy.node import Node\n{}"
    "from tf2_ros import Buffer, TransformListener\n\n\n"
    "class Follower(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('follower')\n"
    "        self.buffer = Buffer()\n"
    "        self.listener = TransformListener(self.buffer, self)\n\n"
    "    def follow(self, point: PointStamped):\n"
    "        return self.buffer.transform(point, 'map')\n"
)


class TransformTypeNotLoaded(MessageRule):
    """``buffer.transform()`` is called, but the module with the conversion is not imported.

    **Why.** ``TypeException: Type <class 'geometry_msgs.msg._point_stamped.PointStamped'> is not
    loaded or supported``: conversions register themselves when their module is imported.

    **Fix.** Add ``import tf2_geometry_msgs``, with ``# noqa: F401`` if nothing else uses it, and
    ``<depend>tf2_geometry_msgs</depend>``.

    **Source.** ``tf2_ros/buffer_interface.py``, ``TransformRegistration``.
    """

    code = "ND111"
    name = "transform-type-not-loaded"
    examples = (
        Example(
            "imported", {"follower.py": _NODE.format("import tf2_geometry_msgs  # noqa: F401\n")}
        ),
        Example(
            "not imported",
            {"follower.py": _NODE.format("")},
            "13:16: tf2_geometry_msgs is not imported: buffer.transform() raises TypeException; "
            "add `import tf2_geometry_msgs`",
        ),
        Example(
            "imported by another module",
            {
                "follower.py": _NODE.format(""),
                "main.py": "import tf2_geometry_msgs\n\nfrom follower import Follower\n",
            },
        ),
        Example(
            "imported by another program",
            {"follower.py": _NODE.format(""), "other.py": "import tf2_geometry_msgs\n"},
            "follower.py:13:16: tf2_geometry_msgs is not imported: buffer.transform() raises "
            "TypeException; add `import tf2_geometry_msgs`",
        ),
    )

    def check_in(self, package: Package, types: MessageTypes) -> Iterator[Diagnostic]:
        file = types.file
        for lookup in lookups_in(file):
            if lookup.method != "transform" or "new_type" in lookup.arguments:
                continue
            given = lookup.arguments.get("object_stamped")
            class_ = types.type_of(given) if given is not None else None
            wanted = _MODULES.get(class_.name.partition("/")[0], "") if class_ else ""
            if _is_loaded(package, file.module.path, wanted):
                continue
            module = wanted or "tf2_geometry_msgs"
            message = (
                f"{module} is not imported: buffer.transform() raises TypeException; "
                f"add `import {module}`"
            )
            yield self.report(file.module.location(lookup.call), message)


def _is_loaded(package: Package, path: str, wanted: str) -> bool:
    """Return whether a module that runs with a file imports conversions: these, or any."""
    names = {wanted} if wanted else CONVERSIONS
    loading = {
        module.path
        for module in package.modules(mentioning=("tf2_",))
        for item in module.imports
        if item.root in names or "convert" in item.root or "registration" in item.module
    }
    return bool(loading and loading & _connected_modules(package, path)) or any(
        module.mentions("TransformRegistration")
        for module in package.modules(mentioning=("TransformRegistration",))
    )


def _connected_modules(package: Package, path: str) -> set[str]:
    """Return the modules connected with a file by imports: they may run in one process."""
    uses = {
        module.path: {
            part
            for item in module.imports
            for name in (item.module, *(imported.name for imported in item.names))
            for part in name.split(".")
        }
        for module in package.modules()
    }

    def connected(current: str) -> Iterator[str]:
        for other, used in uses.items():
            if _import_name(other) in uses.get(current, ()) or _import_name(current) in used:
                yield other

    return {path, *closure([path], connected)}


def _import_name(path: str) -> str:
    """Return the name of a module in imports."""
    parts = path.removesuffix(".py").split("/")
    return parts[-2] if parts[-1] == "__init__" and len(parts) > 1 else parts[-1]
