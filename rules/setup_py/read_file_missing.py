"""SP054: what setup.py reads and names exists."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Report, Rule

_SETUP = "from setuptools import setup\n\nsetup(\n    name='talker',\n    {},\n)\n"
_READ = "long_description=open('README.md').read()"


class ReadFileMissing(Rule):
    """setup.py opens a file, or names a script, that does not exist.

    **Why.** The build stops: ``FileNotFoundError: [Errno 2] No such file or directory``.

    **Fix.** Correct the name, or remove it.

    **Source.** Python documentation, ``open``; setuptools documentation, ``scripts``.
    """

    code = "SP054"
    name = "read-file-missing"
    examples = (
        Example("there", {"setup.py": _SETUP.format(_READ), "README.md": "# talker\n"}),
        Example(
            "asked for first",
            {
                "setup.py": _SETUP.format(
                    f"{_READ} if __import__('os').path.exists('README.md') else ''"
                )
            },
        ),
        Example(
            "missing",
            {"setup.py": _SETUP.format(_READ)},
            Report("5:27", "setup.py opens README.md, which does not exist: the build stops"),
        ),
        Example(
            "a script",
            {"setup.py": _SETUP.format("scripts=['scripts/talk']")},
            Report("5:13", "scripts names scripts/talk, which does not exist: the build stops"),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        setup = package.setup_py
        module = setup.module
        for call in module.walk(ast.Call):
            if module.qualified_name(call.func) not in {"open", "io.open", "codecs.open"}:
                continue
            modes = [arg.value for arg in call.args[1:] if isinstance(arg, ast.Constant)]
            name = call.args[0].value if call.args and isinstance(call.args[0], ast.Constant) else 0
            is_optional = any(
                isinstance(parent, ast.Try | ast.If | ast.IfExp) for parent in module.parents(call)
            )
            if not isinstance(name, str) or is_optional or "w" in "".join(map(str, modes)):
                continue
            if not _exists(package, name):
                message = f"setup.py opens {name}, which does not exist: the build stops"
                yield self.report(module.location(call.args[0]), message)
        scripts = setup.keyword("scripts")
        for name in scripts.value if scripts and isinstance(scripts.value, list) else ():
            if isinstance(name, str) and scripts and not _exists(package, name):
                message = f"scripts names {name}, which does not exist: the build stops"
                yield self.report(scripts, message)


def _exists(package: Package, name: str) -> bool:
    return name.startswith(("/", "..")) or package.has(name.removeprefix("./"))
