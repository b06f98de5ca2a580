"""SP057: package_dir and py_modules name what exists."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Report, Rule

_SETUP = "from setuptools import setup\n\nsetup(\n    name='talker',\n{})\n"
_FILES = {"src/talker/__init__.py": "", "src/text.py": ""}


class ModulePlaceDiffers(Rule):
    """``package_dir`` names a directory that is not there, or ``py_modules`` a package.

    **Why.** The build stops, ``error in 'egg_base' option: 'src' does not exist``, or nothing is
    installed: ``ModuleNotFoundError`` when the node is started.

    **Fix.** Write where the packages are, and name each of them in ``packages``.

    **Source.** setuptools documentation, "Package Discovery and Namespace Packages".
    """

    code = "SP057"
    name = "module-place-differs"
    examples = (
        Example(
            "there",
            {
                "setup.py": _SETUP.format(
                    "    package_dir={'': 'src'},\n    packages=['talker'],\n"
                    "    py_modules=['text'],\n"
                ),
                **_FILES,
            },
        ),
        Example(
            "not there",
            {"setup.py": _SETUP.format("    package_dir={'': 'lib'},\n"), **_FILES},
            Report(
                "setup.py:5:17",
                "package_dir names lib/, which does not exist: nothing is installed",
            ),
        ),
        Example(
            "a package",
            {"setup.py": _SETUP.format("    py_modules=['talker'],\n"), "talker/__init__.py": ""},
            Report(
                "setup.py:5:16", "talker/ is a package: it belongs in packages, not in py_modules"
            ),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        setup = package.setup_py
        if package.build_type == "ament_cmake" or setup.has_unknown_keywords:
            return
        directories = setup.keyword("package_dir")
        if directories is not None:
            for path in _missing(package, directories.value):
                message = f"package_dir names {path}/, which does not exist: nothing is installed"
                yield self.report(directories, message)
        modules = setup.keyword("py_modules")
        named = modules.value if modules is not None else ()
        for name in named if isinstance(named, list | tuple) else ():
            if modules and isinstance(name, str) and package.has(f"{name}/__init__.py"):
                message = f"{name}/ is a package: it belongs in packages, not in py_modules"
                yield self.report(modules, message)


def _missing(package: Package, places: object) -> Iterator[str]:
    """Yield the directories of the package that ``package_dir`` names, and that are not there."""
    for place in places.values() if isinstance(places, dict) else ():
        path = place.removeprefix("./").rstrip("/") if isinstance(place, str) else ""
        is_own = path not in {"", "."} and not path.startswith(("/", ".."))
        if is_own and not package.has_directory(path):
            yield path
