"""SP007: package.xml is installed."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Edit, Example, Fix, Package, Report, Rule, Severity

_MANIFEST = (
    "<package><name>talker</name><export><build_type>ament_python</build_type></export></package>\n"
)
_SETUP = (
    "from setuptools import setup\n\nsetup(\n    name='talker',\n    data_files=[\n{}    ],\n)\n"
)
_MARKER = "        ('share/ament_index/resource_index/packages', ['resource/talker']),\n"
_LINE = "        ('share/talker', ['package.xml']),\n"


class ManifestNotInstalled(Rule):
    """data_files do not install package.xml to ``share/<package>``.

    **Why.** colcon warns and adds it for now; tools that read the installed manifest do not
    find it in the released Debian package.

    **Fix.** Add ``('share/' + package_name, ['package.xml'])``.

    **Source.** ``colcon_ros/task/ament_python/build.py``.
    """

    code = "SP007"
    name = "manifest-not-installed"
    severity = Severity.WARNING
    release_refused = "the Debian package lacks its manifest"
    examples = (
        Example(
            "installed", {"package.xml": _MANIFEST, "setup.py": _SETUP.format(_MARKER + _LINE)}
        ),
        Example(
            "forgotten",
            {"package.xml": _MANIFEST, "setup.py": _SETUP.format(_MARKER)},
            Report(
                "setup.py:5:16",
                "data_files does not install package.xml to share/talker",
                fix="install package.xml",
            ),
            fixed={"setup.py": _SETUP.format(_LINE + _MARKER)},
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        setup = package.setup_py
        keyword = setup.keywords.get("data_files")
        if package.build_type != "ament_python" or not setup.data_files_complete:
            return
        if keyword is None or any("package.xml" in data.sources for data in setup.data_files):
            return
        message = f"data_files does not install package.xml to share/{package.name}"
        yield self.report(keyword, message, self._fix(package))

    def _fix(self, package: Package) -> Fix | None:
        data = package.setup_py.data_files
        if not data:
            return None
        source = package.source("setup.py")
        at = data[0].location
        line = source.lines[at.line - 1]
        if line[: at.column - 1].strip():
            return None
        start = source.offset(at.line)
        text = f"{line[: at.column - 1]}('share/{package.name}', ['package.xml']),{source.newline}"
        return Fix("install package.xml", (Edit("setup.py", start, start, text),))
