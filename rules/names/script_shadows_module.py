"""NM040: scripts do not shadow modules."""

from __future__ import annotations

import sys
from collections.abc import Iterator

from scaffold.api import Diagnostic, Effect, Example, Package, Rule
from scaffold.api.catalog import ROS_PACKAGES
from scaffold.api.cmake import programs

_LISTS = "project(talker)\ninstall(PROGRAMS talker/{}.py DESTINATION lib/${{PROJECT_NAME}})\n"


class ScriptShadowsModule(Rule):
    """An installed script has the same name as a module that nodes import.

    **Why.** Python searches the directory of the script first: every program installed next to it
    that imports ``logging`` or ``queue``, as rclpy does, imports the script instead and fails.

    **Fix.** Rename the script, or install it without its extension: ``RENAME``.

    **Source.** Python documentation, ``sys.path``.
    """

    code = "NM040"
    name = "script-shadows-module"
    effect = Effect.STOPS_PACKAGE
    examples = (
        Example("a unique name", {"CMakeLists.txt": _LISTS.format("node"), "talker/node.py": ""}),
        Example(
            "the name of a standard library module",
            {"CMakeLists.txt": _LISTS.format("logging"), "talker/logging.py": ""},
            "CMakeLists.txt:2:18: logging.py shadows the module 'logging' in all scripts next to "
            "it: their imports fail; rename it",
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for program in programs(package):
            stem, _, ending = program.name.rpartition(".")
            if ending != "py":
                continue
            if stem in sys.stdlib_module_names or (stem in ROS_PACKAGES and stem != package.name):
                message = (
                    f"{program.name} shadows the module {stem!r} in all scripts next to it: "
                    f"their imports fail; rename it"
                )
                yield self.report(program, message)
