"""MS033: the components of a quaternion are in the order of the library."""

from __future__ import annotations

import ast
from collections.abc import Iterator, Sequence

from scaffold.api import Diagnostic, Example, MessageRule, Report, Severity
from scaffold.api.messages import MessageTypes
from scaffold.api.python import PythonModule, last_name

_GIVES = {
    "tf_transformations.quaternion_from_euler": "xyzw",
    "tf_transformations.quaternion_from_matrix": "xyzw",
    "tf_transformations.quaternion_about_axis": "xyzw",
    "tf_transformations.quaternion_multiply": "xyzw",
    "tf_transformations.quaternion_inverse": "xyzw",
    "transforms3d.euler.euler2quat": "wxyz",
    "transforms3d.quaternions.mat2quat": "wxyz",
    "transforms3d.quaternions.axangle2quat": "wxyz",
    "transforms3d.quaternions.qmult": "wxyz",
    "transforms3d.quaternions.qinverse": "wxyz",
}
"""The order of quaternion components in return values, by function."""
_TAKES = {
    "tf_transformations.euler_from_quaternion": "xyzw",
    "tf_transformations.quaternion_matrix": "xyzw",
    "tf_transformations.quaternion_inverse": "xyzw",
    "tf_transformations.quaternion_multiply": "xyzw",
    "scipy.spatial.transform.Rotation.from_quat": "xyzw",
    "transforms3d.euler.quat2euler": "wxyz",
    "transforms3d.quaternions.quat2mat": "wxyz",
    "transforms3d.quaternions.qinverse": "wxyz",
    "transforms3d.quaternions.qmult": "wxyz",
}
"""The order of quaternion components in arguments, by function."""
_ORDERS = ("xyzw", "wxyz")
_HEAD = (
    "from geometry_msgs.msg import Quaternion\n"
    "from tf_transformations import euler_from_quaternion, quaternion_from_euler\n"
    "from transforms3d.euler import euler2quat, quat2euler\n\n\n"
)


