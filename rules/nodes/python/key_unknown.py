"""ND139: keys of tables in code exist."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator, Mapping, Sequence

from scaffold.api import Diagnostic, Example, Package, PythonRule, closest_name, fact
from scaffold.api.python import PythonModule, conditions_on, is_handled

_TOPICS = (
    "from sensor_msgs.msg import Imu, LaserScan\n\n"
    "TOPICS = {'scan': (LaserScan, '/scan'), 'imu': (Imu, '/imu')}\n"
)
_NODE = (
    "from rclpy.node import Node\n\nfrom robot.topics import TOPICS\n\n\n"
    "class Monitor(Node):\n"
    "    gains = {{'linear': 0.5, 'angular': 1.0}}\n\n"
    "    def __init__(self):\n"
    "        super().__init__('monitor')\n"
    "        self.limits = {{'speed': 0.5, 'turn': 1.0}}\n"
    "        {}\n"
)
_READING = frozenset({"copy", "get", "items", "keys", "values"})
_FEW = 6


class KeyUnknown(PythonRule):
    """A key is not in the dictionary literal that it is read from.

    **Why.** ``KeyError: 'laser'`` when the line is executed.

    **Fix.** Correct the key, or add it to the dictionary.

    **Source.** Python documentation, "Mapping Types".
    """

    code = "ND139"
    name = "key-unknown"
    examples = (
        Example(
            "a key",
            {"robot/topics.py": _TOPICS, "robot/monitor.py": _NODE.format("TOPICS['scan']")},
        ),
        Example(
            "of another module",
            {
                "robot/topics.py": _TOPICS,
                "robot/monitor.py": _NODE.format("print(TOPICS['laser'])"),
            },
            "robot/monitor.py:12:22: TOPICS has no key 'laser': KeyError; it has scan, imu",
        ),
        Example(
            "of an attribute",
            {"robot/monitor.py": _NODE.format("self.limits['speeed']")},
            "12:21: self.limits has no key 'speeed': KeyError; did you mean 'speed'?",
        ),
        Example(
            "one that is added",
            {
                "robot/monitor.py": _NODE.format(
                    "self.limits['lift'] = 1.0\n        self.limits['lift']"
                )
            },
        ),
        Example(
            "one that is asked for",
            {
                "robot/topics.py": _TOPICS,
                "robot/monitor.py": _NODE.format(
                    "if 'laser' in TOPICS:\n            print(TOPICS['laser'])"
                ),
            },
        ),
        Example(
            "a table that a function gets",
            {"robot/monitor.py": _NODE.format("fill(self.limits)\n        self.limits['lift']")},
        ),
    )

    def check_in(self, package: Package, module: PythonModule) -> Iterator[Diagnostic]:
        if module.in_tests:
            return
        for node in module.walk(ast.Subscript):
            match node:
                case ast.Subscript(
                    value=ast.Name() | ast.Attribute() as table,
                    slice=ast.Constant(value=str(key)),
                    ctx=ast.Load(),
                ):
                    keys = _keys(package, module, table)
                    if keys and key not in keys and not _is_expected(module, node):
                        closest = closest_name(package, key, keys, 0.6)
                        hint = f"; did you mean {closest!r}?" if closest else ""
                        if not hint and len(keys) <= _FEW:
                            hint = f"; it has {', '.join(keys)}"
                        message = f"{module.text(table)} has no key {key!r}: KeyError{hint}"
                        yield self.report(module.location(node.slice), message)


def _is_expected(module: PythonModule, node: ast.Subscript) -> bool:
    """Return whether code handles a missing key."""
    if is_handled(module, node, "KeyError") or is_handled(module, node, "LookupError"):
        return True
    text = ast.unparse(node.value)
    return any(text in ast.unparse(condition) for condition in conditions_on(module, node))


def _keys(package: Package, module: PythonModule, table: ast.Name | ast.Attribute) -> Sequence[str]:
    """Return the keys of a dictionary that is never changed; empty if unknown."""
    match table:
        case ast.Attribute(value=ast.Name(id="self"), attr=name):
            others = (path for path in package.python_files if path != module.path)
            if any(_changes(package, path, name) for path in others):
                return ()
            return _only_keys(module, module.index.attributes(name))
    name = module.qualified_name(table) or ""
    if "." not in name:
        scope = module.index.lookup(name, table) if isinstance(table, ast.Name) else None
        is_global = scope is not None and scope[0] is module.tree
        return _tables(package, module.path).get(name, ()) if is_global else ()
    path, _, last = name.rpartition(".")
    if not all(_is_reading(module, use) for use in module.index.names(last)):
        return ()
    for start in ("", "src/"):
        file = f"{start}{path.replace('.', '/')}.py"
        if package.has(file):
            return _tables(package, file).get(last, ())
    return ()


@fact
def _changes(package: Package, path: str, name: str) -> bool:
    """Return whether a file may change an attribute of this name of any object."""
    changed = rb"\.%b\b\s*(?:\[[^\]\n]*\]\s*=(?!=)|=(?!=)|\.(?!get|items|keys|values)\w)"
    return re.search(changed % name.encode(), package.data(path)) is not None


@fact
def _tables(package: Package, path: str) -> Mapping[str, tuple[str, ...]]:
    """Return the keys of the dictionaries of a module that are never changed, by name."""
    module = package.module(path)
    result: dict[str, tuple[str, ...]] = {}
    for name, bindings in module.index.bindings(module.tree).items():
        if len(bindings) == 1 and isinstance(bindings[0].value, ast.Dict):
            keys = _only_keys(module, module.index.names(name))
            if keys:
                result[name] = keys
    return result


def _only_keys(module: PythonModule, uses: Sequence[ast.Name | ast.Attribute]) -> tuple[str, ...]:
    """Return the keys of the only dictionary that a name is set to; empty if it changes."""
    stored = [use for use in uses if isinstance(use.ctx, ast.Store)]
    others = [use for use in uses if isinstance(use.ctx, ast.Load)]
    if len(stored) != 1 or len(stored) + len(others) != len(uses):
        return ()
    match module.parent(stored[0]):
        case (
            ast.Assign(targets=[_], value=ast.Dict(keys=keys))
            | ast.AnnAssign(value=ast.Dict(keys=keys))
        ) if all(_is_reading(module, use) for use in others):
            texts = [key.value for key in keys if isinstance(key, ast.Constant)]
            names = tuple(text for text in texts if isinstance(text, str))
            return names if len(names) == len(keys) else ()
    return ()


def _is_reading(module: PythonModule, use: ast.expr) -> bool:
    """Return whether a use of a dictionary does not change it, or pass it on."""
    parent = module.parent(use)
    match parent:
        case ast.Subscript(value=value, ctx=ast.Load()):
            return value is use
        case ast.Attribute(attr=name, value=value):
            return value is use and name in _READING
        case ast.Compare() | ast.For() | ast.comprehension() | ast.alias():
            return True
        case ast.Call(func=ast.Name(id="len" | "list" | "sorted" | "print" | "str" | "set")):
            return True
    return False
