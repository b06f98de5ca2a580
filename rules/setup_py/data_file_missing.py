"""SP011: what data_files name exists."""

from __future__ import annotations

from collections.abc import Iterator
from fnmatch import fnmatchcase

from scaffold.api import Diagnostic, Example, Package, Report, Rule
from scaffold.api.python import Glob
from scaffold.api.setup_py import matches

_SETUP = (
    "from glob import glob\n\nfrom setuptools import setup\n\n"
    "setup(\n    name='talker',\n    data_files=[\n{}    ],\n)\n"
)
_CAUSE = "data_files"
"""Files were renamed or moved, and setup.py was not."""


class DataFileMissing(Rule):
    """data_files name a file that does not exist, or a pattern that matches none of the files.

    **Why.** A missing file stops the build. A pattern that matches nothing is silent: the files
    next to it are not there at run time.

    **Fix.** Write the name, or the ending, that the files have.

    **Source.** setuptools documentation, ``data_files``; ROS 2 documentation, "Integrating launch
    files into ROS 2 packages".
    """

    code = "SP011"
    name = "data-file-missing"
    examples = (
        Example(
            "there; an empty directory may have no files yet",
            {
                "setup.py": _SETUP.format(
                    "        ('share/talker', ['package.xml']),\n"
                    "        ('share/talker/maps', glob('maps/*')),\n"
                ),
                "package.xml": "<package/>\n",
            },
        ),
        Example(
            "all files lie in directories below, which have lines of their own",
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
            "a directory among the files",
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
            Report(
                "setup.py:9:33",
                "the pattern config/* matches the directory config/arm, which "
                "cannot be copied: the build stops; give it a line of its own",
            ),
        ),
        Example(
            "no such file, and files with another ending",
            {
                "setup.py": _SETUP.format(
                    "        ('share/talker', ['package.xml', 'LICENCE']),\n"
                    "        ('share/talker/launch', glob('launch/*_launch.py')),\n"
                ),
                "package.xml": "<package/>\n",
                "launch/talk.launch.py": "",
            },
            Report("setup.py:8:42", "data_files names LICENCE, which is not there"),
            Report(
                "setup.py:9:33",
                "the pattern launch/*_launch.py matches no file; closest: launch/talk.launch.py",
            ),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        marker = f"resource/{package.name}"
        for data in package.setup_py.data_files:
            if data.conditional:
                continue
            for source, at in zip(data.sources, data.source_locations, strict=True):
                if isinstance(source, Glob):
                    message = self._nothing_matches(package, source) or _directory_in(
                        package, source
                    )
                    if message:
                        yield self.report(at, message, cause=_CAUSE)
                elif isinstance(source, str) and source != marker:
                    path = source.removeprefix("./")
                    if "resource/" in path or package.has(path) or path.startswith(("/", "../")):
                        continue
                    what = "a directory" if package.has_directory(path) else "not there"
                    message = f"data_files names {source}, which is {what}"
                    yield self.report(at, message, cause=_CAUSE)

    def _nothing_matches(self, package: Package, pattern: Glob) -> str | None:
        directory, _, name = pattern.pattern.rpartition("/")
        beside = [
            path
            for path in package.files
            if path.startswith(f"{directory}/") and path.endswith((".py", ".yaml", ".xml"))
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
            return None  # other lines install them
        return f"the pattern {pattern.pattern} matches no file; closest: {beside[0]}"


def _directory_in(package: Package, pattern: Glob) -> str | None:
    """Return the message for a directory that a pattern matches besides files."""
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
                "cannot be copied: the build stops; give it a line of its own"
            )
    return None
