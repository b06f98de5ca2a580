"""SP011: files that setup.py names or opens exist."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from fnmatch import fnmatchcase

from scaffold.api import Diagnostic, Effect, Example, Location, Package, Rule
from scaffold.api.python import Glob, PythonModule
from scaffold.api.setup_py import matches

_SETUP = (
    "from glob import glob\n\nfrom setuptools import setup\n\n"
    "setup(\n    name='talker',\n    data_files=[\n{}    ],\n)\n"
)
_SETUP_COLLECTED = (
    "import os\nfrom pathlib import Path\n\nfrom setuptools import setup\n\nNAME = 'talker'\n\n\n"
    "def tree(top):\n    found = {}\n"
    "    for root, _, names in os.walk(top):\n        for name in names:\n"
    "            found.setdefault(f'share/{NAME}/{root}', []).append(os.path.join(root, name))\n"
    "    return list(found.items())\n\n\n"
    "def share(*directories):\n"
    "    files = [(f'share/{NAME}', ['LICENSE'])]\n    for directory in directories:\n"
    "        if os.path.isdir(directory):\n"
    "            names = [f'{directory}/{name}' for name in os.listdir(directory)]\n"
    "            files.append((f'share/{NAME}/{directory}', names))\n    return files\n\n\n"
    "data_files = [(f'share/{NAME}', ['package.xml'])]\n"
    "data_files.extend(share('launch', 'worlds'))\n"
    "for path in Path('maps').rglob('*.pgm'):\n"
    "    data_files.append((f'share/{NAME}/{path.parent}', [str(path)]))\n"
    "data_files += tree('maps')\n\nsetup(name=NAME, data_files=data_files)\n"
)
_CAUSE = "data_files"
"""Files were renamed or moved, and setup.py was not."""
_SETUP_READ = "from setuptools import setup\n\nsetup(\n    name='talker',\n    {},\n)\n"
_READ = "long_description=open('README.md').read()"


class SetupFileMissing(Rule):
    """setup.py opens or names a file that does not exist, or a pattern that matches no file.

    **Why.** A missing file stops the build: ``FileNotFoundError: [Errno 2] No such file or
    directory``. A pattern in ``data_files`` that matches no file is not an error, but the files are
    missing at run time.

    **Fix.** Correct the name or the extension, or remove the entry.

    **Source.** setuptools documentation, ``data_files``, ``scripts``; ROS 2 documentation,
    "Integrating launch files into ROS 2 packages".
    """

    code = "SP011"
    name = "setup-file-missing"
    effect = Effect.STOPS_BUILD
    examples = (
        Example(
            "data files; an empty directory may have no files yet",
            {
                "setup.py": _SETUP.format(
                    "        ('share/talker', ['package.xml']),\n"
                    "        ('share/talker/maps', glob('maps/*')),\n"
                ),
                "package.xml": "<package/>\n",
            },
        ),
        Example(
            "all files are in subdirectories, which have separate entries",
            {
                "setup.py": _SETUP.format(
                    "        ('share/talker', ['package.xml']),\n"
                    "        ('share/talker/config', glob('config/*.yaml')),\n"
                    "        ('share/talker/config/arm', glob('config/arm/*.yaml')),\n"
                ),
                "package.xml": "<package/>\n",
                "config/arm/arm.yaml": "",
            },
        ),
        Example(
            "a directory in a list of files",
            {
                "setup.py": _SETUP.format(
                    "        ('share/talker', ['package.xml']),\n"
                    "        ('share/talker/config', glob('config/*')),\n"
                    "        ('share/talker/maps', glob('maps/*.yaml')),\n"
                ),
                "package.xml": "<package/>\n",
                "config/arm/arm.yaml": "",
                "config/base.yaml": "",
                "maps/small/map.yaml": "",
                "maps/map.yaml": "",
            },
            "setup.py:9:33: the pattern config/* matches the directory config/arm, which cannot "
            "be copied: the build stops; add a separate entry for it",
        ),
        Example(
            "a missing file, and files with another extension",
            {
                "setup.py": _SETUP.format(
                    "        ('share/talker', ['package.xml', 'LICENCE']),\n"
                    "        ('share/talker/launch', glob('launch/*_launch.py')),\n"
                ),
                "package.xml": "<package/>\n",
                "launch/talk.launch.py": "",
            },
            "setup.py:8:42: data_files names LICENCE, which is missing",
            "setup.py:9:33: the pattern launch/*_launch.py matches no file; did you mean "
            "launch/talk.launch.py?",
        ),
        Example(
            "files that functions and loops collect",
            {
                "setup.py": _SETUP_COLLECTED,
                "package.xml": "<package/>\n",
                "maps/hall/map.yaml": "",
                "maps/hall/map.pgm": "",
                "maps/README.md": "",
                "launch/talk.launch.py": "",
                "LICENSE": "",
            },
        ),
        Example(
            "a function that names a missing file, and a loop over names without their directory",
            {
                "setup.py": _SETUP_COLLECTED.replace("'LICENSE'", "'LICENCE'").replace(
                    "[f'{directory}/{name}' for", "[name for"
                ),
                "package.xml": "<package/>\n",
                "maps/hall/map.yaml": "",
                "launch/talk.launch.py": "",
                "LICENSE": "",
            },
            "setup.py:18:14: data_files names LICENCE, which is missing",
            "setup.py:22:26: data_files names talk.launch.py, which is missing; did you mean "
            "launch/talk.launch.py?",
        ),
        Example(
            "a file that is read",
            {"setup.py": _SETUP_READ.format(_READ), "README.md": "# talker\n"},
        ),
        Example(
            "opened only if it exists",
            {
                "setup.py": _SETUP_READ.format(
                    f"{_READ} if __import__('os').path.exists('README.md') else ''"
                )
            },
        ),
        Example(
            "a missing file that is opened",
            {"setup.py": _SETUP_READ.format(_READ)},
            "5:27: setup.py opens README.md, which does not exist: the build stops",
        ),
        Example(
            "missing files next to setup.py",
            {
                "setup.py": "import os\nfrom pathlib import Path\n\n"
                "from setuptools import setup\n\nHERE = os.path.dirname(__file__)\n"
                "setup(\n    name='talker',\n"
                "    description=(Path(__file__).parent / 'ABOUT').read_text(),\n"
                "    long_description=open(os.path.join(HERE, 'README.md')).read(),\n"
                "    license=Path('LICENSE').read_text(),\n"
                "    keywords=open(os.path.join('/etc', 'words')).read(),\n)\n",
                "LICENSE": "",
            },
            "setup.py:9:18: setup.py opens ABOUT, which does not exist: the build stops",
            "setup.py:10:27: setup.py opens README.md, which does not exist: the build stops",
        ),
        Example(
            "names of files without their directory, and a directory itself",
            {
                "setup.py": _SETUP.format(
                    "        ('share/talker', ['package.xml']),\n"
                    "        ('share/talker/launch', os.listdir('launch')),\n"
                    "        ('share/talker/maps', glob('maps/**', recursive=True)),\n"
                ).replace("from glob", "import os\nfrom glob"),
                "package.xml": "<package/>\n",
                "launch/talk.launch.py": "",
                "maps/map.yaml": "",
            },
            "setup.py:10:33: data_files names talk.launch.py, which is missing; did you mean "
            "launch/talk.launch.py?",
            "setup.py:11:31: the pattern maps/** matches the directory maps/ itself, which cannot "
            "be copied: the build stops; write maps/*",
        ),
        Example(
            "a missing script",
            {"setup.py": _SETUP_READ.format("scripts=['scripts/talk']")},
            "5:13: scripts names scripts/talk, which does not exist: the build stops",
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        yield from self._check_data(package)
        yield from self._check_read(package)

    def _check_data(self, package: Package) -> Iterator[Diagnostic]:
        marker = f"resource/{package.name}"
        reported: set[Location] = set()
        for data in package.setup_py.data_files:
            if data.conditional:
                continue
            for source, at in zip(data.sources, data.source_locations, strict=True):
                if at in reported:
                    continue
                if isinstance(source, Glob):
                    if message := self._nothing_matches(package, source):
                        spoiled = Effect.SPOILS_INSTALL
                        yield self.report(at, message, cause=_CAUSE, effect=spoiled)
                    elif message := _directory_in(package, source):
                        yield self.report(at, message, cause=_CAUSE)
                elif isinstance(source, str) and source != marker:
                    path = source.removeprefix("./")
                    if "resource/" in path or package.has(path) or path.startswith(("/", "../")):
                        continue
                    problem = "a directory" if package.has_directory(path) else "missing"
                    files = [file for file in package.files if file.endswith(f"/{path}")]
                    hint = f"; did you mean {files[0]}?" if len(files) == 1 else ""
                    message = f"data_files names {source}, which is {problem}{hint}"
                    reported.add(at)
                    yield self.report(at, message, cause=_CAUSE)

    def _nothing_matches(self, package: Package, pattern: Glob) -> str | None:
        directory, _, name = pattern.pattern.rpartition("/")
        beside = [
            path
            for path in package.files
            if path.startswith(f"{directory}/") and path.endswith((".py", ".yaml", ".xml"))
            if not path.endswith("__init__.py")
        ]
        if not directory or "*" in directory or not beside or pattern.filtered:
            return None
        if matches(pattern, package.files):
            return None
        ending = name.replace("*", "")
        if not any(ending[-3:] == path[-3:] for path in beside):
            return None
        sources = [source for data in package.setup_py.data_files for source in data.sources]
        globs = [source for source in sources if isinstance(source, Glob)]
        if {path for glob in globs for path in matches(glob, package.files)}.issuperset(beside):
            return None  # installed by other lines
        return f"the pattern {pattern.pattern} matches no file; did you mean {beside[0]}?"

    def _check_read(self, package: Package) -> Iterator[Diagnostic]:
        setup = package.setup_py
        module = setup.module
        for call in module.walk(ast.Call):
            path = _opened(module, call)
            modes = [arg.value for arg in call.args[1:] if isinstance(arg, ast.Constant)]
            name = None if path is None else _beside_setup(module, path)
            is_optional = any(
                isinstance(parent, ast.Try | ast.If | ast.IfExp) for parent in module.parents(call)
            )
            if path is None or name is None or is_optional or "w" in "".join(map(str, modes)):
                continue
            if not _exists(package, name):
                message = f"setup.py opens {name}, which does not exist: the build stops"
                yield self.report(module.location(path), message)
        scripts = setup.keyword("scripts")
        for name in scripts.value if scripts and isinstance(scripts.value, list) else ():
            if isinstance(name, str) and scripts and not _exists(package, name):
                message = f"scripts names {name}, which does not exist: the build stops"
                yield self.report(scripts, message)


def _opened(module: PythonModule, call: ast.Call) -> ast.expr | None:
    """Return the path that a call reads."""
    if module.qualified_name(call.func) in {"open", "io.open", "codecs.open"}:
        return call.args[0] if call.args else None
    if isinstance(call.func, ast.Attribute) and call.func.attr in {"read_text", "read_bytes"}:
        return call.func.value
    return None


def _beside_setup(module: PythonModule, path: ast.expr) -> str | None:
    """Return the path of a file next to setup.py, as far as it is written there."""
    match path:
        case ast.Constant(value=str(name)):
            return name
        case ast.Call(args=[ast.Constant(value=str(name))]) if (
            module.qualified_name(path.func) == "pathlib.Path"
        ):
            return name
        case ast.Call(args=[here, ast.Constant(value=str(name))]) if (
            module.qualified_name(path.func) == "os.path.join"
        ):
            return name if _is_here(module, here) else None
        case ast.BinOp(left=here, op=ast.Div(), right=ast.Constant(value=str(name))):
            return name if _is_here(module, here) else None
        case _:
            return None


_HERE = frozenset(
    {
        "os.path.dirname(__file__)",
        "os.path.dirname(os.path.abspath(__file__))",
        "os.path.abspath(os.path.dirname(__file__))",
        "os.path.dirname(os.path.realpath(__file__))",
        "Path(__file__).parent",
        "Path(__file__).resolve().parent",
        "pathlib.Path(__file__).parent",
        "pathlib.Path(__file__).parent.resolve()",
        "pathlib.Path(__file__).resolve().parent",
    }
)
"""The usual expressions for the directory of setup.py."""


def _is_here(module: PythonModule, node: ast.expr) -> bool:
    """Return whether an expression is the directory of setup.py."""
    value = module.index.only_value(node) or node
    return ast.unparse(value) in _HERE


def _directory_in(package: Package, pattern: Glob) -> str | None:
    """Return the message for a directory that a pattern matches in addition to files."""
    directory, _, name = pattern.pattern.rpartition("/")
    if "*" in directory or pattern.filtered or not directory:
        return None
    if name == "**" and pattern.recursive:
        return (
            f"the pattern {pattern.pattern} matches the directory {directory}/ itself, which "
            f"cannot be copied: the build stops; write {directory}/*"
        )
    if "**" in name:
        return None
    start = f"{directory.removeprefix('./')}/"
    inside = [path[len(start) :] for path in package.files if path.startswith(start)]
    folders = sorted({path.partition("/")[0] for path in inside if "/" in path})
    for folder in folders:
        if fnmatchcase(folder, name):
            return (
                f"the pattern {pattern.pattern} matches the directory {start}{folder}, which "
                f"cannot be copied: the build stops; add a separate entry for it"
            )
    return None


def _exists(package: Package, name: str) -> bool:
    return name.startswith(("/", "..")) or package.has(name.removeprefix("./"))
