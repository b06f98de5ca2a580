"""ND022: installed scripts call their main function."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Edit, Effect, Example, Fix, Location, Package, Report, Rule
from scaffold.api.cmake import programs
from scaffold.api.python import PythonModule

_LISTS = "project(talker)\ninstall(PROGRAMS talker/node.py DESTINATION lib/${PROJECT_NAME})\n"
_MAIN = "#!/usr/bin/env python3\nimport rclpy\n\n\ndef main():\n    rclpy.init()\n"
_GUARD = "\n\nif __name__ == '__main__':\n    main()\n"


class MainGuardMissing(Rule):
    """An installed script defines ``main`` but does not call it.

    **Why.** ``ros2 run`` exits at once, with exit code 0 and no output.

    **Fix.** End with ``if __name__ == '__main__': main()``.

    **Source.** ROS 2 documentation, "Writing a simple publisher and subscriber (Python)".
    """

    code = "ND022"
    name = "main-guard-missing"
    effect = Effect.WRONG_BEHAVIOR
    examples = (
        Example("guarded", {"CMakeLists.txt": _LISTS, "talker/node.py": _MAIN + _GUARD}),
        Example(
            "never called",
            {"CMakeLists.txt": _LISTS, "talker/node.py": _MAIN},
            Report(
                "talker/node.py:5:5",
                "installed as an executable, but main() is never called: it exits at once; "
                "add the call",
                fix="Add a call of main()",
            ),
            fixed={"talker/node.py": _MAIN + _GUARD},
        ),
        Example(
            "misspelled, and not called",
            {
                "CMakeLists.txt": _LISTS + _LISTS.partition("\n")[2].replace("node", "other"),
                "talker/node.py": _MAIN + _GUARD.replace("__main__", "main"),
                "talker/other.py": _MAIN + _GUARD.replace("main()", "main"),
            },
            "talker/node.py:9:4: __name__ is never 'main'; did you mean '__main__'?",
            "talker/other.py:10:5: 'main' is not called here; write main()",
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        for path in sorted({program.path for program in programs(package)}):
            if not package.has(path) or path not in package.python_files:
                continue
            module = package.module(path)
            main = module.functions.get("main")
            if main is None:
                continue
            problem = self._guard_problem(module)
            if problem is not None:
                yield self.report(*problem)
                continue
            if module.has_main_guard or "main(" in self._without_definition(module.source.text):
                continue
            end = len(module.source.text)
            text = _GUARD if module.source.text.endswith("\n") else f"\n{_GUARD}"
            fix = Fix("Add a call of main()", (Edit(path, end, end, text),))
            yield self.report(
                main,
                "installed as an executable, but main() is never called: it exits "
                "at once; add the call",
                fix,
            )

    def _guard_problem(self, module: PythonModule) -> tuple[Location, str] | None:
        """Return the message for a wrong comparison of ``__name__``, and its place."""
        for statement in module.tree.body:
            test = statement.test if isinstance(statement, ast.If) else None
            match test:
                case ast.Compare(left=ast.Name(id="__name__"), comparators=[ast.Constant(value)]):
                    if value != "__main__" and str(value).strip("_") == "main":
                        message = f"__name__ is never {value!r}; did you mean '__main__'?"
                        return module.location(test), message
                    body = statement.body if isinstance(statement, ast.If) else []
                    if value == "__main__" and _only_names_main(body):
                        return module.location(body[0]), "'main' is not called here; write main()"
        return None

    def _without_definition(self, text: str) -> str:
        return text.replace("def main(", "")


def _only_names_main(body: list[ast.stmt]) -> bool:
    match body:
        case [ast.Expr(value=ast.Name(id="main"))]:
            return True
    return False
