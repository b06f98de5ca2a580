"""CM014: installed scripts have the executable bit and a shebang."""

from __future__ import annotations

import ast
from collections.abc import Collection, Iterator, Sequence

from scaffold.api import (
    Diagnostic,
    Edit,
    Effect,
    Example,
    Fix,
    MakeExecutable,
    Package,
    Report,
    Rule,
    Safety,
    ViewError,
)
from scaffold.api.cmake import Install, Program, programs, runs_with_python
from scaffold.api.install import paths_imported_by

_LISTS = "project(talker)\ninstall(PROGRAMS talker/node.py DESTINATION lib/${PROJECT_NAME})\n"
_LISTS_GLOB = (
    "project(talker)\nfile(GLOB scripts talker/*.py)\n"
    "install(PROGRAMS ${scripts} DESTINATION lib/${PROJECT_NAME})\n"
)
_NODE = "#!/usr/bin/env python3\n"
_CAUSE = "not executable"
_COPIED = ("RENAME", "PERMISSIONS", "CONFIGURATIONS", "COMPONENT")
"""Keywords with which CMake installs a copy and sets the executable bit."""
_NODE_KIND = (
    "#!/usr/bin/env python3\nimport rclpy\n\nif __name__ == '__main__':\n    rclpy.init()\n"
)
_LISTS_KIND = (
    "project(talker)\ninstall({} talker/node.py DESTINATION lib/${{PROJECT_NAME}})\n"
    "ament_package()\n"
)
SHEBANG = "#!/usr/bin/env python3"
ENV_WORDS = 2
"""``/usr/bin/env python3``."""


