"""PX084: the packages of a workspace have different names."""

from __future__ import annotations

import os
from collections.abc import Iterator
from itertools import takewhile

from scaffold.api import Diagnostic, Effect, Example, Package, Rule
from scaffold.api.workspace import is_ignored

_MANIFEST = (
    '<package format="3">\n  <name>talker</name>\n  <export>\n'
    "    <build_type>ament_python</build_type>\n  </export>\n</package>\n"
)
_SOURCES = "src"
"""The directory of a workspace with its packages."""


class PackageNameRepeated(Rule):
    """Two packages of a workspace have the same name.

    Only packages in one directory, or below one directory ``src``, are compared: a repository may
    hold several workspaces.

    **Why.** colcon stops: ``Duplicate package names not supported``.

    **Fix.** Rename the copy in package.xml, setup.py or CMakeLists.txt, or put an empty file
    ``COLCON_IGNORE`` into its directory.

    **Source.** colcon documentation, "Discovery arguments"; ``colcon_core.package_selection``.
    """

    code = "PX084"
    name = "package-name-repeated"
    effect = Effect.STOPS_BUILD
    examples = (
        Example(
            "different names",
            {"package.xml": _MANIFEST},
            neighbors={"listener": {"package.xml": _MANIFEST.replace("talker", "listener")}},
        ),
        Example(
            "a copy that colcon ignores",
            {"package.xml": _MANIFEST},
            neighbors={"copy": {"package.xml": _MANIFEST, "COLCON_IGNORE": ""}},
        ),
        Example(
            "a copy",
            {"package.xml": _MANIFEST},
            "2:3: 'talker' is also the name of the package in copy: colcon stops",
            neighbors={"copy": {"package.xml": _MANIFEST}},
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        element = package.manifest.one("name")
        if element is None or is_ignored(package):
            return
        for other in package.workspace.namesakes(package):
            if other.directory < package.directory or is_ignored(other):
                continue
            if _is_same_workspace(package.directory, other.directory):
                where = os.path.relpath(other.directory, package.directory)
                message = (
                    f"{package.name!r} is also the name of the package in {where}: colcon stops"
                )
                yield self.report(element, message)
                return


def _is_same_workspace(directory: str, other: str) -> bool:
    """Return whether one run of colcon builds both packages."""
    parts, others = directory.split("/"), other.split("/")
    if parts[:-1] == others[:-1]:
        return True
    pairs = takewhile(lambda pair: pair[0] == pair[1], zip(parts, others, strict=False))
    common = [part for part, _ in pairs]
    inside = (*parts[len(common) :], *others[len(common) :])
    return _SOURCES in common and _SOURCES not in inside
