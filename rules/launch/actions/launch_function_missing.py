"""LF002: a launch file defines generate_launch_description, which returns a LaunchDescription."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from difflib import get_close_matches

from scaffold.api import (
    Diagnostic,
    Edit,
    Example,
    Fix,
    LaunchRule,
    Location,
    Package,
    Report,
    Severity,
    fact,
)
from scaffold.api.launch import FUNCTION, LaunchFile
from scaffold.api.python import imports_by_path, is_none_literal, may_end, paths_importing, returned

_LOADERS = frozenset(
    {
        "runpy.run_path",
        "importlib.util.spec_from_file_location",
        "importlib.machinery.SourceFileLoader",
    }
)
_LAUNCH = "from launch import LaunchDescription\n\n\ndef {}():\n    return LaunchDescription([])\n"
_LAUNCH_RESULT = (
    "from launch import LaunchDescription\nfrom launch_ros.actions import Node\n\n\n"
    "def generate_launch_description():\n"
    "    node = Node(package='talker', executable='talk')\n"
)


class LaunchFunctionMissing(LaunchRule):
    """A launch file has no ``generate_launch_description`` that returns a ``LaunchDescription``.

    **Why.** ``ros2 launch``: ``launch file ... does not contain the required function
    'generate_launch_description()'``, or ``'NoneType' object has no attribute
    'get_launch_arguments_with_include_launch_description_actions'``.

    **Fix.** Define the function with exactly this name, and ``return LaunchDescription([...])`` on
    every path.

    **Source.** ``launch/launch_description_sources/python_launch_file_utilities.py``; ROS 2
    documentation, "Creating a launch file".
    """

    code = "LF002"
    name = "launch-function-missing"
    other_severities = {
        Severity.WARNING: "it returns a LaunchDescription on other paths, or unless something "
        "fails; or the file only has classes with bases, which something may load as a module"
    }
    examples = (
        Example("defined", {"launch/a.launch.py": _LAUNCH.format(FUNCTION)}),
        Example(
            "module of the package that a launch file imports",
            {
                "talker/launch/parts_launch.py": "PARTS = []\n",
                "launch/a.launch.py": "from launch import LaunchDescription\n"
                "from talker.launch.parts_launch import PARTS\n\n\n"
                "def generate_launch_description():\n    return LaunchDescription(PARTS)\n",
            },
        ),
        Example(
            "misspelled",
            {"launch/a.launch.py": _LAUNCH.format("generate_launch_descriptions")},
            Report(
                "4:5",
                "`ros2 launch` calls generate_launch_description, not generate_launch_descriptions",
                fix="Replace with generate_launch_description",
            ),
            fixed={"launch/a.launch.py": _LAUNCH.format(FUNCTION)},
        ),
        Example(
            "misspelled in a launch file with another ending",
            {"launch/start.py": _LAUNCH.format("generate_robot_launch_description")},
            Report(
                "4:5",
                "`ros2 launch` calls generate_launch_description, not "
                "generate_robot_launch_description",
                fix="Replace with generate_launch_description",
            ),
            fixed={"launch/start.py": _LAUNCH.format(FUNCTION)},
        ),
        Example(
            "module in the directory of launch files",
            {
                "launch/parts.py": _LAUNCH.format("generate_robot_launch_description"),
                "launch/a.launch.py": "from parts import generate_robot_launch_description\n\n\n"
                "def generate_launch_description():\n"
                "    return generate_robot_launch_description()\n",
                "launch/nodes.py": _LAUNCH.format("nodes"),
            },
        ),
        Example(
            "a helper that another launch file runs",
            {
                "launch/a.launch.py": "import runpy\nfrom pathlib import Path\n\n"
                "HELPER = runpy.run_path(str(Path(__file__).with_name('nodes_launch.py')))\n"
                + _LAUNCH.format(FUNCTION),
                "launch/nodes_launch.py": _LAUNCH.format("nodes"),
                "launch/b.launch.py": "import runpy\n\n"
                "_ALL = runpy.run_path('share/all.launch.py')\n\n\n"
                f"def {FUNCTION}():\n    return _ALL['describe']('b')\n",
                "launch/all.launch.py": _LAUNCH.format("describe"),
            },
        ),
        Example(
            "not defined",
            {"launch/a.launch.py": "from launch import LaunchDescription\n\nLaunchDescription()\n"},
            "1:1: `ros2 launch` calls generate_launch_description, which this file does not define",
        ),
        Example(
            "only classes: one for a program that loads it, and one that nothing imported knows",
            {
                "launch/arm.launch.py": "import launch\nfrom robots.parts import Part\n\n\n"
                "class Arm(Part):\n    def nodes(self):\n        return []\n",
                "launch/leg.launch.py": "from launch import LaunchDescription\n\n\n"
                f"class Leg:\n    def {FUNCTION}(self):\n        return LaunchDescription([])\n",
            },
            Report(
                "launch/arm.launch.py:1:1",
                "`ros2 launch` calls generate_launch_description, which this file does not define",
                severity=Severity.WARNING,
            ),
            "launch/leg.launch.py:1:1: `ros2 launch` calls generate_launch_description, which "
            "this file does not define",
        ),
        Example(
            "a description that is created, but not returned",
            {"launch/a.launch.py": _LAUNCH_RESULT + "    LaunchDescription([node])\n"},
            Report(
                "7:5",
                "the LaunchDescription is created, but generate_launch_description returns None",
                fix="Return the launch description",
            ),
            fixed={"launch/a.launch.py": _LAUNCH_RESULT + "    return LaunchDescription([node])\n"},
        ),
        Example(
            "nothing returned if a file cannot be read",
            {
                "launch/a.launch.py": _LAUNCH_RESULT
                + "    try:\n        words = open('words.txt').read()\n"
                "    except OSError:\n        return None\n"
                "    return LaunchDescription([node, words])\n"
            },
            Report(
                "10:9",
                "generate_launch_description returns None, not a LaunchDescription",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "a list returned; a description on one path only",
            {
                "launch/a.launch.py": _LAUNCH_RESULT + "    return [node]\n",
                "launch/b.launch.py": _LAUNCH_RESULT
                + "    if node:\n        return LaunchDescription([node])\n",
            },
            Report(
                "launch/a.launch.py:7:5",
                "generate_launch_description returns a list, not a LaunchDescription",
            ),
            Report(
                "launch/b.launch.py:5:5",
                "generate_launch_description returns None on some paths, not a LaunchDescription",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "a tuple, and the class itself",
            {
                "launch/a.launch.py": _LAUNCH_RESULT + "    return node, node\n",
                "launch/b.launch.py": _LAUNCH_RESULT + "    return LaunchDescription\n",
            },
            "launch/a.launch.py:7:5: generate_launch_description returns a tuple, not a "
            "LaunchDescription",
            "launch/b.launch.py:7:5: generate_launch_description returns the class, not a "
            "LaunchDescription",
        ),
    )

    def check_in(self, package: Package, launch: LaunchFile) -> Iterator[Diagnostic]:
        yield from self._check_defined(package, launch)
        yield from self._check_result(launch)

    def _check_defined(self, package: Package, launch: LaunchFile) -> Iterator[Diagnostic]:
        module = launch.module
        name = launch.path.rpartition("/")[2]
        if module.defines(FUNCTION) is not False:
            return
        is_test = "generate_test_description" in module.functions
        if "/launch/" not in f"/{launch.path}" or is_test or _is_loaded(package, launch.path):
            return
        closest = get_close_matches(FUNCTION, module.functions, 1, 0.85)
        if not name.endswith("launch.py") and (not closest or _is_imported(package, launch.path)):
            return
        if closest:
            at = module.functions[closest[0]].location
            start = module.source.offset(at.line, at.column)
            edit = Edit(launch.path, start, start + len(closest[0]), FUNCTION)
            message = f"`ros2 launch` calls {FUNCTION}, not {closest[0]}"
            yield self.report(at, message, Fix(f"Replace with {FUNCTION}", (edit,)))
        else:
            message = f"`ros2 launch` calls {FUNCTION}, which this file does not define"
            severity = Severity.WARNING if _is_of_classes(launch) else None
            yield self.report(package.start_of(launch.path), message, severity=severity)

    def _check_result(self, launch: LaunchFile) -> Iterator[Diagnostic]:
        function = launch.function
        if function is None or not isinstance(function.node, ast.FunctionDef):
            return
        node = function.node
        if node.decorator_list or any(launch.module.below(node, ast.Yield, ast.YieldFrom)):
            return
        yield from self._check(launch, node, function.location)

    def _check(
        self, launch: LaunchFile, node: ast.FunctionDef, at: Location
    ) -> Iterator[Diagnostic]:
        statements = sorted(returned(node), key=lambda item: item.lineno)
        for item in statements:
            wrong = _wrong_result(launch, item.value)
            if wrong:
                message = f"generate_launch_description returns {wrong}, not a LaunchDescription"
                severity = Severity.WARNING if _is_after_failure(launch, item) else None
                yield self.report(launch.location(item), message, severity=severity)
        if not may_end(node):
            return
        last = node.body[-1]
        made = launch.call_of(last.value) if isinstance(last, ast.Expr) else None
        if made is not None and made.kind == "LaunchDescription" and not statements:
            start, _ = launch.module.span(last)
            fix = Fix(
                "Return the launch description", (Edit(launch.path, start, start, "return "),)
            )
            message = (
                "the LaunchDescription is created, but generate_launch_description returns None"
            )
            yield self.report(launch.location(last), message, fix)
        else:
            some = " on some paths" if statements else ""
            message = f"generate_launch_description returns None{some}, not a LaunchDescription"
            severity = Severity.WARNING if statements else None
            yield self.report(at, message, severity=severity)


def _is_of_classes(launch: LaunchFile) -> bool:
    """Return whether a file only defines classes with bases of other modules.

    A program that knows the bases may load such a file, so that nobody launches it.
    """
    module = launch.module
    classes = [item.node for item in module.classes.values()]
    if not classes or module.functions or not all(node.bases for node in classes):
        return False
    bases = [base for node in classes for base in node.bases]
    return all("." in (module.qualified_name(base) or "") for base in bases)


def _is_after_failure(launch: LaunchFile, statement: ast.AST) -> bool:
    """Return whether a statement handles an exception, so that the launch stops anyway."""
    return any(isinstance(parent, ast.ExceptHandler) for parent in launch.module.parents(statement))


def _is_loaded(package: Package, path: str) -> bool:
    """Return whether launch files use a file as a module, instead of launching it."""
    module = path.removesuffix(".py").replace("/", ".")
    return path.rpartition("/")[2] in _loaded_files(package) or any(
        item.module == module
        for other in (package, *package.workspace)
        for importing, imports in imports_by_path(other)
        if ".launch." in importing or importing.endswith("_launch.py")
        for item in imports
    )


def _is_imported(package: Package, path: str) -> bool:
    """Return whether any code imports a module of this name."""
    stem = path.rpartition("/")[2].removesuffix(".py")
    return any(
        stem in item.module.split(".") or any(name.name == stem for name in item.names)
        for other in (package, *package.workspace)
        for _, imports in imports_by_path(other)
        for item in imports
    )


@fact
def _loaded_files(package: Package) -> frozenset[str]:
    """Return the names of the files that launch files import as modules."""
    return frozenset(
        text.value.rpartition("/")[2]
        for path in paths_importing(package, "runpy", "importlib")
        if "launch" in path
        for call in package.module(path).calls_of(*_LOADERS)
        for text in ast.walk(call)
        if isinstance(text, ast.Constant) and isinstance(text.value, str)
    )


def _wrong_result(launch: LaunchFile, value: ast.expr | None) -> str | None:
    """Return the returned expression, if it is certainly not a LaunchDescription."""
    if value is None or is_none_literal(value):
        return "None"
    if isinstance(value, ast.List | ast.Tuple | ast.ListComp):
        return "a list" if not isinstance(value, ast.Tuple) else "a tuple"
    call = launch.call_of(value)
    if call is not None and call.kind in {"Node", "IncludeLaunchDescription", "ExecuteProcess"}:
        return f"a {call.kind}"
    names = launch.module.qualified_names(value)
    return "the class" if any(name.endswith(".LaunchDescription") for name in names) else None