class ScriptNotExecutable(Rule):
    """An installed script is not executable, is installed with FILES, or has no valid shebang.

    **Why.** Only ``PROGRAMS`` sets the executable bit, and ``colcon build --symlink-install`` links
    to the file in the source tree: ``No executable found``, or ``Permission denied``. Without a
    shebang, ``ros2 run`` fails with ``Exec format error``. Ubuntu has no ``python``, only
    ``python3``. The kernel does not recognize a shebang after a byte order mark or a blank line.

    **Fix.** Use ``chmod +x``, ``install(PROGRAMS ...)``, and ``#!/usr/bin/env python3`` as the
    first line.

    **Source.** ``ros2pkg.api.get_executable_paths`` requires the bit; CMake documentation,
    ``install``; PEP 394; ``execve(2)``; ``ros2run`` executes the file itself; pyrobosim issue 182.
    """

    code = "CM014"
    name = "script-not-executable"
    examples = (
        Example(
            "executable",
            {"CMakeLists.txt": _LISTS, "talker/node.py": _NODE},
            executable=("talker/node.py",),
        ),
        Example(
            "a module that other scripts import",
            {"CMakeLists.txt": _LISTS, "talker/node.py": "def rate():\n    return 2.0\n"},
        ),
        Example(
            "a module without main() that an installed script imports",
            {
                "CMakeLists.txt": _LISTS.replace(".py", ".py talker/words.py"),
                "talker/node.py": f"{_NODE}from words import *\n",
                "talker/words.py": "SIZE = 2\nassert SIZE == 2\n",
            },
            executable=("talker/node.py",),
        ),
        Example(
            "a module that adds methods to a class in a loop",
            {
                "CMakeLists.txt": _LISTS,
                "talker/node.py": f"{_NODE}\n\nclass Talker:\n    pass\n\n\n"
                "for name in ('start', 'stop'):\n    setattr(Talker, name, print)\n",
            },
        ),
        Example(
            "installed by CMake itself under another name, which sets the bit",
            {
                "CMakeLists.txt": _LISTS.replace("DESTINATION", "RENAME node DESTINATION"),
                "talker/node.py": _NODE,
            },
        ),
        Example(
            "modules that a pattern matches besides the nodes",
            {
                "CMakeLists.txt": _LISTS_GLOB,
                "talker/words.py": "WORDS = ['hello']\n",
                "talker/plot.py": "import os\n\nif __name__ == '__main__':\n    os.getcwd()\n",
            },
        ),
        Example(
            "a node that a pattern matches",
            {"CMakeLists.txt": _LISTS_GLOB, "talker/talk.py": _NODE_KIND},
            Report(
                "talker/talk.py:1:1",
                "installed script is not executable: after `colcon build "
                "--symlink-install`, `ros2 run` finds no executable",
                fix="Make talker/talk.py executable",
            ),
            fixed={"talker/talk.py": _NODE_KIND},
        ),
        Example(
            "not executable",
            {"CMakeLists.txt": _LISTS, "talker/node.py": _NODE},
            Report(
                "talker/node.py:1:1",
                "installed script is not executable: after `colcon build "
                "--symlink-install`, `ros2 run` finds no executable",
                fix="Make talker/node.py executable",
            ),
            fixed={"talker/node.py": _NODE},
        ),
        Example(
            "installed with PROGRAMS",
            {"CMakeLists.txt": _LISTS_KIND.format("PROGRAMS"), "talker/node.py": _NODE_KIND},
            executable=("talker/node.py",),
        ),
        Example(
            "not installed with PROGRAMS, but run by CMake itself",
            {
                "CMakeLists.txt": _LISTS_KIND.format("FILES"),
                "cmake/generate.cmake": "set(SCRIPT ${talker_DIR}/../../../lib/talker/node.py)\n",
                "talker/node.py": _NODE_KIND,
            },
            executable=("talker/node.py",),
        ),
        Example(
            "a module with a demo, next to the script that imports it",
            {
                "CMakeLists.txt": _LISTS_KIND.format("FILES").replace(
                    "ament_p", "install(PROGRAMS talker/run.py DESTINATION lib/talker)\nament_p"
                ),
                "talker/node.py": _NODE_KIND,
                "talker/run.py": "#!/usr/bin/env python3\nfrom node import Node\n\nNode()\n",
            },
            executable=("talker/node.py", "talker/run.py"),
        ),
        Example(
            "installed as a file",
            {"CMakeLists.txt": _LISTS_KIND.format("FILES"), "talker/node.py": _NODE_KIND},
            Report(
                "CMakeLists.txt:2:15",
                "install(FILES) drops the executable bit of talker/node.py: `ros2 run` "
                "finds no executable; install it with PROGRAMS",
                fix="Replace FILES with PROGRAMS",
            ),
            fixed={"CMakeLists.txt": _LISTS_KIND.format("PROGRAMS")},
            executable=("talker/node.py",),
        ),
        Example(
            "installed with its directory",
            {
                "CMakeLists.txt": _LISTS_KIND.format("DIRECTORY").replace("/node.py", ""),
                "talker/node.py": _NODE_KIND,
            },
            "CMakeLists.txt:2:19: install(DIRECTORY) drops the executable bit of talker/node.py: "
            "`ros2 run` finds no executable; install it with PROGRAMS",
            executable=("talker/node.py",),
        ),
        Example(
            "with a shebang",
            {"CMakeLists.txt": _LISTS, "talker/node.py": f"{SHEBANG}\nimport rclpy\n"},
            executable=("talker/node.py",),
        ),
        Example(
            "a generator that CMake runs with Python",
            {
                "CMakeLists.txt": _LISTS,
                "cmake/talker-extras.cmake": "execute_process(\n"
                "  COMMAND ${Python3_EXECUTABLE} ${talker_DIR}/node.py)\n",
                "talker/node.py": "import rclpy\n",
            },
            executable=("talker/node.py",),
        ),
        Example(
            "a module with a demo, installed with the script that imports it",
            {
                "CMakeLists.txt": _LISTS.replace("node.py", "node.py talker/run.py"),
                "talker/node.py": "RATE = 2\n\nif __name__ == '__main__':\n    print(RATE)\n",
                "talker/run.py": f"{SHEBANG}\nfrom node import RATE\n\nprint(RATE)\n",
            },
            executable=("talker/node.py", "talker/run.py"),
        ),
        Example(
            "without a shebang",
            {"CMakeLists.txt": _LISTS, "talker/node.py": "import rclpy\n"},
            Report(
                "talker/node.py:1:1",
                "installed script has no shebang: `ros2 run` fails with 'Exec format "
                "error'; start with #!/usr/bin/env python3",
                fix="Start with #!/usr/bin/env python3",
            ),
            fixed={"talker/node.py": f"{SHEBANG}\nimport rclpy\n"},
            executable=("talker/node.py",),
        ),
        Example(
            "Python 2",
            {"CMakeLists.txt": _LISTS, "talker/node.py": "#!/usr/bin/env python\nimport rclpy\n"},
            Report(
                "talker/node.py:1:1",
                "'#!/usr/bin/env python' does not exist on Ubuntu, or is Python 2; "
                "write #!/usr/bin/env python3",
                fix="Start with #!/usr/bin/env python3",
            ),
            fixed={"talker/node.py": f"{SHEBANG}\nimport rclpy\n"},
            executable=("talker/node.py",),
        ),
        Example(
            "after a byte order mark",
            {"CMakeLists.txt": _LISTS, "talker/node.py": f"\ufeff{SHEBANG}\nimport rclpy\n"},
            Report(
                "talker/node.py:1:1",
                "a byte order mark comes before the shebang: the kernel does not recognize it",
                fix="Start with #!/usr/bin/env python3",
            ),
            fixed={"talker/node.py": f"{SHEBANG}\nimport rclpy\n"},
            executable=("talker/node.py",),
        ),
        Example(
            "CRLF line endings",
            {"CMakeLists.txt": _LISTS, "talker/node.py": f"{SHEBANG}\r\nimport rclpy\r\n"},
            "talker/node.py:1:1: CRLF line ending: the kernel searches for 'python3\\r'; save "
            "the file with LF line endings",
            executable=("talker/node.py",),
        ),
        Example(
            "the Python of the author's machine",
            {"CMakeLists.txt": _LISTS, "talker/node.py": "#!/opt/bin/python3\nimport rclpy\n"},
            Report(
                "talker/node.py:1:1",
                "'#!/opt/bin/python3' does not exist on other machines; write "
                "#!/usr/bin/env python3",
                fix="Start with #!/usr/bin/env python3",
            ),
            fixed={"talker/node.py": f"{SHEBANG}\nimport rclpy\n"},
            executable=("talker/node.py",),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        scripts = _scripts(package)
        yield from self._check_bit(package, scripts)
        yield from self._check_kind(package)
        yield from self._check_shebang(package, {script.path for script in scripts})

    def _check_bit(self, package: Package, scripts: Sequence[Program]) -> Iterator[Diagnostic]:
        cmake = package.cmake
        wanted = f"lib/{cmake.project_name}"
        reported: set[str] = set()
        imported = _imported(package)
        for program in scripts:
            path = program.path
            if path in reported or program.destination != wanted or not package.has(path):
                continue
            if any(program.command.has(keyword) for keyword in _COPIED):
                continue
            reported.add(path)
            if (
                package.is_executable(path)
                or not path.endswith(".py")
                or path.endswith("__init__.py")
                or _is_only_imported(package, path)
                or (f"/{path}".endswith(imported) and not _has_main(package, path))
            ):
                continue
            message = (
                "installed script is not executable: after `colcon build "
                "--symlink-install`, `ros2 run` finds no executable"
            )
            fix = Fix(f"Make {path} executable", (MakeExecutable(path),))
            at = package.start_of(path)
            yield self.report(at, message, fix, cause=_CAUSE, effect=Effect.DECLARED_WRONG)

    def _check_kind(self, package: Package) -> Iterator[Diagnostic]:
        programs = {
            item.path
            for install in package.cmake.installs
            if install.kind == "PROGRAMS"
            for item in install.items
            if item.path
        }
        imported = tuple(f"/{path}" for path in paths_imported_by(package, programs))
        for install in package.cmake.installs:
            if not self._loses_bits(package, install):
                continue
            for item in install.items:
                path = self._script(package, item.path or "", install.kind)
                is_module = path in programs or f"/{path}".endswith(imported)
                if path and not is_module and not _is_run_by_cmake(package, path):
                    message = (
                        f"install({install.kind}) drops the executable bit of {path}: `ros2 run` "
                        "finds no executable; install it with PROGRAMS"
                    )
                    yield self.report(item, message, self._fix(install))

    def _loses_bits(self, package: Package, install: Install) -> bool:
        target = (install.destination or "").rstrip("/")
        keeps = {"PERMISSIONS", "FILE_PERMISSIONS", "USE_SOURCE_PERMISSIONS"}
        return (
            install.kind in {"FILES", "DIRECTORY"}
            and target == f"lib/{package.cmake.project_name}"
            and not keeps & set(install.command.values)
        )

    def _script(self, package: Package, path: str, kind: str) -> str:
        """Return the node at a path, or the first one in a directory."""
        paths = [path]
        if kind == "DIRECTORY":
            paths = [file for file in package.files if file.startswith(f"{path}/")]
        for item in paths:
            if item in package.python_files and not item.endswith("__init__.py"):
                module = package.module(item)
                if module.is_script and module.has_main_guard:
                    return item
        return ""

    def _fix(self, install: Install) -> Fix | None:
        if install.kind != "FILES" or len(install.items) != 1:
            return None
        for argument in install.command.arguments:
            if argument.raw == "FILES":
                edit = Edit(argument.path, argument.start, argument.end, "PROGRAMS")
                return Fix(f"Replace {install.kind} with PROGRAMS", (edit,), Safety.SAFE)
        return None

    def _check_shebang(self, package: Package, paths: Collection[str]) -> Iterator[Diagnostic]:
        imported = _imported(package)
        for path in sorted(paths):
            if not path.endswith(".py") or path.endswith("__init__.py") or not package.has(path):
                continue
            if _is_only_imported(package, path) or runs_with_python(package, path):
                continue
            if f"/{path}".endswith(imported) and "rclpy" not in package.imports(path):
                continue
            source = package.editable(path)
            line = source.lines[0]
            end = len(line)
            if line.startswith("\ufeff"):
                end = 1
                problem = (
                    "a byte order mark comes before the shebang: the kernel does not recognize it"
                )
            elif not line.startswith("#!"):
                end = 0
                problem = (
                    f"installed script has no shebang: `ros2 run` fails with "
                    f"'Exec format error'; start with {SHEBANG}"
                )
            elif line.rstrip().endswith(("/python", "/python2", "env python", "env python2")):
                problem = (
                    f"{line.strip()!r} does not exist on Ubuntu, or is Python 2; write {SHEBANG}"
                )
            elif source.text.partition("\n")[0].endswith("\r"):
                end = 0
                problem = (
                    "CRLF line ending: the kernel searches for 'python3\\r'; save the "
                    "file with LF line endings"
                )
            elif not _starts_python(line.strip()):
                problem = f"{line.strip()!r} does not exist on other machines; write {SHEBANG}"
            else:
                continue
            text = "" if end == 1 else SHEBANG if end else SHEBANG + source.newline
            fix = Fix(f"Start with {SHEBANG}", (Edit(path, 0, end, text),))
            is_crlf = problem.startswith("CRLF")
            at = package.start_of(path)
            yield self.report(at, problem, None if is_crlf else fix, cause=_CAUSE)


def _imported(package: Package) -> tuple[str, ...]:
    """Return the ends of the paths of modules that installed scripts import."""
    paths = {program.path for program in programs(package)}
    return tuple(f"/{path}" for path in paths_imported_by(package, paths))


def _has_main(package: Package, path: str) -> bool:
    """Return whether a file may be a script: it has ``main()`` or a main guard, or is broken."""
    try:
        module = package.module(path)
    except ViewError:
        return True
    return module.has_main_guard or "main" in module.functions


def _is_run_by_cmake(package: Package, path: str) -> bool:
    """Return whether a CMake file refers to an installed script in order to run it."""
    place = f"/{package.cmake.project_name}/{path.rpartition('/')[2]}"
    return any(
        place in package.source(file).text
        for file in package.files
        if file.endswith((".cmake", ".cmake.in"))
    )


def _starts_python(line: str) -> bool:
    """Return whether a shebang starts Python 3 on all systems with ROS 2."""
    words = line.removeprefix("#!").split()
    if words[:1] == ["/usr/bin/env"] and len(words) > 1:
        if words[1] == "-S":
            return len(words) > ENV_WORDS and words[2].startswith("python3")
        # The kernel passes everything after the first space as one argument.
        return words[1] in {"python3", "python3.12"} and len(words) == ENV_WORDS
    if words[:1] == ["/bin/env"]:
        return words[1:] == ["python3"]
    return words[:1] in (["/usr/bin/python3"], ["/usr/bin/python3.12"], ["/bin/python3"])


def _scripts(package: Package) -> list[Program]:
    """Return the programs that are installed by their names, or are nodes."""
    written = {value for command in package.cmake.commands for value in command.values}
    return [item for item in programs(package) if _is_meant(package, item.path, written)]


def _is_meant(package: Package, path: str, written: Collection[str]) -> bool:
    """Return whether a script is installed by its name, or is a node that a pattern matches."""
    stem = path.rpartition("/")[2].removesuffix(".py")
    if any(stem in value for value in written):
        return True
    try:
        return "rclpy" in package.imports(path) and package.module(path).has_main_guard
    except ViewError:
        return False


def _is_only_imported(package: Package, path: str) -> bool:
    """Return whether an installed Python file only has definitions for import."""
    try:
        module = package.module(path)
    except ViewError:
        return False
    if module.has_main_guard or "main" in module.functions:
        return False  # a main that nothing calls is for people to start
    if not module.functions and not module.classes:
        return False
    return all(_only_defines(statement) for statement in module.tree.body)


def _only_defines(statement: ast.stmt) -> bool:
    match statement:
        case ast.Expr(value=ast.Constant() | ast.Call(func=ast.Name(id="setattr"))):
            return True
        case ast.For(body=body, orelse=orelse) | ast.If(body=body, orelse=orelse):
            return all(map(_only_defines, [*body, *orelse]))
    return isinstance(
        statement,
        ast.Import
        | ast.ImportFrom
        | ast.FunctionDef
        | ast.AsyncFunctionDef
        | ast.ClassDef
        | ast.Assign
        | ast.AnnAssign,
    )
