"""SP011: files that setup.py names or opens exist."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from fnmatch import fnmatchcase

from scaffold.api import Diagnostic, Effect, Example, Package, Rule
from scaffold.api.python import Glob
from scaffold.api.setup_py import matches

_SETUP = (
    "from glob import glob\n\nfrom setuptools import setup\n\n"
    "setup(\n    name='talker',\n    data_files=[\n{}    ],\n)\n"
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
        for data in package.setup_py.data_files:
            if data.conditional:
                continue
            for source, at in zip(data.sources, data.source_locations, strict=True):
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
                    message = f"data_files names {source}, which is {problem}"
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


def _directory_in(package: Package, pattern: Glob) -> str | None:
    """Return the message for a directory that a pattern matches in addition to files."""
    directory, _, name = pattern.pattern.rpartition("/")
    if "*" in directory or "**" in name or pattern.filtered or not directory:
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
