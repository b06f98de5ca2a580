"""SP004: setup.cfg sends executables to ``lib/<package>``."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Edit, Example, Fix, Package, Report, Rule
from scaffold.api.manifest import name_used_elsewhere
from scaffold.api.setup_py import node_scripts

KEYS = (("develop", "script_dir"), ("install", "install_scripts"))
_MANIFEST = "<package><name>talker</name></package>\n"
_SETUP = (
    "from setuptools import setup\n\n"
    "setup(entry_points={'console_scripts': ['talk = talker.node:main']})\n"
)
_CFG = "[develop]\nscript_dir={}\n[install]\ninstall_scripts={}\n"


class ScriptDirectoryDiffers(Rule):
    """setup.cfg does not send executables to ``$base/lib/<package>``.

    **Why.** ``ros2 run`` looks in ``lib/<package>`` alone: ``No executable found``.

    **Fix.** Write ``$base/lib/`` and the name in package.xml.

    **Source.** ROS 2 documentation, "Creating a package"; ``ros2pkg.api.get_executable_paths``.
    """

    code = "SP004"
    name = "script-directory-differs"
    examples = (
        Example(
            "the package's own",
            {
                "package.xml": _MANIFEST,
                "setup.py": _SETUP,
                "setup.cfg": _CFG.format("$base/lib/talker", "$base/lib/talker"),
            },
        ),
        Example(
            "set by a command",
            {
                "package.xml": _MANIFEST,
                "setup.py": _SETUP.replace("setup(", "setup(cmdclass={'install': Install}, "),
                "setup.cfg": "[flake8]\n",
                "talker/node.py": "import rclpy\n",
            },
        ),
        Example(
            "of the package that it was copied from",
            {
                "package.xml": _MANIFEST,
                "setup.py": _SETUP,
                "setup.cfg": _CFG.format("$base/lib/talker", "$base/lib/other"),
            },
            Report(
                "setup.cfg:4:17",
                "install_scripts is '$base/lib/other'; `ros2 run talker` looks in $base/lib/talker",
                fix="write $base/lib/talker",
            ),
            fixed={"setup.cfg": _CFG.format("$base/lib/talker", "$base/lib/talker")},
        ),
        Example(
            "for pip alone",
            {
                "package.xml": _MANIFEST,
                "setup.py": _SETUP,
                "setup.cfg": "[develop]\nscript_dir=$base/lib/talker\n",
                "talker/node.py": "import rclpy\n",
            },
            Report(
                "setup.cfg:1:1",
                "[install] has no install_scripts=$base/lib/talker: `ros2 run` finds nothing",
                fix="write $base/lib/talker",
            ),
            fixed={"setup.cfg": _CFG.format("$base/lib/talker", "$base/lib/talker")},
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        cfg = package.setup_cfg
        wanted = f"$base/lib/{package.name}"
        if not package.setup_py.console_scripts or not package.manifest.name:
            return
        if name_used_elsewhere(package) or package.setup_py.keyword("cmdclass"):
            return  # commands of its own may set the directory
        for section, key in KEYS:
            entry = cfg.option(section, key, key.replace("_", "-"))
            if entry is None and node_scripts(package):
                at = package.start_of("setup.cfg")
                message = f"[{section}] has no {key}={wanted}: `ros2 run` finds nothing"
                fix = Fix(f"write {wanted}", (cfg.set(section, key, wanted),))
                yield self.report(at, message, fix, cause="directory of scripts")
            elif entry is not None and entry.value.rstrip("/") not in {
                wanted,
                wanted.replace("$base", "${base}"),
            }:
                message = f"{key} is {entry.value!r}; `ros2 run {package.name}` looks in {wanted}"
                edit = Edit("setup.cfg", entry.value_start, entry.value_end, wanted)
                fix = Fix(f"write {wanted}", (edit,))
                yield self.report(entry, message, fix, cause="directory of scripts")
