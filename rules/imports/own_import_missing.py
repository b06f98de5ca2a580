"""IM041: modules and names that a package imports from itself exist."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Rule, ViewError, closest_name
from scaffold.api.install import (
    absolute_name,
    file_of,
    intended_module,
    may_be_made,
    moved_to,
    own_roots,
    uninstalled_import,
)
from scaffold.api.python import Import, exports_of, imports_by_path

_SETUP = (
    "from setuptools import setup\n\nsetup(\n    name='talker',\n    packages=['talker'],\n"
    "    entry_points={'console_scripts': ['node = talker.node:main']},\n)\n"
)
_FILES = {"setup.py": _SETUP, "talker/__init__.py": "", "talker/text.py": "def make():\n    pass\n"}
_LISTS = (
    "project(talker)\nfind_package(ament_cmake REQUIRED)\n"
    "install(PROGRAMS {} DESTINATION lib/${{PROJECT_NAME}})\nament_package()\n"
)
_PROGRAM = {
    "package.xml": "<package><name>talker</name>"
    "<export><build_type>ament_cmake</build_type></export></package>\n",
    "scripts/node.py": "from text import make\n",
    "scripts/text.py": "def make():\n    pass\n",
}


class OwnImportMissing(Rule):
    """A module imports a module of its own package by a wrong name, or one that is not installed.

    **Why.** ``ModuleNotFoundError: No module named 'text'`` or ``ImportError: cannot import name``
    when the node is started: the Python package is on the path, but not its modules. A program that
    CMake installs also finds modules that are installed next to it, in ``lib/<package>``.

    **Fix.** Write the full name: ``from talker.text import make``. Install modules that executables
    share as a Python package, with ``ament_python_install_package``.

    **Source.** Python documentation, "The import system"; ROS 2 documentation, "Writing a simple
    publisher and subscriber (Python)".
    """

    code = "IM041"
    name = "own-import-missing"
    examples = (
        Example("full name", {**_FILES, "talker/node.py": "from talker.text import make\n"}),
        Example(
            "a test that expects the module to be missing",
            {
                **_FILES,
                "test/test_text.py": "import pytest\n\n\ndef test_nothing():\n"
                "    with pytest.raises(ImportError):\n        import talker.nothing\n",
            },
        ),
        Example(
            "a module that protoc generates",
            {
                **_FILES,
                "CMakeLists.txt": "add_custom_command(TARGET made COMMAND protoc team.proto)\n",
                "talker/node.py": "from talker.team_pb2 import Message\n",
            },
        ),
        Example(
            "a module that setup.py generates with protoc",
            {
                **_FILES,
                "setup.py": f"import os\n\nos.system('protoc team.proto')\n{_SETUP}",
                "talker/node.py": "from talker.team_pb2 import Message\n",
            },
        ),
        Example(
            "a module in C++, whose name CMake builds",
            {
                **_FILES,
                "CMakeLists.txt": "project(talker)\n"
                "add_library(_${PROJECT_NAME}_text MODULE a.cpp)\n",
                "talker/node.py": "import talker._talker_text\n",
            },
        ),
        Example(
            "a generated module that git ignores",
            {
                **_FILES,
                ".gitignore": "**/*_client\n",
                "talker/node.py": "from talker.text_client.types import Text\n",
            },
        ),
        Example(
            "a script that CMake installs into the Python package",
            {
                **_PROGRAM,
                "CMakeLists.txt": "project(talker)\nfind_package(ament_cmake REQUIRED)\n"
                "ament_python_install_package(${PROJECT_NAME})\n"
                "install(DIRECTORY scripts/ DESTINATION ${PYTHON_INSTALL_DIR}/talker)\n"
                "install(PROGRAMS scripts/node.py DESTINATION lib/${PROJECT_NAME})\n"
                "ament_package()\n",
                "scripts/node.py": "from talker.text import make\n",
                "talker/__init__.py": "",
            },
        ),
        Example(
            "a module that is installed next to the scripts",
            {
                **_FILES,
                "package.xml": "<package><name>talker</name>"
                "<export><build_type>ament_python</build_type></export></package>\n",
                "setup.py": _SETUP.replace(
                    "    entry", "    data_files=[('lib/talker', ['talker/text.py'])],\n    entry"
                ),
                "talker/node.py": "from text import make\n",
            },
        ),
        Example(
            "an unknown module",
            {**_FILES, "talker/node.py": "from talker.texts import make\n"},
            "talker/node.py:1:1: the package has no module 'talker.texts': ModuleNotFoundError; "
            "did you mean 'talker.text'?",
        ),
        Example(
            "an unknown module, and another one with the name of a directory",
            {
                **_FILES,
                "talker/text_makers/__init__.py": "",
                "talker/text_makers/fast.py": "",
                "talker/node.py": "from talker.text_maker_f import make\n",
            },
            "talker/node.py:1:1: the package has no module 'talker.text_maker_f': "
            "ModuleNotFoundError",
        ),
        Example(
            "modules moved to a subdirectory, which is reported once",
            {
                **_FILES,
                "talker/junk/__init__.py": "",
                "talker/junk/node.py": "from .text import make\n",
                "talker/junk/old.py": "",
                "talker/other.py": "from talker.old import run\n",
            },
            "talker/junk/node.py:1:1: the package has no module 'talker.junk.text': "
            "ModuleNotFoundError; did you mean 'talker.text'?",
            "talker/other.py:1:1: the package has no module 'talker.old': ModuleNotFoundError; "
            "did you mean 'talker.junk.old'?",
        ),
        Example(
            "a module whose package name is repeated",
            {
                **_FILES,
                "talker/node.py": "",
                "test/test_node.py": "def test_node():\n    from talker.talker.node import main\n",
            },
            "test/test_node.py:2:5: the package has no module 'talker.talker.node': "
            "ModuleNotFoundError; did you mean 'talker.node'?",
        ),
        Example(
            "an unknown function",
            {**_FILES, "talker/node.py": "from .text import makes\n"},
            "talker/node.py:1:19: talker/text.py has no 'makes': ImportError; did you mean 'make'?",
        ),
        Example(
            "without the package name, and with the directory",
            {
                **_FILES,
                "talker/node.py": "from text import make\nfrom src.talker.text import make\n",
            },
            "talker/node.py:1:1: no module 'text' is installed: ModuleNotFoundError; did you mean "
            "'talker.text'?",
            "talker/node.py:2:1: no module 'src.talker.text' is installed: ModuleNotFoundError; "
            "did you mean 'talker.text'?",
        ),
        Example(
            "a file that is installed next to the program",
            {**_PROGRAM, "CMakeLists.txt": _LISTS.format("scripts/node.py scripts/text.py")},
        ),
        Example(
            "a subpackage that is not installed",
            {
                **_PROGRAM,
                "CMakeLists.txt": _LISTS.format("scripts/node.py"),
                "scripts/node.py": "from scripts.text import make\n",
            },
            "scripts/node.py:1:1: scripts/text.py is not installed next to this script: "
            "ModuleNotFoundError",
        ),
        Example(
            "a file that is not installed next to the program",
            {**_PROGRAM, "CMakeLists.txt": _LISTS.format("scripts/node.py")},
            "scripts/node.py:1:1: scripts/text.py is not installed next to this script: "
            "ModuleNotFoundError",
        ),
        Example(
            "a name and interfaces that the Python package of an interface package lacks",
            {
                "package.xml": "<package><name>voice</name>"
                "<export><build_type>ament_cmake</build_type></export></package>\n",
                "CMakeLists.txt": "project(voice)\n"
                'rosidl_generate_interfaces(${PROJECT_NAME} "srv/Say.srv")\n'
                "ament_python_install_package(voice_nodes)\n",
                "srv/Say.srv": "string text\n---\n",
                "voice_nodes/__init__.py": "",
                "voice_nodes/speaker.py": "from voice.srv import Say\n\n\n"
                "def main():\n    return Say\n",
                "voice_nodes/listener.py": "from voice_nodes.srv import Say\n\nprint(Say)\n",
                "scripts/speaker.py": "from voice_nodes.speaker import main, run\n\n"
                "print(main, run)\n",
            },
            "scripts/speaker.py:1:39: voice_nodes/speaker.py has no 'run': ImportError",
            "voice_nodes/listener.py:1:1: the package has no module 'voice_nodes.srv': "
            "ModuleNotFoundError",
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        makers = ("rosidl_generate_interfaces", "generate_parameter_module")
        roots = own_roots(package)
        if package.has("CMakeLists.txt") and package.cmake.find(*makers):
            roots.discard(package.name)  # its modules are generated
            if not roots:
                return
        for where, imports in imports_by_path(package):
            for item in imports if where != "setup.py" else ():
                if not (item.guarded or item.conditional or item.type_checking):
                    yield from self._check(package, where, item, roots)

    def _check(
        self, package: Package, where: str, node: Import, roots: set[str]
    ) -> Iterator[Diagnostic]:
        name = absolute_name(where, node)
        root = name.partition(".")[0]
        path = file_of(package, name)
        missing = "" if node.level else uninstalled_import(package, where, name)
        if missing:
            message = f"{missing} is not installed next to this script: ModuleNotFoundError"
            yield self.report(node, message)
        elif root in roots and path:
            yield from self._check_names(package, node, name, path)
        elif root in roots:
            is_interface = name in {f"{root}.{kind}" for kind in ("msg", "srv", "action")}
            if is_interface or not may_be_made(package, name):
                closest = _closest_module(package, root, name)
                hint = f"; did you mean {closest!r}?" if closest else ""
                message = f"the package has no module {name!r}: ModuleNotFoundError{hint}"
                yield self.report(node, message, cause=_cause(package, where, node, name))
        elif not node.level:
            intended = intended_module(package, where, name)
            if intended:
                message = f"no module {name!r} is installed: ModuleNotFoundError"
                yield self.report(node, f"{message}; did you mean {intended!r}?")

    def _check_names(
        self, package: Package, node: Import, name: str, path: str
    ) -> Iterator[Diagnostic]:
        try:
            exports = exports_of(package, path)
        except ViewError:
            return
        for imported in node.names:
            if imported.name == "*" or exports.defines(imported.name) is not False:
                continue
            below = f"{name}.{imported.name}"
            is_package = path.endswith("__init__.py")
            if is_package and (file_of(package, below) or may_be_made(package, below)):
                continue
            closest = closest_name(
                package, imported.name, [*exports.functions, *exports.classes], 0.6
            )
            hint = f"; did you mean {closest!r}?" if closest else ""
            yield self.report(imported, f"{path} has no {imported.name!r}: ImportError{hint}")


def _cause(package: Package, where: str, node: Import, name: str) -> str:
    """Return the common cause of all findings if files were moved one directory down."""
    directory = moved_to(package, name)
    above, _, file = where.rpartition("/")
    above = above.rpartition("/")[0]
    if not directory and node.level and above:
        is_moved = file_of(package, absolute_name(f"{above}/{file}", node)) != ""
        directory = where.rpartition("/")[0] if is_moved else ""
    return f"moved to {directory}" if directory else ""


def _modules_of(package: Package, root: str) -> list[str]:
    """Return the names of the modules in a directory and below it."""
    return [
        path.removesuffix(".py").replace("/", ".")
        for path in package.python_files
        if path.startswith(f"{root}/") and path.endswith(".py")
    ]


def _closest_module(package: Package, root: str, name: str) -> str:
    """Return the module that a name is closest to: at another place, or with a similar name."""
    modules = [item for item in _modules_of(package, root) if "__init__" not in item]
    moved = [item for item in modules if item.rpartition(".")[2] == name.rpartition(".")[2]]
    if moved:
        return closest_name(package, name, moved, 0.0)
    short = name.removeprefix(f"{root}.")
    beside = [
        item.removeprefix(f"{root}.") for item in modules if item.count(".") == name.count(".")
    ]
    closest = closest_name(package, short, beside, 0.8)
    return f"{root}.{closest}" if closest else ""
