"""ND022: an installed script starts its main function."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Edit, Example, Fix, Package, Rule
from scaffold.model.cmake_facts import programs

_LISTS = "project(talker)\ninstall(PROGRAMS talker/node.py DESTINATION lib/${PROJECT_NAME})\n"
_MAIN = "#!/usr/bin/env python3\nimport rclpy\n\n\ndef main():\n    rclpy.init()\n"
_GUARD = "\n\nif __name__ == '__main__':\n    main()\n"


class MainGuardMissing(Rule):
    """An installed script defines ``main`` and does not call it.

    **Why.** ``ros2 run`` returns at once, with exit code 0 and no output.

    **Fix.** End with ``if __name__ == '__main__': main()``.

    **Source.** ROS 2 documentation, "Writing a simple publisher and subscriber (Python)".
    """

    code = "ND022"
    name = "main-guard-missing"
    examples = (
        Example("guarded", {"CMakeLists.txt": _LISTS, "talker/node.py": _MAIN + _GUARD}),
        Example(
            "never called",
            {"CMakeLists.txt": _LISTS, "talker/node.py": _MAIN},
            at=("talker/node.py:5",),
            fixed={"talker/node.py": _MAIN + _GUARD},
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for path in sorted({program.path for program in programs(package)}):
            if not package.has(path) or path not in package.python_files:
                continue
            module = package.module(path)
            main = module.functions.get("main")
            if main is None or module.has_main_guard or "main(" in self._rest(module.source.text):
                continue
            end = len(module.source.text)
            text = _GUARD if module.source.text.endswith("\n") else f"\n{_GUARD}"
            fix = Fix("call main()", (Edit(path, end, end, text),))
            yield self.report(main, "installed as a program, but nothing calls main()", fix)

    def _rest(self, text: str) -> str:
        return text.replace("def main(", "")
