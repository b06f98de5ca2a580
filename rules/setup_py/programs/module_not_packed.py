"""SP051: packages, package_dir and py_modules match the source tree."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from scaffold.api import Diagnostic, Edit, Effect, Example, Fix, Location, Package, Report, Rule
from scaffold.api.python import Unknown
from scaffold.api.setup_py import FindPackages, SetupPy, installed_data
from scaffold.api.workspace import is_of_submodule

_SETUP = (
    "from setuptools import find_packages, setup\n\nsetup(\n    name='talker',\n{}"
    "    entry_points={{'console_scripts': ['node = talker.node:main']}},\n)\n"
)
_FILES = {"talker/__init__.py": "", "talker/node.py": "def main():\n    pass\n"}
_SETUP_SUBPACKAGES = (
    "from setuptools import {}\n\nsetup(\n    name='talker',\n    packages={},\n)\n"
)
_FILES_SUBPACKAGES = {
    "talker/__init__.py": "",
    "talker/text/__init__.py": "",
    "test/__init__.py": "",
}
_BY_CMAKE = (
    "<package><name>talker</name><export><build_type>ament_cmake</build_type></export></package>\n"
)
_FIND = "find_packages(exclude=['test'])"
_TESTS = frozenset({"test", "tests"})
"""Sub-packages that are often left out on purpose."""
_SETUP_PLACES = "from setuptools import setup\n\nsetup(\n    name='talker',\n{})\n"
_FILES_PLACES = {"src/talker/__init__.py": "", "src/text.py": ""}


class ModuleNotPacked(Rule):
    """``packages`` lacks a package or subpackage, or setup.py names a missing directory.

    **Why.** The executables are installed, but the code is not: ``ModuleNotFoundError: No module
    named 'talker.text'`` when they are started, although it works in the source tree. The build
    stops at missing directories: ``package directory 'demo' does not exist``, ``error in 'egg_base'
    option: 'src' does not exist``.

    **Fix.** Write ``packages=find_packages(exclude=['test'])``, and set ``package_dir`` to the
    directory with the packages.

    **Source.** setuptools documentation, "Package Discovery and Namespace Packages"; the template
    of ``ros2 pkg create``.
    """

    code = "SP051"
    name = "module-not-packed"
    effect = Effect.STOPS_PACKAGE
    examples = (
        Example(
            "found",
            {
                "setup.py": _SETUP.format("    packages=find_packages(exclude=['test']),\n"),
                **_FILES,
            },
        ),
        Example(
            "none",
            {"setup.py": _SETUP.format(""), **_FILES},
            "setup.py:3:1: packages does not include 'talker', which the entry points start",
        ),
        Example(
            "excluded",
            {
                "setup.py": _SETUP.format("    packages=find_packages(include=['test']),\n"),
                **_FILES,
            },
            "setup.py:5:14: find_packages does not include 'talker', which the entry points start",
        ),
        Example(
            "another name",
            {"setup.py": _SETUP.format("    packages=['demo'],\n"), **_FILES},
            "setup.py:5:14: packages does not include 'talker', which the entry points start",
            "setup.py:5:14: packages lists 'demo', which does not exist: the build stops",
        ),
        Example(
            "no __init__.py",
            {
                "setup.py": _SETUP.format("    packages=find_packages(),\n"),
                "talker/node.py": "def main():\n    pass\n",
            },
            "talker/__init__.py:1:1: missing: without it, find_packages does not install talker/",
        ),
        Example(
            "no directory src",
            {"setup.py": _SETUP.format("    packages=find_packages(where='src'),\n"), **_FILES},
            "setup.py:5:14: find_packages searches src/, which does not exist: nothing is "
            "installed",
        ),
        Example(
            "a subpackage that CMake installs",
            {
                **_FILES_SUBPACKAGES,
                "package.xml": _BY_CMAKE,
                "setup.py": _SETUP_SUBPACKAGES.format("setup", "['talker']"),
            },
        ),
        Example(
            "subpackages listed by their directories",
            {
                **_FILES_SUBPACKAGES,
                "setup.py": _SETUP_SUBPACKAGES.format("setup", "['talker', 'talker/text/']"),
            },
        ),
        Example(
            "a listed subpackage that does not exist",
            {
                **_FILES_SUBPACKAGES,
                "setup.py": _SETUP_SUBPACKAGES.format(
                    "setup", "['talker', 'talker/' + 'text', 'talker/models']"
                ),
            },
            "setup.py:5:14: packages lists 'talker.models', but talker/models/ does not exist: "
            "the build stops",
        ),
        Example(
            "a subpackage that is excluded with its tests",
            {
                "talker/__init__.py": "",
                "talker/tests/__init__.py": "",
                "setup.py": _SETUP_SUBPACKAGES.format("setup", "['talker']"),
            },
        ),
        Example(
            "a subpackage in the package data",
            {
                "talker/__init__.py": "",
                "talker/launch/__init__.py": "",
                "setup.py": _SETUP_SUBPACKAGES.format("setup", "['talker']").replace(
                    ",\n)",
                    ",\n    data_files=[('share/talker', ['talker/launch/__init__.py'])],\n)",
                ),
            },
        ),
        Example(
            "one package listed, without its subpackages",
            {
                **_FILES_SUBPACKAGES,
                "setup.py": _SETUP_SUBPACKAGES.format("find_packages, setup", "['talker']"),
            },
            Report(
                "setup.py:5:14",
                "packages does not include talker.text: it is not installed; write "
                "find_packages(exclude=['test'])",
                fix="Replace with find_packages(exclude=['test'])",
            ),
            fixed={"setup.py": _SETUP_SUBPACKAGES.format("find_packages, setup", _FIND)},
        ),
        Example(
            "a directory of package_dir",
            {
                "setup.py": _SETUP_PLACES.format(
                    "    package_dir={'': 'src'},\n    packages=['talker'],\n"
                    "    py_modules=['text'],\n"
                ),
                **_FILES_PLACES,
            },
        ),
        Example(
            "a directory of package_dir that does not exist",
            {"setup.py": _SETUP_PLACES.format("    package_dir={'': 'lib'},\n"), **_FILES_PLACES},
            "setup.py:5:17: package_dir names lib/, which does not exist: nothing is installed",
        ),
        Example(
            "a directory of package_dir in a git submodule, which a clone may not have",
            {
                "setup.py": _SETUP_PLACES.format(
                    "    package_dir={'': 'solver/src'},\n    packages=['solver'],\n"
                ),
                ".gitmodules": '[submodule "solver"]\n\tpath = solver\n\turl = ../solver.git\n',
            },
        ),
        Example(
            "a package in py_modules",
            {
                "setup.py": _SETUP_PLACES.format("    py_modules=['talker'],\n"),
                "talker/__init__.py": "",
            },
            "setup.py:5:16: talker/ is a package: list it in packages, not in py_modules",
        ),
        Example(
            "a package of a node that patterns leave out",
            {
                "setup.py": _SETUP_PLACES.format(
                    "    packages=find_packages(include=['talker']),\n"
                    "    entry_points={'console_scripts': ['a = talker.nodes.a:main']},\n"
                ).replace("import setup", "import find_packages, setup"),
                "talker/__init__.py": "",
                "talker/nodes/__init__.py": "",
                "talker/nodes/a.py": "def main():\n    pass\n",
            },
            "setup.py:5:14: find_packages does not include 'talker.nodes', which the entry points "
            "start",
        ),
        Example(
            "packages in setup.cfg",
            {
                "setup.py": "from setuptools import setup\n\nsetup()\n",
                "setup.cfg": "[options]\npackages = find:\n",
                "talker/__init__.py": "",
            },
        ),
        Example(
            "packages that setup.cfg does not find",
            {
                "setup.py": "from setuptools import setup\n\nsetup()\n",
                "setup.cfg": "[options]\npackages = find:\n[options.packages.find]\nwhere = src\n",
                "talker/__init__.py": "",
            },
            "setup.cfg:2:12: find_packages searches src/, which does not exist: nothing is "
            "installed",
        ),
        Example(
            "a colon that is missing in setup.cfg",
            {
                "setup.py": "from setuptools import setup\n\nsetup()\n",
                "setup.cfg": "[options]\npackages = find\n",
                "talker/__init__.py": "",
            },
            "setup.cfg:2:12: packages lists 'find', which does not exist: the build stops; did you "
            "mean 'find:'?",
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        yield from self._check_packages(package)
        yield from self._check_subpackages(package)
        yield from self._check_places(package)

    def _check_packages(self, package: Package) -> Iterator[Diagnostic]:
        setup = package.setup_py
        if package.build_type == "ament_cmake":
            return  # setup.py is not run there
        if setup.call is None or setup.has_unknown_keywords or _is_configured(package, setup):
            return
        keyword = setup.keyword("packages")
        packages = setup.packages
        roots = {script.module.partition(".")[0] for script in setup.console_scripts} - {""}
        if isinstance(packages, FindPackages):
            yield from self._check_found(package, setup, packages)
            return
        names = list(packages) if isinstance(packages, list | tuple) else None
        if (keyword is not None and names is None) or setup.keyword("py_modules"):
            return
        at = keyword or setup
        yield from self._check_listed(package, at.location, names or ())
        for root in sorted(roots - {item.partition(".")[0] for item in names or ()}):
            if package.has_directory(root):
                message = f"packages does not include {root!r}, which the entry points start"
                yield self.report(at, message)

    def _check_listed(
        self, package: Package, at: Location, names: Iterable[str]
    ) -> Iterator[Diagnostic]:
        for name in names:
            place = name.replace(".", "/")
            root = place.partition("/")[0]
            if package.has_directory(place) or is_of_submodule(package, place):
                continue
            is_top = not package.has_directory(root)
            missing = "which" if is_top else f"but {place}/"
            message = f"packages lists {name!r}, {missing} does not exist: the build stops"
            if at.path == "setup.cfg" and name in {"find", "find_namespace"}:
                message = f"{message}; did you mean '{name}:'?"
            yield self.report(at, message, cause=f"directory {root if is_top else place}")

    def _check_found(
        self, package: Package, setup: SetupPy, packages: FindPackages
    ) -> Iterator[Diagnostic]:
        keyword = setup.keyword("packages")
        if keyword is None or packages.namespace or isinstance(packages.where, Unknown):
            return
        where = packages.where.strip("./")
        if where and not package.has_directory(where):
            if is_of_submodule(package, where):
                return
            message = f"find_packages searches {where}/, which does not exist: nothing is installed"
            yield self.report(keyword, message)
            return
        for name in _started(setup) if not where else ():
            is_left_out = packages.leaves_out(name)
            if isinstance(is_left_out, Unknown):
                return
            root = name.replace(".", "/")
            if is_left_out and package.has_directory(root):
                message = f"find_packages does not include {name!r}, which the entry points start"
                yield self.report(keyword, message)
                return
            if "/" in root:
                continue  # LY004 reports a subpackage without __init__.py
            if package.glob(f"{root}/*.py") and not package.has(f"{root}/__init__.py"):
                init = f"{root}/__init__.py"
                message = f"missing: without it, find_packages does not install {root}/"
                yield self.report(package.start_of(init), message)

    def _check_subpackages(self, package: Package) -> Iterator[Diagnostic]:
        if package.build_type == "ament_cmake":
            return  # ament_python_install_package() copies the whole directory
        setup = package.setup_py
        packages = setup.packages
        keyword = setup.keyword("packages")
        if keyword is None or not packages or isinstance(packages, FindPackages | Unknown):
            return
        data = installed_data(package) or frozenset()
        missing = sorted(
            name
            for path in package.files
            if path.endswith("/__init__.py") and path.count("/") > 1
            for name in (path.removesuffix("/__init__.py").replace("/", "."),)
            if name.rpartition(".")[0] in packages and name not in packages
            if name.rpartition(".")[2] not in _TESTS
            if path not in data
        )
        if not missing or setup.keyword("package_dir"):
            return
        fix = None
        if "find_packages" in setup.module.index.bindings(setup.module.tree):
            start, end = setup.module.span(keyword.node)
            fix = Fix(f"Replace with {_FIND}", (Edit("setup.py", start, end, _FIND),))
        message = (
            f"packages does not include {', '.join(missing)}: it is not installed; write {_FIND}"
        )
        yield self.report(keyword, message, fix)

    def _check_places(self, package: Package) -> Iterator[Diagnostic]:
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
                message = f"{name}/ is a package: list it in packages, not in py_modules"
                yield self.report(modules, message)


def _started(setup: SetupPy) -> list[str]:
    """Return the packages, with those around them, of the modules that entry points start."""
    parts = [script.module.split(".")[:-1] for script in setup.console_scripts]
    return sorted({".".join(names[:end]) for names in parts for end in range(1, len(names) + 1)})


def _is_configured(package: Package, setup: SetupPy) -> bool:
    """Return whether packages are configured in another way."""
    if setup.keyword("package_dir") is not None:
        return True
    return package.has("pyproject.toml")


def _missing(package: Package, places: object) -> Iterator[str]:
    """Yield the missing directories of ``package_dir``."""
    for place in places.values() if isinstance(places, dict) else ():
        path = place.removeprefix("./").rstrip("/") if isinstance(place, str) else ""
        is_own = path not in {"", "."} and not path.startswith(("/", ".."))
        is_missing = is_own and not package.has_directory(path)
        if is_missing and not is_of_submodule(package, path):
            yield path
