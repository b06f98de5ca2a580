"""SP015: files that a module reads are installed next to it."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Effect, Example, Package, Report, Rule, Severity
from scaffold.api.install import is_never_run, own_files
from scaffold.api.setup_py import installed_data, matches, package_data

_SETUP = (
    "from setuptools import setup\n\nsetup(\n    name='talker',\n    packages=['talker'],\n{})\n"
)
_FILES = {
    "package.xml": '<package format="3"><name>talker</name>'
    "<export><build_type>ament_python</build_type></export></package>\n",
    "talker/__init__.py": "",
    "talker/text.py": "from pathlib import Path\n\n"
    "WORDS = (Path(__file__).parent / 'words.txt').read_text()\n",
    "talker/words.txt": "hello\n",
}


class PackageDataMissing(Rule):
    """A module reads a file next to it that setup.py does not install.

    Or ``package_data`` names a Python package that does not exist, so that it installs nothing.

    **Why.** It works in the source tree and with ``--symlink-install``, but fails after
    installation: ``FileNotFoundError: .../site-packages/talker/words.txt``.

    **Fix.** Add ``package_data={'talker': ['words.txt']}``.

    **Source.** setuptools documentation, "Data Files Support".
    """

    code = "SP015"
    name = "package-data-missing"
    effect = Effect.SPOILS_INSTALL
    other_severities = {Severity.WARNING: "the module is not imported or started"}
    examples = (
        Example(
            "installed with the package",
            {**_FILES, "setup.py": _SETUP.format("    package_data={'talker': ['*.txt']},\n")},
        ),
        Example(
            "one of several paths, of which the module uses an existing one",
            {
                **_FILES,
                "talker/text.py": "import os\n\nPLACES = [\n"
                "    os.path.join(os.path.dirname(__file__), 'words.txt'),\n"
                "    '/usr/share/dict/words',\n]\n"
                "WORDS = next(path for path in PLACES if os.path.exists(path))\n",
                "setup.py": _SETUP.format(""),
            },
        ),
        Example(
            "only read when the source file is executed",
            {
                **_FILES,
                "talker/text.py": "from pathlib import Path\n\nif __name__ == '__main__':\n"
                "    print((Path(__file__).parent / 'words.txt').read_text())\n",
                "setup.py": _SETUP.format(""),
            },
        ),
        Example(
            "also installed elsewhere, with its data",
            {
                **_FILES,
                "setup.py": _SETUP.format(
                    "    data_files=[('share/talker', ['talker/text.py', 'talker/words.txt'])],\n"
                ),
            },
        ),
        Example(
            "in a Python package that is not installed either",
            {
                **_FILES,
                "demo/__init__.py": "",
                "demo/show.py": _FILES["talker/text.py"],
                "demo/words.txt": "hello\n",
                "setup.py": _SETUP.format("    package_data={'talker': ['*.txt']},\n"),
            },
        ),
        Example(
            "looked for in the share directory first",
            {
                **_FILES,
                "talker/text.py": "from pathlib import Path\n\n"
                "from ament_index_python import get_package_share_path\n\ntry:\n"
                "    PLACE = get_package_share_path('talker')\nexcept LookupError:\n"
                "    PLACE = Path(__file__).parent\nWORDS = (PLACE / 'words.txt').read_text()\n"
                "SOURCE = Path(__file__).parent / 'words.txt'\n",
                "setup.py": _SETUP.format(
                    "    data_files=[('share/talker', ['talker/words.txt'])],\n"
                ),
            },
        ),
        Example(
            "excluded",
            {**_FILES, "setup.py": _SETUP.format("")},
            "setup.py:5:14: talker/text.py:3 reads talker/words.txt, which is not installed; add "
            "package_data={'talker': ['words.txt']}",
        ),
        Example(
            "excluded; the module is not used",
            {
                **_FILES,
                "setup.py": _SETUP.format(
                    "    entry_points={'console_scripts': ['node = talker.node:main']},\n"
                ),
                "talker/node.py": "def main():\n    pass\n",
            },
            Report(
                "setup.py:5:14",
                "talker/text.py:3 reads talker/words.txt, which is not installed; add "
                "package_data={'talker': ['words.txt']}",
                severity=Severity.WARNING,
            ),
        ),
        Example(
            "read as a resource; another file is installed",
            {
                **_FILES,
                "talker/text.py": "from importlib.resources import files\n\n"
                "WORDS = files('talker').joinpath('words.txt').read_text()\n",
                "setup.py": _SETUP.format("    package_data={'talker': ['*.json']},\n"),
            },
            "setup.py:6:18: talker/text.py:3 reads talker/words.txt, which is not installed; add "
            "package_data={'talker': ['words.txt']}",
        ),
        Example(
            "included by MANIFEST.in",
            {
                **_FILES,
                "MANIFEST.in": "include talker/words.txt\n",
                "setup.py": _SETUP.format("    include_package_data=True,\n"),
            },
        ),
        Example(
            "included by a MANIFEST.in that does not exist",
            {**_FILES, "setup.py": _SETUP.format("    include_package_data=True,\n")},
            "setup.py:5:14: talker/text.py:3 reads talker/words.txt, which is not installed; add "
            "package_data={'talker': ['words.txt']}",
        ),
        Example(
            "for every package, and for one of another name",
            {
                **_FILES,
                "talker/py.typed": "",
                "setup.py": _SETUP.format(
                    "    package_data={'': ['words.txt'], 'talk': ['py.typed']},\n"
                ),
            },
            "setup.py:6:18: package_data names the Python package 'talk', which does not exist: "
            "its files are not installed",
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        if package.build_type != "ament_python":
            return
        yield from self._check_names(package)
        setup = package.setup_py
        patterns = package_data(package)
        if patterns is None:
            return
        as_data = installed_data(package) or frozenset()
        at = setup.keyword("package_data") or setup.keyword("packages") or setup
        for file in own_files(package):
            holder = self._owning_package(package, file.path)
            if holder is None or file.path.endswith((".py", ".pyi")):
                continue
            if any(matches(pattern, [file.path]) for pattern in patterns):
                continue
            if not _is_installed(package, file.location.path):
                continue
            if file.path in as_data and _reads_there(package, file.location.path, as_data):
                continue
            where, inside = file.location, file.path.removeprefix(f"{holder}/")
            message = (
                f"{where.path}:{where.line} reads {file.path}, which is not installed; "
                f"add package_data={{'{holder.replace('/', '.')}': ['{inside}']}}"
            )
            is_unused = is_never_run(package, where.path)
            yield self.report(at, message, severity=Severity.WARNING if is_unused else None)

    def _check_names(self, package: Package) -> Iterator[Diagnostic]:
        """Report Python packages of package_data that do not exist."""
        setup = package.setup_py
        word = setup.keyword("package_data")
        if word is None or not isinstance(word.value, dict) or setup.keyword("package_dir"):
            return
        for name in word.value:
            directory = str(name).replace(".", "/").strip("*")
            if directory and not package.has_directory(directory):
                message = (
                    f"package_data names the Python package {name!r}, which does not exist: "
                    f"its files are not installed"
                )
                yield self.report(word, message)

    def _owning_package(self, package: Package, path: str) -> str | None:
        """Return the Python package that a file is installed with."""
        directory = path.rpartition("/")[0]
        while directory and not package.has(f"{directory}/__init__.py"):
            directory = directory.rpartition("/")[0]
        return directory or None


def _is_installed(package: Package, module: str) -> bool:
    """Return whether setup.py may install the Python package of a module."""
    packages = package.setup_py.packages
    return not isinstance(packages, list) or (
        module.rpartition("/")[0].replace("/", ".") in packages
    )


def _reads_there(package: Package, module: str, as_data: frozenset[str]) -> bool:
    """Return whether a module is installed with data_files, or looks for the share directory.

    A path beside the source file is a fallback then.
    """
    return module in as_data or b"get_package_share_" in package.data(module)
