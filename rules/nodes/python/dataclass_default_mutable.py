"""ND137: dataclasses accept the defaults of their fields."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator

from scaffold.api import Diagnostic, Effect, Example, PythonRule
from scaffold.api.distributions import target
from scaffold.api.python import PythonModule

_TRACK = (
    "from dataclasses import dataclass, field\n\nfrom geometry_msgs.msg import Point\n\n\n"
    "@dataclass{}\nclass Limits:\n    speed: float = 0.5\n\n\n"
    "@dataclass\nclass Track:\n    name: str = ''\n    {}\n"
)
_DISPLAYS = {ast.List: "list", ast.Dict: "dict", ast.Set: "set"}
_BUILTINS = frozenset(_DISPLAYS.values())
_UNHASHABLE = re.compile(
    r"\w+\.(?:msg|srv|action)\.[A-Z]\w*(?:\.\w+)?|rclpy\.duration\.Duration|rclpy\.time\.Time"
    r"|rclpy\.qos\.QoSProfile|numpy\.(?:array|zeros|ones|empty|eye)"
)
"""Matches the classes that define ``__eq__`` without ``__hash__``, and functions for arrays."""
_SINCE = (3, 11)
"""The Python that refuses all defaults without a hash, not only lists, dicts and sets."""
_HASHED = frozenset({"frozen", "unsafe_hash"})
"""Arguments of ``dataclass`` that add a hash."""


class DataclassDefaultMutable(PythonRule):
    """The default of a field of a dataclass is a list, a message or another mutable object.

    **Why.** ``ValueError: mutable default <class 'list'> for field points is not allowed`` when the
    module is imported. Since Python 3.11 this also applies to messages, arrays, QoS profiles and
    other dataclasses: to all objects that can be compared but have no hash.

    **Fix.** Write ``points: list = field(default_factory=list)``.

    **Source.** Python documentation, "dataclasses", "Mutable default values".
    """

    code = "ND137"
    name = "dataclass-default-mutable"
    effect = Effect.STOPS_START
    examples = (
        Example(
            "a factory",
            {"track.py": _TRACK.format("", "points: list = field(default_factory=list)")},
        ),
        Example(
            "a list",
            {"track.py": _TRACK.format("", "points: list = []")},
            "14:20: a list cannot be the default of a field: ValueError at import; write "
            "field(default_factory=list)",
        ),
        Example(
            "a new dictionary",
            {"track.py": _TRACK.format("", "points: dict = dict()")},
            "14:20: a dict cannot be the default of a field: ValueError at import; write "
            "field(default_factory=dict)",
        ),
        Example(
            "a message",
            {"track.py": _TRACK.format("", "last: Point = Point()")},
            "14:19: a Point cannot be the default of a field: ValueError at import; write "
            "field(default_factory=Point)",
        ),
        Example(
            "a message in Python 3.10",
            {"track.py": _TRACK.format("", "last: Point = Point()")},
            distro="humble",
        ),
        Example(
            "a message with a value",
            {"track.py": _TRACK.format("", "last: Point = field(default=Point(x=1.0))")},
            "14:33: a Point cannot be the default of a field: ValueError at import; write "
            "field(default_factory=lambda: ...)",
        ),
        Example(
            "another dataclass",
            {"track.py": _TRACK.format("", "limits: Limits = Limits()")},
            "14:22: a Limits cannot be the default of a field: ValueError at import; write "
            "field(default_factory=Limits)",
        ),
        Example(
            "one that cannot be changed",
            {"track.py": _TRACK.format("(frozen=True)", "limits: Limits = Limits()")},
        ),
        Example(
            "a value of the class itself",
            {"track.py": _TRACK.format("", "all: ClassVar[list] = []")},
        ),
        Example(
            "an array",
            {"track.py": "import numpy as np\n" + _TRACK.format("", "row: object = np.zeros(3)")},
            "15:19: a numpy array cannot be the default of a field: ValueError at import; write "
            "field(default_factory=lambda: ...)",
        ),
    )

    def check_file(self, module: PythonModule) -> Iterator[Diagnostic]:
        for class_ in module.walk(ast.ClassDef) if module.mentions("dataclass") else ():
            if _decorator(module, class_) is None:
                continue
            for statement in class_.body:
                if isinstance(statement, ast.AnnAssign) and statement.value is not None:
                    default = _default(module, statement)
                    kind = _mutable_kind(module, default)
                    if kind:
                        factory = _factory(module, default)
                        message = f"a {kind} cannot be the default of a field: ValueError at import"
                        hint = f"write field(default_factory={factory})"
                        yield self.report(module.location(default), f"{message}; {hint}")


def _decorator(module: PythonModule, class_: ast.ClassDef) -> ast.expr | None:
    """Return the decorator that makes a class a dataclass."""
    for decorator in class_.decorator_list:
        function = decorator.func if isinstance(decorator, ast.Call) else decorator
        if module.qualified_name(function) == "dataclasses.dataclass":
            return decorator
    return None


def _default(module: PythonModule, field: ast.AnnAssign) -> ast.expr:
    """Return the default of a field, which ``field(default=...)`` may contain."""
    value = field.value or field.annotation
    if "ClassVar" in ast.unparse(field.annotation):
        return field.target
    match value:
        case ast.Call(func=function, keywords=keywords) if (
            module.qualified_name(function) == "dataclasses.field"
        ):
            given = [word.value for word in keywords if word.arg == "default"]
            return given[0] if given else field.target
    return value


def _mutable_kind(module: PythonModule, value: ast.expr) -> str:
    """Return what a value is if dataclasses refuse it as a default; otherwise empty."""
    if type(value) in _DISPLAYS:
        return _DISPLAYS[type(value)]
    if not isinstance(value, ast.Call):
        return ""
    match value.func:
        case ast.Name(id=name) if name in _BUILTINS and not module.index.bindings_of(value.func):
            return name
    if target().python < _SINCE:
        return ""
    name = module.qualified_name(value.func) or ""
    if _UNHASHABLE.fullmatch(name):
        return "numpy array" if name.startswith("numpy.") else name.rpartition(".")[2]
    return module.text(value.func) if _is_unhashed(module, value) else ""


def _is_unhashed(module: PythonModule, value: ast.Call) -> bool:
    """Return whether a value is an object of a dataclass of the file that has no hash."""
    node = module.index.only_node(value.func)
    decorator = _decorator(module, node) if isinstance(node, ast.ClassDef) else None
    words = decorator.keywords if isinstance(decorator, ast.Call) else []
    is_hashed = any(word.arg in _HASHED for word in words)
    is_hashed = is_hashed or any(word.arg == "eq" for word in words)
    defines_hash = isinstance(node, ast.ClassDef) and "__hash__" in module.index.bindings(node)
    return decorator is not None and not is_hashed and not defines_hash


def _factory(module: PythonModule, value: ast.expr) -> str:
    """Return a function that creates a default."""
    match value:
        case ast.List(elts=[]) | ast.Dict(keys=[]):
            return _DISPLAYS[type(value)]
        case ast.Call(args=[], keywords=[]):
            return module.text(value.func)
    return "lambda: ..."
