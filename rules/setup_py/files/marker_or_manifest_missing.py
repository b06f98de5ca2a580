"""SP006: the marker of the ament index and package.xml exist and are installed."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.api import (
    CreateFile,
    Diagnostic,
    Edit,
    Effect,
    Example,
    Fix,
    Package,
    Report,
    Rule,
    Severity,
)
from scaffold.api.manifest import name_used_elsewhere

INDEX = "share/ament_index/resource_index/packages"
_MANIFEST = (
    "<package><name>talker</name><export><build_type>ament_python</build_type></export></package>\n"
)
_SETUP = "from setuptools import setup\n\nsetup(\n    name='talker',\n    data_files=[{}],\n)\n"
_BOTH = f"('{INDEX}', ['resource/talker']), ('share/talker', ['package.xml'])"
_SETUP_MANIFEST = (
    "from setuptools import setup\n\nsetup(\n    name='talker',\n    data_files=[\n{}    ],\n)\n"
)
_MARKER = "        ('share/ament_index/resource_index/packages', ['resource/talker']),\n"
_LINE = "        ('share/talker', ['package.xml']),\n"


class MarkerOrManifestMissing(Rule):
    """The file ``resource/<package>`` is missing, or data_files do not install it or package.xml.

    **Why.** Without the file the build stops: ``can't copy 'resource/talker'``. Without the lines,
    colcon warns and installs both, but ``ros2`` does not find the released Debian package, which
    also lacks package.xml.

    **Fix.** Create the empty file, install it to the ament index, and add
    ``('share/' + package_name, ['package.xml'])``.

    **Source.** ROS 2 documentation, "Creating a package";
    ``colcon_ros/task/ament_python/build.py``.
    """

    code = "SP006"
    name = "marker-or-manifest-missing"
    other_severities = {
        Severity.WARNING: "setup.py does not install it, but colcon does, or setup.py installs "
        "another one"
    }
    effect = Effect.STOPS_BUILD
    release_refused = "`ros2` does not find the released package"
    examples = (
        Example(
            "existing and installed",
            {"package.xml": _MANIFEST, "setup.py": _SETUP.format(_BOTH), "resource/talker": ""},
        ),
        Example(
            "installed by setup.cfg",
            {
                "package.xml": _MANIFEST,
                "setup.py": _SETUP.format("('share/talker', ['package.xml'])"),
                "setup.cfg": "[options.data_files]\n"
                "share/ament_index/resource_index/packages = resource/talker\n",
                "resource/talker": "",
            },
        ),
        Example(
            "the file is missing",
            {"package.xml": _MANIFEST, "setup.py": _SETUP.format(_BOTH)},
            Report(
                "setup.py:5:64",
                "data_files names resource/talker, which does not exist: the build stops",
                fix="Create resource/talker",
            ),
            fixed={"resource/talker": ""},
        ),
        Example(
            "not installed",
            {
                "package.xml": _MANIFEST,
                "setup.py": _SETUP.format("('share/talker', ['package.xml'])"),
                "resource/talker": "",
            },
            Report(
                "setup.py:5:16",
                "data_files does not install resource/talker to "
                "share/ament_index/resource_index/packages: ros2 does not find a "
                "released package; colcon installs it with a warning",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "the marker of another package",
            {
                "package.xml": _MANIFEST,
                "setup.py": _SETUP.format(_BOTH.replace("resource/talker", "resource/listener")),
                "resource/listener": "",
            },
            "setup.py:5:18: installs listener as the marker, but the package is 'talker'",
        ),
        Example(
            "a second marker besides that of the package",
            {
                "package.xml": _MANIFEST,
                "setup.py": _SETUP.format(
                    f"{_BOTH}, {_BOTH.replace('resource/talker', 'resource/talker.rviz')}"
                ),
                "resource/talker": "",
                "resource/talker.rviz": "",
            },
            Report(
                "setup.py:5:121",
                "installs talker.rviz as the marker, but the package is 'talker'",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "installed",
            {
                "package.xml": _MANIFEST,
                "resource/talker": "",
                "setup.py": _SETUP_MANIFEST.format(_MARKER + _LINE),
            },
        ),
        Example(
            "package.xml not installed",
            {
                "package.xml": _MANIFEST,
                "resource/talker": "",
                "setup.py": _SETUP_MANIFEST.format(_MARKER),
            },
            Report(
                "setup.py:5:16",
                "data_files does not install package.xml to share/talker: released "
                "packages lack it",
                fix="Install package.xml",
                severity=Severity.WARNING,
            ),
            fixed={"setup.py": _SETUP_MANIFEST.format(_LINE + _MARKER)},
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        yield from self._check_manifest(package)
        if package.build_type != "ament_python" or not package.manifest.name:
            return
        setup = package.setup_py
        marker = f"resource/{package.name}"
        installed = [data for data in setup.data_files if data.destination == INDEX]
        for data in installed:
            for source, at in zip(data.sources, data.source_locations, strict=True):
                if not isinstance(source, str) or package.has(source):
                    continue
                fix = (
                    Fix(f"Create {marker}", (CreateFile(marker, ""),)) if source == marker else None
                )
                message = f"data_files names {source}, which does not exist: the build stops"
                yield self.report(at, message, fix)
            sources = [source for source in data.sources if isinstance(source, str)]
            names = [source.rpartition("/")[2] for source in sources]
            complete = data.complete and len(sources) == len(data.sources)
            if complete and package.name not in names and not name_used_elsewhere(package):
                message = (
                    f"installs {', '.join(names)} as the marker, but the package is "
                    f"{package.name!r}"
                )
                if all(package.has(source) for source in sources):
                    is_extra = any(marker in other.sources for other in installed)
                    severity = Severity.WARNING if is_extra else None
                    yield self.report(data.destination_location, message, severity=severity)
        configured = package.has("setup.cfg") and INDEX in package.source("setup.cfg").text
        if not (installed or configured) and setup.call is not None and setup.data_files_complete:
            message = (
                f"data_files does not install {marker} to {INDEX}: ros2 does not find a released "
                f"package; colcon installs it with a warning"
            )
            yield self.report(
                setup.keywords.get("data_files", setup), message, severity=Severity.WARNING
            )

    def _check_manifest(self, package: Package) -> Iterator[Diagnostic]:
        setup = package.setup_py
        keyword = setup.keywords.get("data_files")
        if package.build_type != "ament_python" or not setup.data_files_complete:
            return
        if keyword is None or any("package.xml" in data.sources for data in setup.data_files):
            return
        message = (
            f"data_files does not install package.xml to share/{package.name}: released "
            f"packages lack it"
        )
        fix = self._fix(package)
        yield self.report(keyword, message, fix, severity=Severity.WARNING)

    def _fix(self, package: Package) -> Fix | None:
        data = package.setup_py.data_files
        if not data or not isinstance(data[0].node, ast.Tuple):
            return None
        source = package.source("setup.py")
        at = data[0].location
        line = source.lines[at.line - 1]
        if line[: at.column - 1].strip():
            return None
        start = source.offset(at.line)
        text = f"{line[: at.column - 1]}('share/{package.name}', ['package.xml']),{source.newline}"
        return Fix("Install package.xml", (Edit("setup.py", start, start, text),))
