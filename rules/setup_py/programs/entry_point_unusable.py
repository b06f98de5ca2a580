"""SP001: console scripts are ``name = module:function``, with a function that can be called."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from difflib import get_close_matches

from scaffold.api import (
    Diagnostic,
    Example,
    Location,
    Package,
    Report,
    Rule,
    Severity,
    ViewError,
    fact,
)
from scaffold.api.install import file_of, is_elsewhere, moved_to
from scaffold.api.python import exports_of
from scaffold.api.rclpy import rclpy_file
from scaffold.api.setup_py import (
    ConfiguredScript,
    EntryPoint,
    configured_scripts,
    installs_configured,
)

_SIMILAR = 0.7
"""Minimum similarity, from 0 to 1, of a suggested module name."""
_MISSING = "there is no"
_SETUP = (
    "from setuptools import setup\n\n"
    "setup(\n    entry_points={{'console_scripts': [\n{}    ]}},\n)\n"
)
_SETUP_NAMES = (
    "from setuptools import setup\n\nsetup(\n    name='talker',\n    packages=['talker'],\n"
    "    entry_points={{'console_scripts': [\n"
    "        'talker = talker.node:main',\n"
    "        '{} = talker.other:main',\n"
    "    ]}},\n)\n"
)
_SETUP_USE = (
    "from setuptools import setup\n\nsetup(\n    name='talker',\n    packages=['talker'],\n"
    "    entry_points={{'console_scripts': ['node = {}:main']}},\n)\n"
)
_CONFIGURED = {
    "package.xml": '<package format="3"><name>talker</name><export>'
    "<build_type>ament_cmake</build_type></export></package>\n",
    "CMakeLists.txt": "project(talker)\nfind_package(ament_cmake_python REQUIRED)\n"
    "ament_python_install_package(talker SCRIPTS_DESTINATION lib/${PROJECT_NAME})\n"
    "ament_package()\n",
}
_FILES = {"talker/__init__.py": "", "talker/node.py": "def main(args=None):\n    pass\n"}


class EntryPointUnusable(Rule):
    """A console script is malformed, repeated, or does not name a function without arguments.

    **Why.** setuptools stops the build, joins two lines without a comma between them, or creates
    only the last of two scripts with the same name. Otherwise, the build succeeds, but ``ros2 run``
    fails with ``ModuleNotFoundError: No module named 'node'``, ``AttributeError: module
    'talker.node' has no attribute 'run'`` or ``TypeError: main() missing 1 required positional
    argument``. An ``async`` function is never awaited.

    **Fix.** Write ``'name = package.module:function'`` with a comma after each script, and ``def
    main(args=None):``.

    **Source.** setuptools documentation, "Entry points"; Python packaging user guide, "Entry points
    specification"; ROS 2 documentation, "Writing a simple publisher and subscriber (Python)".
    """

    code = "SP001"
    name = "entry-point-unusable"
    other_severities = {
        Severity.WARNING: "the function is missing, but the module runs its node on import, or "
        "CMake builds the package and setup.py is not used"
    }
    examples = (
        Example(
            "one script", {"setup.py": _SETUP.format("        'talker = talker.node:main',\n")}
        ),
        Example(
            "a module whose name starts with a digit, imported with importlib",
            {
                "setup.py": _SETUP.format("        'see = talker.4_see:main',\n"),
                "talker/__init__.py": "",
                "talker/4_see.py": "def main():\n    pass\n",
            },
        ),
        Example(
            "a missing comma",
            {
                "setup.py": _SETUP.format(
                    "        'talker = talker.node:main'\n"
                    "        'listener = listener.node:main',\n"
                )
            },
            "5:9: missing comma after this console script: it is joined to the next",
        ),
        Example(
            "no function",
            {"setup.py": _SETUP.format("        'talker = talker.node',\n")},
            "5:9: console script 'talker = talker.node': no function is named: name = "
            "module:function",
        ),
        Example(
            "no function, in a module that runs its node on import",
            {
                "setup.py": _SETUP.format("        'talker = talker.node',\n"),
                "talker/__init__.py": "",
                "talker/node.py": "import rclpy\n\nrclpy.init()\n"
                "rclpy.spin(rclpy.create_node('talker'))\n",
            },
            Report(
                "setup.py:5:9",
                "console script 'talker = talker.node': no function is named: name "
                "= module:function",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "no such function, in a module that serves on import",
            {
                "setup.py": _SETUP.format("        'serve = talker.serve:main',\n"),
                "talker/__init__.py": "",
                "talker/serve.py": "from http.server import HTTPServer, SimpleHTTPRequestHandler\n"
                "\nserver = HTTPServer(('127.0.0.1', 8000), SimpleHTTPRequestHandler)\n"
                "server.serve_forever()\n",
            },
            Report(
                "setup.py:5:9",
                "`ros2 run` of 'serve' fails when the module ends: talker/serve.py has no 'main'",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "two scripts with the same name",
            {"setup.py": _SETUP_NAMES.format("talker")},
            "8:9: 'talker' is also the name of another entry point: only one is installed",
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
            "setup.py:5:9: `ros2 run` of 'talker' fails: talker/node.py has no 'run'",
            "setup.py:6:9: `ros2 run` of 'other' fails: there is no talker/nodes.py; did you mean "
            "talker/node.py?",
        ),
        Example(
            "a coroutine",
            {
                "setup.py": _SETUP.format("        'talker = talker.node:main',\n"),
                "talker/__init__.py": "",
                "talker/node.py": "async def main():\n    pass\n",
            },
            "setup.py:5:9: `ros2 run` of 'talker' fails: talker/node.py has an async main(), "
            "which is never awaited; use asyncio.run()",
        ),
        Example(
            "a module in another directory",
            {
                "setup.py": _SETUP.format("        'talk = talker.talk:main',\n"),
                "talker/__init__.py": "",
                "talker/walk.py": "",
                "scripts/talk.py": "",
            },
            "setup.py:5:9: `ros2 run` of 'talk' fails: there is no talker/talk.py; did you mean "
            "scripts/talk.py?",
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
            "setup.py:5:9: `ros2 run` of 'a' fails: the package has no module 'talkr'; did you "
            "mean talker?",
            "setup.py:6:9: `ros2 run` of 'b' fails: directory listener/ does not exist",
        ),
        Example(
            "a module of another package in the workspace",
            {
                "setup.py": _SETUP.format("        'talker = talkr.node:main',\n"),
                "talker/__init__.py": "",
                "talker/node.py": "def main():\n    pass\n",
            },
            "setup.py:5:9: no module 'talkr.node' is installed; did you mean 'talker.node'?",
        ),
        Example(
            "setup.cfg in a package that CMake builds",
            {
                **_CONFIGURED,
                **_FILES,
                "setup.cfg": "[options.entry_points]\nconsole_scripts =\n"
                "  node = talker.node:main\n  talk = talker.talk:main\n"
                "  run = talker.node:run\n",
            },
            "setup.cfg:4:3: `ros2 run` of 'talk' fails: there is no talker/talk.py",
            "setup.cfg:5:3: `ros2 run` of 'run' fails: talker/node.py has no 'run'",
        ),
        Example(
            "an existing function",
            {"setup.py": _SETUP_USE.format("talker.node"), **_FILES},
        ),
        Example(
            "without the package",
            {"setup.py": _SETUP_USE.format("node"), **_FILES},
            "setup.py:6:39: no module 'node' is installed; did you mean 'talker.node'?",
        ),
        Example(
            "another package",
            {"setup.py": _SETUP_USE.format("my_package.node"), **_FILES},
            "setup.py:6:39: no module 'my_package.node' is installed; did you mean 'talker.node'?",
        ),
        Example(
            "an argument",
            {
                "setup.py": _SETUP_USE.format("talker.node"),
                **_FILES,
                "talker/node.py": "def main(args):\n    pass\n",
            },
            "talker/node.py:1:5: the entry point 'node' of setup.py calls main() without "
            "arguments: TypeError; give args a default",
        ),
        Example(
            "a node class",
            {
                "setup.py": _SETUP_USE.format("talker.node").replace(":main", ":Talker"),
                **_FILES,
                "talker/node.py": "from rclpy.node import Node\n\n\n"
                "class Talker(Node):\n    pass\n",
            },
            "setup.py:6:39: Talker is a node class: nothing spins it; write a function that does",
        ),
        Example(
            "no function, in a package that CMake builds",
            {
                "setup.py": _SETUP.format("'node = talker.node',\n"),
                **_FILES,
                "CMakeLists.txt": "project(talker)\nfind_package(ament_cmake REQUIRED)\n",
                "package.xml": "<package><export><build_type>ament_cmake</build_type></export>"
                "</package>\n",
            },
            Report(
                "setup.py:5:1",
                "console script 'node = talker.node': no function is named: name = module:function",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "another package, in a package that CMake builds",
            {
                "setup.py": _SETUP_USE.format("my_package.node"),
                **_FILES,
                "CMakeLists.txt": "project(talker)\nfind_package(ament_cmake REQUIRED)\n",
                "package.xml": "<package><export><build_type>ament_cmake</build_type></export>"
                "</package>\n",
            },
            Report(
                "setup.py:6:39",
                "no module 'my_package.node' is installed; did you mean 'talker.node'?",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "a misspelled function",
            {**_FILES, "setup.py": _SETUP.format("        'node = talker.node:mian',\n")},
            "setup.py:5:9: `ros2 run` of 'node' fails: talker/node.py has no 'mian'; it has main()",
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        yield from self._check_configured(package)
        is_unused = package.build_type == "ament_cmake"  # setup.py is not run there
        checks = [self._check_form, self._check_names, self._check_use]
        for check in checks if is_unused else [*checks, self._check_target]:
            for found in check(package):
                yield found._replace(severity=Severity.WARNING) if is_unused else found

    def _check_form(self, package: Package) -> Iterator[Diagnostic]:
        for entry in package.setup_py.console_scripts:
            if len(entry.joined) > 1 and entry.text.count("=") > 1:
                at = entry.joined[0]
                message = "missing comma after this console script: it is joined to the next"
                yield self.report(at, message)
            elif entry.malformed:
                message = f"console script {entry.text!r}: {entry.malformed}"
                is_running = not entry.function and _runs_when_imported(package, entry.module)
                severity = Severity.WARNING if is_running else Severity.ERROR
                cause = f"console scripts: {entry.malformed}"
                yield self.report(entry, message, severity=severity, cause=cause)

    def _check_configured(self, package: Package) -> Iterator[Diagnostic]:
        """Check the console scripts of setup.cfg whose module lies in the package."""
        if not installs_configured(package):
            return
        for script in configured_scripts(package):
            if not package.has(f"{script.module.partition('.')[0]}/__init__.py"):
                continue
            if problem := self._problem_of_target(package, script):
                message = f"`ros2 run` of {script.name!r} fails: {problem}"
                yield self.report(script, message, cause=_MISSING if _MISSING in problem else "")

    def _check_names(self, package: Package) -> Iterator[Diagnostic]:
        seen: dict[str, EntryPoint] = {}
        for entry in package.setup_py.console_scripts:
            first = seen.setdefault(entry.name, entry)
            if first is not entry and entry.name:
                message = (
                    f"{entry.name!r} is also the name of another entry point: only one is installed"
                )
                yield self.report(entry, message)

    def _check_target(self, package: Package) -> Iterator[Diagnostic]:
        for entry in package.setup_py.console_scripts:
            if entry.malformed or not entry.module or not entry.function:
                continue
            problem = self._problem(package, entry)
            if problem:
                message = f"`ros2 run` of {entry.name!r} fails: {problem}"
                directory = moved_to(package, entry.module)
                root = entry.module.partition(".")[0]
                is_module = package.has_directory(root)
                cause = (
                    (_MISSING if _MISSING in problem else "") if is_module else f"directory {root}"
                )
                if f" has no {entry.function!r}" in problem:
                    cause = f"modules without {entry.function}"
                cause = f"moved to {directory}" if directory else cause
                stays = " has no " in problem and _runs_when_imported(
                    package, entry.module, calls_own=False
                )
                if stays:
                    message = f"`ros2 run` of {entry.name!r} fails when the module ends: {problem}"
                severity = Severity.WARNING if stays else Severity.ERROR
                yield self.report(entry, message, severity=severity, cause=cause)

    def _problem(self, package: Package, entry: EntryPoint) -> str | None:
        root, *_ = entry.module.split(".")
        if not package.has_directory(root):
            return self._missing_package(package, entry.module)
        return self._problem_of_target(package, entry)

    def _problem_of_target(
        self, package: Package, entry: EntryPoint | ConfiguredScript
    ) -> str | None:
        base = entry.module.replace(".", "/")
        path = next((p for p in (f"{base}.py", f"{base}/__init__.py") if package.has(p)), None)
        if path is None:
            modules = {
                path.rpartition("/")[2].removesuffix(".py"): path
                for path in reversed(package.python_files)
                if not path.endswith("__.py")
            }
            closest = get_close_matches(base.rpartition("/")[2], modules, 1, _SIMILAR)
            hint = f"; did you mean {modules[closest[0]]}?" if closest else ""
            return f"{_MISSING} {base}.py{hint}"
        try:
            exports = exports_of(package, path)
        except ViewError:
            return None
        function = entry.function.partition(".")[0]
        if function in exports.coroutines:
            return f"{path} has an async {function}(), which is never awaited; use asyncio.run()"
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
            return None  # `_check_use` reports the module
        if where is not None or package.has(f"{root}.py") or root not in {package.name, *own}:
            closest = get_close_matches(root, own, n=1)
            if where is None and closest and not package.has(f"{root}.py"):
                return f"the package has no module {root!r}; did you mean {closest[0]}?"
            return None
        return None if is_elsewhere(package, module) else f"directory {root}/ does not exist"

    def _check_use(self, package: Package) -> Iterator[Diagnostic]:
        setup = package.setup_py
        if setup.keyword("package_dir") is not None or setup.keyword("py_modules") is not None:
            return
        for entry in setup.console_scripts:
            if entry.malformed or not entry.function:
                continue
            path = file_of(package, entry.module)
            if path:
                yield from self._check_function(package, entry, path)
                continue
            closest = _closest_module(package, entry.module)
            if closest:
                message = f"no module {entry.module!r} is installed; did you mean {closest!r}?"
                is_shortened = closest.endswith(f".{entry.module}")
                cause = "console scripts without their package" if is_shortened else ""
                yield self.report(entry, message, cause=cause)

    def _check_function(
        self, package: Package, entry: EntryPoint, path: str
    ) -> Iterator[Diagnostic]:
        try:
            at, required, is_node_class = _function(package, path, str(entry.function))
        except ViewError:
            return
        if required:
            message = (
                f"the entry point {entry.name!r} of setup.py calls {entry.function}() without "
                f"arguments: TypeError; give {required} a default"
            )
            yield self.report(at, message)
        if is_node_class:
            message = (
                f"{entry.function} is a node class: nothing spins it; write a function that does"
            )
            yield self.report(entry, message)


@fact
def _function(package: Package, path: str, name: str) -> tuple[Location, str, bool]:
    """Return the place of a function, a required parameter, and whether it is a node class.

    Raises ViewError.
    """
    function = package.module(path).functions.get(name)
    if function is None or function.node.decorator_list:
        classes = rclpy_file(package, path).classes
        return package.start_of(path), "", any(node.name == name for node in classes)
    arguments = function.node.args
    positional = [*arguments.posonlyargs, *arguments.args]
    count = len(positional) - len(arguments.defaults)
    return function.location, positional[0].arg if count else "", False


def _closest_module(package: Package, name: str) -> str:
    """Return the module of the package that a name without a package refers to."""
    first, _, rest = name.partition(".")
    if package.has_directory(first):
        return ""
    for root in package.glob("*/__init__.py"):
        own = root.partition("/")[0]
        for item in (f"{own}.{name}", f"{own}.{rest}" if rest else ""):
            if item and file_of(package, item):
                return item
    return ""


def _runs_when_imported(package: Package, name: str, *, calls_own: bool = True) -> bool:
    """Return whether a module loops, spins, serves or calls a function of its own on import."""
    path = f"{name.replace('.', '/')}.py"
    if not name or not package.has(path):
        return False
    module = package.module(path)
    for statement in module.tree.body:
        match statement:
            case ast.While() | ast.Expr(value=ast.Call(func=ast.Attribute(attr="serve_forever"))):
                return True
            case ast.Expr(value=ast.Call(func=ast.Name(id=function))):
                if calls_own and function in module.functions:
                    return True
            case ast.Expr(value=ast.Call(func=called)):
                if (module.qualified_name(called) or "").startswith("rclpy.spin"):
                    return True
    return False
