"""SP001: entry points lead to functions."""

from __future__ import annotations

from collections.abc import Iterator
from difflib import get_close_matches

from scaffold.api import Diagnostic, Example, Package, Report, Rule, ViewError
from scaffold.api.install import moved_to
from scaffold.api.python import exports_of
from scaffold.api.setup_py import EntryPoint

_SETUP = (
    "from setuptools import setup\n\n"
    "setup(\n    entry_points={{'console_scripts': [\n{}    ]}},\n)\n"
)


class EntryPointMissing(Rule):
    """A console script names a module or a function that does not exist.

    **Why.** The build passes; ``ros2 run`` ends with ``ModuleNotFoundError`` or
    ``AttributeError: module 'talker.node' has no attribute 'run'``. Nothing awaits an
    ``async`` function.

    **Fix.** Write the module and function that exist.

    **Source.** ROS 2 documentation, "Writing a simple publisher and subscriber (Python)".
    """

    code = "SP001"
    name = "entry-point-missing"
    examples = (
        Example(
            "a function that is there",
            {
                "setup.py": _SETUP.format("        'talker = talker.node:main',\n"),
                "talker/__init__.py": "",
                "talker/node.py": "def main():\n    pass\n",
            },
        ),
        Example(
            "another function, another module",
            {
                "setup.py": _SETUP.format(
                    "        'talker = talker.node:run',\n        'other = talker.nodes:main',\n"
                ),
                "talker/__init__.py": "",
                "talker/node.py": "def main():\n    pass\n",
            },
            Report("setup.py:5:9", "`ros2 run` of 'talker' fails: talker/node.py has no 'run'"),
            Report(
                "setup.py:6:9",
                "`ros2 run` of 'other' fails: there is no talker/nodes.py; closest: talker/node.py",
            ),
        ),
        Example(
            "a coroutine",
            {
                "setup.py": _SETUP.format("        'talker = talker.node:main',\n"),
                "talker/__init__.py": "",
                "talker/node.py": "async def main():\n    pass\n",
            },
            Report(
                "setup.py:5:9",
                "`ros2 run` of 'talker' fails: talker/node.py has an async main(), which nothing "
                "awaits; use asyncio.run()",
            ),
        ),
        Example(
            "packages that do not exist",
            {
                "package.xml": "<package><name>listener</name></package>\n",
                "setup.py": _SETUP.format(
                    "        'a = talkr.node:main',\n        'b = listener.node:main',\n"
                ),
                "talker/__init__.py": "",
            },
            Report(
                "setup.py:5:9",
                "`ros2 run` of 'a' fails: the package has no module 'talkr'; closest: talker",
            ),
            Report("setup.py:6:9", "`ros2 run` of 'b' fails: there is no directory listener/"),
        ),
        Example(
            "a module of another package here, which SP053 reports",
            {
                "setup.py": _SETUP.format("        'talker = talkr.node:main',\n"),
                "talker/__init__.py": "",
                "talker/node.py": "def main():\n    pass\n",
            },
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        if package.build_type == "ament_cmake":
            return  # nothing runs setup.py there
        for entry in package.setup_py.console_scripts:
            if entry.malformed or not entry.module or not entry.function:
                continue
            problem = self._problem(package, entry)
            if problem:
                message = f"`ros2 run` of {entry.name!r} fails: {problem}"
                directory = moved_to(package, entry.module)
                cause = f"moved to {directory}" if directory else ""
                yield self.report(entry, message, cause=cause)

    def _problem(self, package: Package, entry: EntryPoint) -> str | None:
        root, *_ = entry.module.split(".")
        if not package.has_directory(root):
            return self._missing_package(package, entry.module)
        base = entry.module.replace(".", "/")
        path = next((p for p in (f"{base}.py", f"{base}/__init__.py") if package.has(p)), None)
        if path is None:
            modules = [path for path in package.python_files if not path.endswith("__.py")]
            closest = get_close_matches(f"{base}.py", modules, n=1)
            hint = f"; closest: {closest[0]}" if closest else ""
            return f"there is no {base}.py{hint}"
        try:
            exports = exports_of(package, path)
        except ViewError:
            return None
        function = entry.function.partition(".")[0]
        if function in exports.coroutines:
            return f"{path} has an async {function}(), which nothing awaits; use asyncio.run()"
        if exports.defines(function) is not False:
            return None
        closest = get_close_matches(function, exports.functions, n=1)
        hint = f"; it has {closest[0]}()" if closest else ""
        return f"{path} has no {function!r}{hint}"

    def _missing_package(self, package: Package, module: str) -> str | None:
        root, _, rest = module.partition(".")
        where = package.setup_py.keyword("package_dir")
        own = [path.partition("/")[0] for path in package.glob("*/__init__.py")]
        if where is None and any(
            package.has(f"{other}/{rest.replace('.', '/')}.py") for other in own
        ):
            return None  # SP053 says which module it is
        if where is not None or package.has(f"{root}.py") or root not in {package.name, *own}:
            closest = get_close_matches(root, own, n=1)
            if where is None and closest and not package.has(f"{root}.py"):
                return f"the package has no module {root!r}; closest: {closest[0]}"
            return None
        return f"there is no directory {root}/"
