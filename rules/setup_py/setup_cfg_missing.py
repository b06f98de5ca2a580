"""SP003: executables land where ``ros2 run`` looks."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import CreateFile, Diagnostic, Example, Fix, Package, Report, Rule
from scaffold.api.setup_py import node_scripts

_CFG = "[develop]\nscript_dir=$base/lib/{0}\n[install]\ninstall_scripts=$base/lib/{0}\n"
_SETUP = "from setuptools import setup\n\nsetup(\n    name='talker',\n{})\n"
_ENTRY = "    entry_points={'console_scripts': ['talker = talker.node:main']},\n"
_MANIFEST = (
    "<package><name>talker</name><export><build_type>ament_python</build_type></export></package>\n"
)
_NODE = {"talker/__init__.py": "", "talker/node.py": "import rclpy\n"}


class SetupCfgMissing(Rule):
    """There is no setup.cfg that says where executables go.

    **Why.** They land in ``bin/``: ``ros2 run`` answers ``No executable found``.

    **Fix.** Write a setup.cfg with ``script_dir`` and ``install_scripts`` set to
    ``$base/lib/<package>``.

    **Source.** ROS 2 documentation, "Developing a ROS 2 package".
    """

    code = "SP003"
    name = "setup-cfg-missing"
    examples = (
        Example(
            "there",
            {
                "package.xml": _MANIFEST,
                "setup.py": _SETUP.format(_ENTRY),
                "setup.cfg": _CFG.format("talker"),
                **_NODE,
            },
        ),
        Example(
            "a tool that is no node may go to bin",
            {
                "package.xml": _MANIFEST,
                "setup.py": _SETUP.format(_ENTRY),
                "talker/node.py": "import sys\n",
            },
        ),
        Example(
            "the command of a package with verbs of `ros2`",
            {
                "package.xml": _MANIFEST,
                "setup.py": _SETUP.format(
                    _ENTRY.replace("]}", "], 'ros2cli.command': ['talk = talker.talk:Talk']}")
                ),
                **_NODE,
            },
        ),
        Example(
            "missing",
            {"package.xml": _MANIFEST, "setup.py": _SETUP.format(_ENTRY), **_NODE},
            Report(
                "setup.cfg:1:1",
                "no setup.cfg: 'talker' of setup.py is installed to bin/, where "
                "`ros2 run` does not look",
                fix="write setup.cfg",
            ),
            fixed={"setup.cfg": _CFG.format("talker")},
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        scripts = node_scripts(package)
        if package.build_type != "ament_python" or package.has("setup.cfg") or not scripts:
            return
        if package.has("pyproject.toml") and "script" in package.source("pyproject.toml").text:
            return
        fix = Fix("write setup.cfg", (CreateFile("setup.cfg", _CFG.format(package.name)),))
        message = (
            f"no setup.cfg: {scripts[0].name!r} of setup.py is installed to bin/, where `ros2 run` "
            "does not look"
        )
        yield self.report(package.start_of("setup.cfg"), message, fix)
