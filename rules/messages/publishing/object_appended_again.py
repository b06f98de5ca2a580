"""MS027: lists of messages hold different objects."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, MessageRule
from scaffold.api.messages import MessageTypes

_NODE = (
    "from geometry_msgs.msg import PoseStamped\nfrom nav_msgs.msg import Odometry, Path\n"
    "from rclpy.node import Node\n\n\n"
    "class Tracker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('tracker')\n"
    "        self.path = Path()\n"
    "        self.pose = PoseStamped()\n"
    "        self.create_subscription(Odometry, 'odom', self.on_odom, 10)\n\n"
    "    def on_odom(self, msg):\n"
    "        {}\n"
)
_LOOP = (
    "from geometry_msgs.msg import Point, PoseArray, Pose\n\n\n"
    "def row():\n"
    "    array = PoseArray()\n"
    "{}"
    "    return array\n"
)


class ObjectAppendedAgain(MessageRule):
    """One message object is changed and appended again and again.

    **Why.** The list contains the same object several times: all poses of the path are equal to the
    last one, without an error.

    **Fix.** Create a new message for each element, inside the callback or loop.

    **Source.** Python documentation, "Programming FAQ": names refer to objects.
    """

    code = "MS027"
    name = "object-appended-again"
    examples = (
        Example(
            "new object for each element",
            {
                "tracker.py": _NODE.format(
                    "pose = PoseStamped()\n        pose.pose = msg.pose.pose\n"
                    "        self.path.poses.append(pose)"
                )
            },
        ),
        Example(
            "list multiplication of one message, changed in a loop",
            {
                "a.py": _LOOP.format(
                    "    array.poses = [Pose()] * 2\n    poses = [Pose()] * 3\n"
                    "    for x, pose in enumerate(poses):\n"
                    "        pose.position.x = float(x)\n"
                    "    poses = [Pose() for _ in range(3)]\n"
                )
            },
            "7:13: a list with one object several times: what is set in one element is set in "
            "all; write [Pose() for _ in range(...)]",
        ),
        Example(
            "new list for each element, copy of the object",
            {
                "tracker.py": _NODE.format(
                    "self.pose.pose = msg.pose.pose\n        path = Path()\n"
                    "        path.poses.append(self.pose)"
                ),
                "b.py": _LOOP.format(
                    "    pose = Pose()\n    for x in range(3):\n"
                    "        pose.position.x = float(x)\n"
                    "        array.poses.append(copy(pose))\n"
                ),
                "c.py": _LOOP.format(
                    "    pose = Pose()\n    for x in range(3):\n"
                    "        array.poses = []\n"
                    "        pose.position.x = float(x)\n"
                    "        array.poses.append(pose)\n"
                ),
                "d.py": _LOOP.format(
                    "    pose = Pose()\n    for x in range(3):\n"
                    "        array = PoseArray()\n"
                    "        pose.position.x = float(x)\n"
                    "        array.poses.append(pose)\n"
                ),
            },
        ),
        Example(
            "attribute appended in each callback",
            {
                "tracker.py": _NODE.format(
                    "self.pose.pose = msg.pose.pose\n        self.path.poses.append(self.pose)"
                )
            },
            "15:32: the same object from line 10 is appended each time: all elements are the last "
            "self.pose; create a new object for each element",
        ),
        Example(
            "attribute appended under another name",
            {
                "tracker.py": _NODE.replace("self.pose =", "self.last =").format(
                    "pose = self.last\n        pose.pose = msg.pose.pose\n"
                    "        self.path.poses.append(pose)"
                )
            },
            "16:32: the same object from line 10 is appended each time: all elements are the last "
            "pose; create a new object for each element",
        ),
        Example(
            "same object appended in a loop",
            {
                "row.py": _LOOP.format(
                    "    pose = Pose()\n    for x in range(3):\n"
                    "        pose.position.x = float(x)\n"
                    "        array.poses.append(pose)\n"
                )
            },
            "9:28: the same object from line 6 is appended each time: all elements are the last "
            "pose; create a new object for each element",
        ),
    )

    def check_file(self, types: MessageTypes) -> Iterator[Diagnostic]:
        for call in types.module.walk(ast.Call):
            match call:
                case ast.Call(
                    func=ast.Attribute(attr="append", value=holder),
                    args=[ast.Name() | ast.Attribute() as item],
                ):
                    made = _made_once(types, call, holder, item)
                    if made is not None:
                        text = types.module.text(item)
                        message = (
                            f"the same object from line {made.lineno} is appended each time: all "
                            f"elements are the last {text}; create a new object for each element"
                        )
                        yield self.report(types.module.location(item), message)
        for assigned in types.module.walk(ast.Assign):
            multiplied = _multiplied(types, assigned)
            if multiplied:
                message = (
                    f"a list with one object several times: what is set in one element is set in "
                    f"all; write [{multiplied} for _ in range(...)]"
                )
                yield self.report(types.module.location(assigned.value), message)


def _multiplied(types: MessageTypes, assigned: ast.Assign) -> str:
    """Return the message in ``[message] * n`` if the elements are filled one by one."""
    match assigned:
        case ast.Assign(
            targets=[ast.Name(id=name)],
            value=ast.BinOp(left=ast.List(elts=[ast.Call() as made]), op=ast.Mult()),
        ) if types.class_of(made.func) is not None:
            function = types.module.enclosing_function(assigned)
            if function is not None and _fills_elements(types, function, name):
                return types.module.text(made)
    return ""


def _fills_elements(types: MessageTypes, function: ast.AST, name: str) -> bool:
    """Return whether fields of the elements of a list are assigned."""
    elements = {
        target.id
        for loop in types.module.below(function, ast.For)
        if re.search(rf"\b{name}\b", types.module.text(loop.iter))
        for target in ast.walk(loop.target)
        if isinstance(target, ast.Name)
    }
    stores = types.module.below(function, ast.Attribute)
    starts = (f"{name}[", *(f"{element}." for element in elements))
    return any(
        isinstance(store.ctx, ast.Store) and types.module.text(store).startswith(starts)
        for store in stores
    )


def _made_once(
    types: MessageTypes, call: ast.Call, holder: ast.expr, item: ast.Name | ast.Attribute
) -> ast.expr | None:
    """Return the creation of an object that is changed and appended several times."""
    module = types.module
    made = _only_value(types, item)
    if not isinstance(made, ast.Call) or types.class_of(made.func) is None:
        return None
    function, maker = module.enclosing_function(call), module.enclosing_function(made)
    if function is not maker and maker is not None:
        is_kept = isinstance(holder, ast.Attribute) and module.text(holder).startswith("self.")
        if not is_kept or function is None or maker.name != "__init__":
            return None
        is_filled = _is_changed(types, function, item) and not _is_emptied(types, function, holder)
        return made if is_filled else None
    loops = [parent for parent in module.parents(call) if isinstance(parent, ast.For | ast.While)]
    if not loops or loops[0] in module.parents(made) or _ends_after_append(loops[0], call):
        return None
    is_filled = _is_changed(types, loops[0], item) and not _is_emptied(types, loops[0], holder)
    return made if is_filled and isinstance(item, ast.Name) else None


def _only_value(types: MessageTypes, item: ast.Name | ast.Attribute) -> ast.expr | None:
    """Return the only value assigned to a name or an attribute of ``self``."""
    if isinstance(item, ast.Name):
        return types.file.evaluator.single_value(item)
    class_ = types.module.enclosing_class(item)
    text = types.module.text(item)
    values = [
        assignment.value
        for assignment in types.module.walk(ast.Assign)
        if any(types.module.text(target) == text for target in assignment.targets)
        and types.module.enclosing_class(assignment) is class_
    ]
    return values[0] if len(values) == 1 and text.startswith("self.") else None


def _ends_after_append(loop: ast.For | ast.While, call: ast.Call) -> bool:
    """Return whether a loop ends after an element is appended."""
    return any(
        isinstance(node, ast.Break | ast.Return) and node.lineno > call.lineno
        for node in ast.walk(loop)
    )


def _is_changed(types: MessageTypes, block: ast.AST, item: ast.expr) -> bool:
    """Return whether a field of an object is assigned in a block."""
    start = f"{types.module.text(item)}."
    return any(
        isinstance(node, ast.Attribute)
        and isinstance(node.ctx, ast.Store)
        and types.module.text(node).startswith(start)
        for node in ast.walk(block)
    )


def _is_emptied(types: MessageTypes, block: ast.AST, holder: ast.expr) -> bool:
    """Return whether a block creates a list, or its owner, each time it runs."""
    text = types.module.text(holder)
    for node in ast.walk(block):
        if isinstance(node, ast.Attribute | ast.Name):
            is_made = isinstance(node.ctx, ast.Store)
            above = types.module.parent(node)
            is_cleared = isinstance(above, ast.Attribute) and above.attr in {"clear", "pop"}
            name = types.module.text(node)
            if (is_made or is_cleared) and (text == name or text.startswith(f"{name}.")):
                return True
    return False
