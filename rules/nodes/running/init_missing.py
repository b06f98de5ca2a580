"""ND041: rclpy is initialized before a node is constructed."""

from __future__ import annotations

import ast
import builtins
import sys
from collections.abc import Iterator

from scaffold.api import Diagnostic, Effect, Example, Location, Package, Rule, ViewError, fact
from scaffold.api.programs import Execution, entry_points_of, execution_of, imported_paths
from scaffold.api.rclpy import RclpyFile

_NODE = (
    "#!/usr/bin/env python3\nimport rclpy\nfrom rclpy.node import Node\n\n\n"
    "class Talker(Node):\n"
    "    def __init__(self):\n"
    "        super().__init__('talker')\n\n\n"
    "def main():\n{}\n\n"
    "if __name__ == '__main__':\n    main()\n"
)
_SPIN = "    rclpy.spin(node)\n"
_CMAKE = (
    "project(demo)\n"
    "install(PROGRAMS demo/talker.py DESTINATION lib/${PROJECT_NAME})\n"
    "ament_package()\n"
)
_XML = "<package><name>demo</name><export><build_type>ament_cmake</build_type></export></package>\n"
_FILES = {"package.xml": _XML, "CMakeLists.txt": _CMAKE}
_HARMLESS = frozenset({"rclpy", *dir(builtins)})


class InitMissing(Rule):
    """A program constructs a node without calling ``rclpy.init`` first.

    **Why.** ``NotInitializedException: rclpy.init() has not been called. msg:cannot create node``.

    **Fix.** Call ``rclpy.init(args=args)`` first.

    **Source.** ``rclpy/node.py``, ``Node.__init__``.
    """

    code = "ND041"
    name = "init-missing"
    effect = Effect.STOPS_START
    examples = (
        Example(
            "initialized",
            {
                **_FILES,
                "demo/talker.py": _NODE.format("    rclpy.init()\n    node = Talker()\n" + _SPIN),
            },
        ),
        Example(
            "never",
            {**_FILES, "demo/talker.py": _NODE.format("    node = Talker()\n" + _SPIN)},
            "demo/talker.py:12:12: Talker is constructed without rclpy.init(): "
            "NotInitializedException; call it first",
        ),
        Example(
            "too late",
            {
                **_FILES,
                "demo/talker.py": _NODE.format("    node = Talker()\n    rclpy.init()\n" + _SPIN),
            },
            "demo/talker.py:12:12: Talker is constructed before rclpy.init() in line 13: "
            "NotInitializedException",
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        reported: set[Location] = set()
        for start in entry_points_of(package):
            try:
                problem = _problem_of(package, start.path, start.function)
            except ViewError:
                continue
            if problem is not None and problem[0] not in reported:
                reported.add(problem[0])
                yield self.report(*problem)


@fact
def _problem_of(package: Package, path: str, function: str | None) -> tuple[Location, str] | None:
    """Return the place and message of the problem of a program; raises ViewError."""
    run = execution_of(package, path, function)
    first = next(iter(run.nodes()), None)
    if first is None or run.file.module.in_tests:
        return None
    problem = _problem(package, run, first[0])
    return (run.file.module.location(first[0]), problem) if problem else None


def _problem(package: Package, run: Execution, made: ast.Call) -> str | None:
    file = run.file
    late = _late_init(file, made)
    own = file.module.path
    for path in imported_paths(package, own):
        if _may_init(package, path) and not (late and path == own):
            return None
    if any(word.arg in {"context", None} for word in made.keywords):
        return None
    if any(function.decorator_list for function in run.functions) or _calls_others(
        package, run, made
    ):
        return None
    name = file.module.text(made.func)
    if late is not None:
        line = file.module.location(late).line
        return f"{name} is constructed before rclpy.init() in line {line}: NotInitializedException"
    return f"{name} is constructed without rclpy.init(): NotInitializedException; call it first"


def _late_init(file: RclpyFile, made: ast.Call) -> ast.Call | None:
    """Return the only initialization of a file, if it comes too late in the same function."""
    mentions = [*file.module.index.attributes("init"), *file.module.index.names("init")]
    if len(file.init_calls) != 1 or len(mentions) != 1:
        return None
    call = file.init_calls[0].call
    is_certain = not file.is_conditional(call) and not file.is_conditional(made)
    is_same = file.function_of(call) is file.function_of(made)
    return call if is_certain and is_same and call.lineno > made.lineno else None


@fact
def _may_init(package: Package, path: str) -> bool:
    """Return whether a file may initialize rclpy, or creates its own context; raises ViewError."""
    module = package.module(path)
    index = module.index
    for name in ("init", "Context"):
        if index.attributes(name) or index.names(name):
            return True
    return any(
        name.name in {"init", "Context"} or (name.name == "*" and not _is_standard(item.root))
        for item in module.imports
        for name in item.names
    )


def _calls_others(package: Package, run: Execution, made: ast.Call) -> bool:
    """Return whether foreign code runs before the node is created, which may initialize rclpy."""
    module = run.file.module
    function = run.file.function_of(made)
    own = {part for path in package.python_files for part in path.split("/")}
    for call in run.calls:
        is_later = run.file.function_of(call) is function and call.lineno > made.lineno
        if call is made or is_later or module.enclosing_class(call) is not None:
            continue
        for name in module.qualified_names(call.func):
            root = name.partition(".")[0]
            is_own = root in own or f"{root}.py" in own
            if root and root not in _HARMLESS and not is_own and not _is_standard(root):
                return True
    return False


def _is_standard(root: str) -> bool:
    return root in sys.stdlib_module_names
