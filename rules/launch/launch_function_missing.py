"""LF002: a launch file defines generate_launch_description."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from difflib import get_close_matches

from scaffold.api import Diagnostic, Edit, Example, Fix, LaunchRule, Package, Report, fact
from scaffold.api.launch import FUNCTION, LaunchFile
from scaffold.api.python import paths_importing

_LOADERS = frozenset(
    {
        "runpy.run_path",
        "importlib.util.spec_from_file_location",
        "importlib.machinery.SourceFileLoader",
    }
)
_LAUNCH = "from launch import LaunchDescription\n\n\ndef {}():\n    return LaunchDescription([])\n"


class LaunchFunctionMissing(LaunchRule):
    """A launch file does not define ``generate_launch_description``.

    **Why.** ``ros2 launch``: ``launch file ... does not contain the required function
    'generate_launch_description()'``.

    **Fix.** Define it, under exactly this name.

    **Source.** ``launch/launch_description_sources/python_launch_file_utilities.py``.
    """

    code = "LF002"
    name = "launch-function-missing"
    examples = (
        Example("defined", {"launch/a.launch.py": _LAUNCH.format(FUNCTION)}),
        Example(
            "misspelled",
            {"launch/a.launch.py": _LAUNCH.format("generate_launch_descriptions")},
            Report(
                "4:5",
                "`ros2 launch` calls generate_launch_description, not generate_launch_descriptions",
                fix="write generate_launch_description",
            ),
            fixed={"launch/a.launch.py": _LAUNCH.format(FUNCTION)},
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
            "not there",
            {"launch/a.launch.py": "from launch import LaunchDescription\n\nLaunchDescription()\n"},
            Report(
                "1:1",
                "`ros2 launch` calls generate_launch_description, which this file does not define",
            ),
        ),
    )

    def check_in(self, package: Package, launch: LaunchFile) -> Iterator[Diagnostic]:
        module = launch.module
        name = launch.path.rpartition("/")[2]
        if not name.endswith("launch.py") or module.defines(FUNCTION) is not False:
            return
        is_test = "generate_test_description" in module.functions
        if "/launch/" not in f"/{launch.path}" or is_test or name in _loaded_files(package):
            return
        closest = get_close_matches(FUNCTION, module.functions, 1, 0.85)
        if closest:
            at = module.functions[closest[0]].location
            start = module.source.offset(at.line, at.column)
            edit = Edit(launch.path, start, start + len(closest[0]), FUNCTION)
            message = f"`ros2 launch` calls {FUNCTION}, not {closest[0]}"
            yield self.report(at, message, Fix(f"write {FUNCTION}", (edit,)))
        else:
            message = f"`ros2 launch` calls {FUNCTION}, which this file does not define"
            yield self.report(package.start_of(launch.path), message)


@fact
def _loaded_files(package: Package) -> frozenset[str]:
    """Return the names of the files that launch files load as modules, and not as launch files."""
    return frozenset(
        text.value.rpartition("/")[2]
        for path in paths_importing(package, "runpy", "importlib")
        if "launch" in path
        for call in package.module(path).walk(ast.Call)
        if package.module(path).qualified_name(call.func) in _LOADERS
        for text in ast.walk(call)
        if isinstance(text, ast.Constant) and isinstance(text.value, str)
    )
