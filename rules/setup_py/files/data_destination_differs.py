"""SP052: data_files are pairs, and are installed to the share directory."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator

from scaffold.api import Diagnostic, Effect, Example, Package, Report, Rule, Severity
from scaffold.api.distributions import target
from scaffold.api.launch import DATA_DIRECTORIES
from scaffold.api.python import Glob
from scaffold.api.setup_py import DataFile

_SETUP = (
    "from setuptools import setup\n\nsetup(\n    name='talker',\n    data_files=[\n"
    "        ({}, {}),\n    ],\n)\n"
)
_FILES = {
    "package.xml": "<package><name>talker</name><export>"
    "<build_type>ament_python</build_type></export></package>\n",
    "launch/talk.launch.py": "",
}
_GLOB = "['launch/talk.launch.py']"


class DataDestinationDiffers(Rule):
    """An entry of ``data_files`` is not a pair, or has a wrong destination.

    **Why.** Files outside of ``share/<package>`` are not found: ``file 'talk.launch.py' was not
    found in the share directory of package 'talker'``. An absolute path is outside of the
    workspace, or stops colcon. Modules are installed for the Python of the distribution: 3.12 for
    Jazzy, 3.10 for Humble.

    **Fix.** Write ``(os.path.join('share', package_name, 'launch'), glob('launch/*.launch.py'))``.

    **Source.** ROS 2 documentation, "Launch files"; ``colcon_core/task/python``; setuptools
    documentation, ``data_files``.
    """

    code = "SP052"
    name = "data-destination-differs"
    effect = Effect.SPOILS_INSTALL
    other_severities = {
        Severity.WARNING: "it is the directory of the distribution's Python, so only other "
        "distributions lose the file"
    }
    examples = (
        Example(
            "the package directory of another Python version",
            {
                **_FILES,
                "talker/words.ui": "",
                "setup.py": _SETUP.format(
                    "'lib/python3.10/site-packages/talker'", "['talker/words.ui']"
                ),
            },
            "setup.py:6:10: installs talker/words.ui to lib/python3.10/site-packages/talker, "
            "which only Python 3.10 searches; write package_data={...}",
        ),
        Example(
            "the package directory of the distribution's Python",
            {
                **_FILES,
                "talker/words.ui": "",
                "setup.py": _SETUP.format(
                    "'lib/python3.10/site-packages/talker'", "['talker/words.ui']"
                ),
            },
            Report(
                "setup.py:6:10",
                "installs talker/words.ui to lib/python3.10/site-packages/talker, "
                "which only Python 3.10 searches; write package_data={...}",
                severity=Severity.WARNING,
            ),
            distro="humble",
        ),
        Example(
            "the share directory",
            {**_FILES, "setup.py": _SETUP.format("'share/talker/launch'", _GLOB)},
        ),
        Example(
            "a second copy elsewhere",
            {
                **_FILES,
                "setup.py": _SETUP.format("'share/talker/launch'", _GLOB).replace(
                    "]),", f"]),\n        ('share/other', {_GLOB}),"
                ),
            },
        ),
        Example(
            "files found in each directory of a loop",
            {
                **_FILES,
                "robots/small/robot.yaml": "",
                "setup.py": "from glob import glob\nfrom os.path import join\n"
                "from setuptools import setup\n\nfiles = []\n"
                "for directory in glob('robots/*'):\n"
                "    entry = (join('share/talker', directory), glob(directory + '/*'))\n"
                "    files.append(entry)\n\nsetup(name='talker', data_files=files)\n",
            },
        ),
        Example(
            "a marker of the package in the ament index, and another file there",
            {
                **_FILES,
                "config/talker": "",
                "config/talker.yaml": "",
                "setup.py": _SETUP.format(
                    "'share/ament_index/resource_index/configuration'", "['config/talker']"
                ).replace(
                    "]),",
                    "]),\n        ('share/ament_index/resource_index/configuration', "
                    "['config/talker.yaml']),",
                ),
            },
            "setup.py:7:10: installs config/talker.yaml to "
            "share/ament_index/resource_index/configuration, but ROS 2 searches share/talker/",
        ),
        Example(
            "without the package",
            {**_FILES, "setup.py": _SETUP.format("'share/launch'", _GLOB)},
            "setup.py:6:10: installs launch/talk.launch.py to share/launch, but ROS 2 searches "
            "share/talker/",
        ),
        Example(
            "absolute",
            {**_FILES, "setup.py": _SETUP.format("'/share/talker/launch'", _GLOB)},
            "setup.py:6:10: installs to the absolute path /share/talker/launch, outside of the "
            "workspace; write share/talker/...",
        ),
        Example(
            "without a comma",
            {
                **_FILES,
                "setup.py": _SETUP.format("'share/talker'", "['package.xml']").replace(
                    "'share/talker', ", "'share/talker' "
                ),
            },
            "setup.py:6:10: a comma is missing before the files: the build stops",
        ),
        Example(
            "not a list",
            {**_FILES, "setup.py": _SETUP.format("'share/talker'", "'package.xml'")},
            "setup.py:6:9: the files are a string, not a list: the build stops",
        ),
        Example(
            "a missing comma",
            {
                **_FILES,
                "setup.py": _SETUP.format("'share/talker'", "['package.xml']").replace(
                    "]),", f"])\n        ('share/talker/launch', {_GLOB}),"
                ),
            },
            "setup.py:6:9: missing comma after this: 'tuple' object is not callable",
        ),
        Example(
            "files added to the entries, of which there are none",
            {
                **_FILES,
                "setup.py": "from glob import glob\n"
                + _SETUP.format("'share/talker/launch'", _GLOB).replace(
                    "    ],\n", "    ] + glob('share/talker/config/**'),\n"
                ),
            },
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        setup = package.setup_py
        if package.build_type != "ament_python" or not package.manifest.name:
            return
        if setup.name != package.name and setup.name is not None:
            return  # reported by SP008, or unknown
        share = f"share/{package.name}"
        copied = {
            source
            for data in setup.data_files
            if isinstance(data.destination, str) and f"{data.destination}/".startswith(f"{share}/")
            for source in data.sources
        }
        for data in setup.data_files:
            if data.malformed:
                yield self.report(data, f"{data.malformed}: the build stops")
            problem = _problem(data, share)
            is_copy = copied.issuperset(data.sources) and "absolute" not in problem
            if problem and not is_copy:
                python = _OF_PYTHON.match(f"{data.destination}")
                is_searched = python is not None and python[1] == target().python_version
                severity = Severity.WARNING if is_searched else None
                yield self.report(data.destination_location, problem, severity=severity)
        keyword = setup.keywords.get("data_files")
        for call in ast.walk(keyword.node) if keyword else ():
            if isinstance(call, ast.Call) and isinstance(call.func, ast.Tuple):
                message = "missing comma after this: 'tuple' object is not callable"
                yield self.report(setup.module.location(call.func), message)


def _problem(data: DataFile, share: str) -> str:
    place = data.destination
    if not isinstance(place, str):
        return ""
    if place.startswith("/"):
        return f"installs to the absolute path {place}, outside of the workspace; write {share}/..."
    sources = [
        source.pattern if isinstance(source, Glob) else str(source) for source in data.sources
    ]
    python = _OF_PYTHON.match(place)
    if sources and python is not None:
        return (
            f"installs {sources[0]} to {place.rstrip('/')}, which only Python {python[1]} "
            "searches; write package_data={...}"
        )
    is_data = bool(sources) and all(
        source == "package.xml" or source.startswith(tuple(f"{name}/" for name in _DIRECTORIES))
        for source in sources
    )
    is_marker = place.startswith(_INDEX) and all(
        source.rpartition("/")[2] == share.rpartition("/")[2] for source in sources
    )
    is_found = is_marker or f"{place}/".startswith(f"{share}/")
    if is_data and not is_found:
        return f"installs {sources[0]} to {place}, but ROS 2 searches {share}/"
    return ""


_INDEX = "share/ament_index/resource_index/"
"""The directory with markers of any type, named after packages."""
_DIRECTORIES = ("launch", *DATA_DIRECTORIES)
_OF_PYTHON = re.compile(r"lib/python(\d[\d.]*)/")
"""Matches the directory of one version of Python, with the version."""
