"""SP004: setup.cfg installs executables to ``lib/<package>``, which ``ros2 run`` searches."""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import suppress

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
    ViewError,
)
from scaffold.api.manifest import name_used_elsewhere
from scaffold.api.setup_py import node_scripts

_CFG = "[develop]\nscript_dir=$base/lib/{0}\n[install]\ninstall_scripts=$base/lib/{0}\n"
_SETUP = "from setuptools import setup\n\nsetup(\n    name='talker',\n{})\n"
_ENTRY = "    entry_points={'console_scripts': ['talker = talker.node:main']},\n"
_MANIFEST = (
    "<package><name>talker</name><export><build_type>ament_python</build_type></export></package>\n"
)
_NODE = {"talker/__init__.py": "", "talker/node.py": "import rclpy\n"}
_INSTALLED = "install_scripts"
KEYS = (("develop", "script_dir"), ("install", _INSTALLED))
_MANIFEST_VALUE = "<package><name>talker</name></package>\n"
_SETUP_VALUE = (
    "from setuptools import setup\n\n"
    "setup(entry_points={'console_scripts': ['talk = talker.node:main']})\n"
)
_CFG_VALUE = "[develop]\nscript_dir={}\n[install]\ninstall_scripts={}\n"


class ScriptDirectoryDiffers(Rule):
    """setup.cfg does not install executables to ``$base/lib/<package>``.

    **Why.** Executables are installed to ``bin/`` or elsewhere, but ``ros2 run`` only searches
    ``lib/<package>``: ``No executable found``.

    **Fix.** Write a setup.cfg with ``script_dir`` and ``install_scripts`` set to ``$base/lib/`` and
    the name in package.xml.

    **Source.** ROS 2 documentation, "Developing a ROS 2 package", "Creating a package";
    ``ros2pkg.api.get_executable_paths``.
    """

    code = "SP004"
    name = "script-directory-differs"
    effect = Effect.STOPS_PACKAGE
    other_severities = {Severity.WARNING: "it is bin/, from which a shell can run the program"}
    examples = (
        Example(
            "a setup.cfg",
            {
                "package.xml": _MANIFEST,
                "setup.py": _SETUP.format(_ENTRY),
                "setup.cfg": _CFG.format("talker"),
                **_NODE,
            },
        ),
        Example(
            "a tool that is not a node, in bin",
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
            "a script of that name is installed next to it",
            {
                "package.xml": _MANIFEST,
                "setup.py": "from glob import glob\n"
                + _SETUP.format(_ENTRY + "    data_files=[('lib/talker', glob('scripts/*'))],\n"),
                "scripts/talker": "#!/usr/bin/env python3\nfrom talker.node import main\nmain()\n",
                **_NODE,
            },
        ),
        Example(
            "no setup.cfg",
            {"package.xml": _MANIFEST, "setup.py": _SETUP.format(_ENTRY), **_NODE},
            Report(
                "setup.cfg:1:1",
                "no setup.cfg: 'talker' in setup.py is installed to bin/, which `ros2 "
                "run` does not search",
                fix="Create setup.cfg",
            ),
            fixed={"setup.cfg": _CFG.format("talker")},
        ),
        Example(
            "a command that the README runs in a shell",
            {
                "package.xml": _MANIFEST,
                "setup.py": _SETUP.format(_ENTRY),
                "README.md": "Run it:\n\n    $ talker --rate 2\n",
                **_NODE,
            },
            Report(
                "setup.cfg:1:1",
                "no setup.cfg: 'talker' in setup.py is installed to bin/, which `ros2 "
                "run` does not search",
                fix="Create setup.cfg",
                severity=Severity.WARNING,
            ),
            fixed={"setup.cfg": _CFG.format("talker")},
        ),
        Example(
            "a command in a code block of the README",
            {
                "package.xml": _MANIFEST,
                "setup.py": _SETUP.format(_ENTRY.replace("'talker =", "'view-talks =")),
                "setup.cfg": "[pep8]\n",
                "README.md": "Watch:\n\n```\n. ./install/setup.bash\nview-talks\n```\n",
                **_NODE,
            },
            Report(
                "setup.cfg:1:1",
                "[develop] has no script_dir=$base/lib/talker: `ros2 run` finds no executable",
                fix="Replace with $base/lib/talker",
                severity=Severity.WARNING,
            ),
            Report(
                "setup.cfg:1:1",
                "[install] has no install_scripts=$base/lib/talker: `ros2 run` finds no executable",
                fix="Replace with $base/lib/talker",
                severity=Severity.WARNING,
            ),
            fixed={"setup.cfg": "[pep8]\n" + _CFG_VALUE.format(*["$base/lib/talker"] * 2)},
        ),
        Example(
            "a program that the README only mentions",
            {
                "package.xml": _MANIFEST,
                "setup.py": _SETUP.format(_ENTRY.replace("'talker =", "'view-talks =")),
                "setup.cfg": "[pep8]\n",
                "README.md": "```\nls\n```\nPrograms:\n\nview-talks\n",
                **_NODE,
            },
            Report(
                "setup.cfg:1:1",
                "[develop] has no script_dir=$base/lib/talker: `ros2 run` finds no executable",
                fix="Replace with $base/lib/talker",
            ),
            Report(
                "setup.cfg:1:1",
                "[install] has no install_scripts=$base/lib/talker: `ros2 run` finds no executable",
                fix="Replace with $base/lib/talker",
            ),
            fixed={"setup.cfg": "[pep8]\n" + _CFG_VALUE.format(*["$base/lib/talker"] * 2)},
        ),
        Example(
            "bin/",
            {
                "package.xml": _MANIFEST_VALUE,
                "setup.py": _SETUP_VALUE,
                "setup.cfg": _CFG_VALUE.format("$base/lib/talker", "$base/bin"),
            },
            Report(
                "setup.cfg:4:17",
                "install_scripts is '$base/bin', but `ros2 run talker` searches $base/lib/talker",
                fix="Replace with $base/lib/talker",
                severity=Severity.WARNING,
            ),
            fixed={"setup.cfg": _CFG_VALUE.format("$base/lib/talker", "$base/lib/talker")},
        ),
        Example(
            "the directory of the package",
            {
                "package.xml": _MANIFEST_VALUE,
                "setup.py": _SETUP_VALUE,
                "setup.cfg": _CFG_VALUE.format("$base/lib/talker", "$base/lib/talker"),
            },
        ),
        Example(
            "set by another command",
            {
                "package.xml": _MANIFEST_VALUE,
                "setup.py": _SETUP_VALUE.replace("setup(", "setup(cmdclass={'install': Install}, "),
                "setup.cfg": "[flake8]\n",
                "talker/node.py": "import rclpy\n",
            },
        ),
        Example(
            "the name of the package that it was copied from",
            {
                "package.xml": _MANIFEST_VALUE,
                "setup.py": _SETUP_VALUE,
                "setup.cfg": _CFG_VALUE.format("$base/lib/talker", "$base/lib/other"),
            },
            Report(
                "setup.cfg:4:17",
                "install_scripts is '$base/lib/other', but `ros2 run talker` searches "
                "$base/lib/talker",
                fix="Replace with $base/lib/talker",
            ),
            fixed={"setup.cfg": _CFG_VALUE.format("$base/lib/talker", "$base/lib/talker")},
        ),
        Example(
            "for install only, whose directory develop uses, too",
            {
                "package.xml": _MANIFEST_VALUE,
                "setup.py": _SETUP_VALUE,
                "setup.cfg": "[develop]\n[install]\ninstall_scripts=$base/lib/talker\n",
                "talker/node.py": "import rclpy\n",
            },
        ),
        Example(
            "for pip only",
            {
                "package.xml": _MANIFEST_VALUE,
                "setup.py": _SETUP_VALUE,
                "setup.cfg": "[develop]\nscript_dir=$base/lib/talker\n",
                "talker/node.py": "import rclpy\n",
            },
            Report(
                "setup.cfg:1:1",
                "[install] has no install_scripts=$base/lib/talker: `ros2 run` finds no executable",
                fix="Replace with $base/lib/talker",
            ),
            fixed={"setup.cfg": _CFG_VALUE.format("$base/lib/talker", "$base/lib/talker")},
        ),
        Example(
            "next to a CMakeLists.txt, where setup.cfg is not used",
            {
                "package.xml": _MANIFEST.replace("_python", "_cmake"),
                "CMakeLists.txt": "",
                "setup.py": _SETUP.format(_ENTRY),
                "setup.cfg": _CFG.format("other"),
                **_NODE,
            },
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        yield from self._check_file(package)
        yield from self._check_value(package)

    def _check_file(self, package: Package) -> Iterator[Diagnostic]:
        scripts = node_scripts(package)
        if package.build_type != "ament_python" or package.has("setup.cfg") or not scripts:
            return
        if package.has("pyproject.toml") and "script" in package.source("pyproject.toml").text:
            return
        fix = Fix("Create setup.cfg", (CreateFile("setup.cfg", _CFG.format(package.name)),))
        message = (
            f"no setup.cfg: {scripts[0].name!r} in setup.py is installed to bin/, which `ros2 "
            f"run` does not search"
        )
        yield self.report(package.start_of("setup.cfg"), message, fix, severity=_severity(package))

    def _check_value(self, package: Package) -> Iterator[Diagnostic]:
        cfg = package.setup_cfg
        wanted = f"$base/lib/{package.name}"
        if not package.setup_py.console_scripts or not package.manifest.name:
            return
        if package.build_type == "ament_cmake":
            return  # setup.py is not run there
        if name_used_elsewhere(package) or package.setup_py.keyword("cmdclass"):
            return  # custom commands may set the directory
        for section, key in KEYS:
            entry = cfg.option(section, key, key.replace("_", "-"))
            if entry is None and section == "develop" and cfg.option("install", _INSTALLED):
                continue  # develop uses the directory of install then
            if entry is None and node_scripts(package):
                at = package.start_of("setup.cfg")
                severity = _severity(package)
                message = f"[{section}] has no {key}={wanted}: `ros2 run` finds no executable"
                fix = Fix(f"Replace with {wanted}", (cfg.set(section, key, wanted),))
                yield self.report(at, message, fix, severity=severity, cause="directory of scripts")
            elif entry is not None and entry.value.rstrip("/") not in {
                wanted,
                wanted.replace("$base", "${base}"),
            }:
                message = (
                    f"{key} is {entry.value!r}, but `ros2 run {package.name}` searches {wanted}"
                )
                edit = Edit("setup.cfg", entry.value_start, entry.value_end, wanted)
                fix = Fix(f"Replace with {wanted}", (edit,))
                is_bin = entry.value.rstrip("/").endswith("/bin")
                severity = Severity.WARNING if is_bin else Severity.ERROR
                yield self.report(
                    entry, message, fix, severity=severity, cause="directory of scripts"
                )


def _severity(package: Package) -> Severity:
    """Return the severity of nodes that are installed to ``bin/``."""
    names = [script.name for script in node_scripts(package)]
    is_command = all(_is_run_in_shell(package, name) for name in names)
    return Severity.WARNING if is_command else Severity.ERROR


def _is_run_in_shell(package: Package, name: str) -> bool:
    """Return whether a text of the package starts a program as a shell command."""
    word = re.escape(name)
    command = re.compile(rf"(?m)^[ \t]*(?:\$[ \t]+{word}(?!\S)|{word}[ \t]+--?\w)")
    texts: list[str] = []
    for path in package.files:
        if path.endswith((".md", ".rst")):
            with suppress(ViewError):
                texts.append(package.source(path).text)
    is_started = any(re.search(rf"ros2 run \S+ {word}\b", text) for text in texts)
    return not is_started and any(
        command.search(text) or (name != package.name and name in _code_lines(text))
        for text in texts
    )


def _code_lines(text: str) -> Iterator[str]:
    """Yield the lines of the code blocks of a text in Markdown."""
    is_code = False
    for line in text.splitlines():
        if line.startswith("```"):
            is_code = not is_code
        elif is_code:
            yield line