class QuaternionOrderSwapped(MessageRule):
    """A quaternion is unpacked or built in the order of another library.

    **Why.** There is no error, but the rotation is wrong. Messages, tf_transformations and SciPy
    use the order x, y, z, w; transforms3d uses w, x, y, z.

    **Fix.** ``x, y, z, w = quaternion_from_euler(...)``; ``w, x, y, z = euler2quat(...)``.

    **Source.** tf_transformations, README; transforms3d documentation, "quaternions".
    """

    code = "MS033"
    name = "quaternion-order-swapped"
    other_severities = {Severity.WARNING: "the angles are stored in attributes that are never read"}
    examples = (
        Example(
            "correct order for each library",
            {
                "a.py": _HEAD + "def turn(q: Quaternion, yaw) -> Quaternion:\n"
                "    euler_from_quaternion([q.x, q.y, q.z, q.w])\n"
                "    quat2euler((q.w, q.x, q.y, q.z))\n"
                "    w, x, y, z = euler2quat(0.0, 0.0, yaw)\n"
                "    p = quaternion_from_euler(0.0, 0.0, yaw)\n"
                "    q.w = p[3]\n"
                "    return Quaternion(x=x, y=y, z=z, w=w)\n"
            },
        ),
        Example(
            "wrong order for each library",
            {
                "a.py": _HEAD + "def turn(q: Quaternion, yaw) -> Quaternion:\n"
                "    euler_from_quaternion([q.w, q.x, q.y, q.z])\n"
                "    quat2euler((q.x, q.y, q.z, q.w))\n"
                "    x, y, z, w = euler2quat(0.0, 0.0, yaw)\n"
                "    q.w = euler2quat(0.0, 0.0, yaw)[3]\n"
                "    p = quaternion_from_euler(0.0, 0.0, yaw)\n"
                "    return Quaternion(x=p[1], y=p[2], z=p[3], w=p[0])\n"
            },
            "7:27: euler_from_quaternion() uses the order x, y, z, w, but this is w, x, y, z: it "
            "is another rotation",
            "8:16: quat2euler() uses the order w, x, y, z, but this is x, y, z, w: it is another "
            "rotation",
            "9:5: euler2quat() uses the order w, x, y, z, but this is x, y, z, w: it is another "
            "rotation",
            "10:11: euler2quat() uses the order w, x, y, z, but this is x, y, z, w: it is another "
            "rotation",
            "12:49: quaternion_from_euler() uses the order x, y, z, w, but this is w, x, y, z: it "
            "is another rotation",
        ),
        Example(
            "wrong order, for angles that are never read and for an angle that is",
            {
                f"{name}.py": _HEAD + "class Turn:\n"
                "    def turn(self, q: Quaternion):\n"
                "        self.roll, self.pitch, self.yaw = quat2euler((q.x, q.y, q.z, q.w))\n"
                f"        print({shown})\n"
                for name, shown in {"a": "q", "b": "self.yaw"}.items()
            },
            Report(
                "a.py:8:54",
                "quat2euler() uses the order w, x, y, z, but this is x, y, z, w: it is another "
                "rotation",
                severity=Severity.WARNING,
            ),
            "b.py:8:54: quat2euler() uses the order w, x, y, z, but this is x, y, z, w: it is "
            "another rotation",
        ),
    )

    def check_file(self, types: MessageTypes) -> Iterator[Diagnostic]:
        if not types.module.mentions("quat"):
            return
        for name, order in _TAKES.items():
            for call in types.module.calls_of(name):
                severity = Severity.WARNING if _is_unread(types.module, call) else None
                for given in call.args:
                    parts = _order_of_parts(types, given)
                    for found in self._compare(types, given, parts, order, name):
                        yield found._replace(severity=severity) if severity else found
        for assigned in types.module.walk(ast.Assign):
            name = _creating_function(types, assigned.value)
            for target in assigned.targets if name else ():
                order = (
                    _order_of_names(target.elts) if isinstance(target, ast.Tuple | ast.List) else ""
                )
                yield from self._compare(types, target, order, _GIVES[name], name)
        for index in _last_parts(types):
            name = _creating_function(types, types.file.evaluator.single_value(index.value))
            number = types.file.evaluator.evaluate(index.slice)
            if name and number in {0, 3}:
                order = "wxyz" if number == 0 else "xyzw"
                yield from self._compare(types, index, order, _GIVES[name], name)

    def _compare(
        self, types: MessageTypes, at: ast.expr, order: str, right: str, name: str
    ) -> Iterator[Diagnostic]:
        if order and order != right:
            function = name.rpartition(".")[2]
            message = (
                f"{function}() uses the order {', '.join(right)}, but this is {', '.join(order)}: "
                "it is another rotation"
            )
            yield self.report(types.module.location(at), message)


def _is_unread(module: PythonModule, call: ast.Call) -> bool:
    """Return whether the results are stored in attributes of ``self`` that the file never reads."""
    match module.parent(call):
        case ast.Assign(targets=[ast.Tuple(elts=items)]):
            names = {
                item.attr
                for item in items
                if isinstance(item, ast.Attribute) and getattr(item.value, "id", "") == "self"
            }
            read = {
                node.attr for node in module.walk(ast.Attribute) if isinstance(node.ctx, ast.Load)
            }
            return len(names) == len(items) and names.isdisjoint(read)
    return False


def _creating_function(types: MessageTypes, value: ast.expr) -> str:
    """Return the function that creates a quaternion; empty if unknown."""
    name = types.module.qualified_name(value.func) if isinstance(value, ast.Call) else None
    return name if name in _GIVES else ""


def _order_of_parts(types: MessageTypes, node: ast.expr) -> str:
    """Return the order of the parts in a list or tuple."""
    value = types.file.evaluator.single_value(node)
    return _order_of_names(value.elts) if isinstance(value, ast.Tuple | ast.List) else ""


def _order_of_names(items: Sequence[ast.expr]) -> str:
    """Return the last letters of names if they are the components of a quaternion."""
    names = [last_name(item) for item in items]
    letters = "".join(name[-1:] for name in names).lower()
    is_plain = len({name[:-1] for name in names}) == 1
    return letters if letters in _ORDERS and is_plain else ""


def _last_parts(types: MessageTypes) -> Iterator[ast.Subscript]:
    """Yield the values of the field ``w``: ``message.w = q[3]``, ``Quaternion(w=q[3])``."""
    for store in types.file.evaluator.stores("w"):
        if isinstance(store.value, ast.Subscript):
            yield store.value
    for call in types.module.walk(ast.Call):
        for word in call.keywords:
            if word.arg == "w" and isinstance(word.value, ast.Subscript):
                yield word.value
