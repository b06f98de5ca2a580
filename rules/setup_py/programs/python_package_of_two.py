"""SP061: each Python package is installed by one package of the workspace."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Effect, Example, Package, Rule
from scaffold.api.install import own_roots
from scaffold.api.python import Unknown
from scaffold.api.setup_py import FindPackages

_MANIFEST = (
    "<package><name>{}</name><export><build_type>ament_python</build_type></export></package>\n"
)
_SETUP = (
    "from setuptools import setup\n\nsetup(\n    name='{0}',\n    packages=['{1}'],\n"
    "    entry_points={{'console_scripts': ['talk = {1}.talk:main']}},\n)\n"
)
_TALK = "def main():\n    pass\n"


def _files(name: str, module: str) -> dict[str, str]:
    return {
        "package.xml": _MANIFEST.format(name),
        "setup.py": _SETUP.format(name, module),
        f"{module}/__init__.py": "",
        f"{module}/talk.py": _TALK,
    }


class PythonPackageOfTwo(Rule):
    """Two packages of a workspace install a Python package of the same name, often a copy.

    **Why.** Python imports the one that comes first on its path: the programs of the other package
    run the wrong code, or end with ``ModuleNotFoundError``. With ``--merge-install`` one
    overwrites the other.

    **Fix.** Name the directory of the Python package like the ROS package, also in setup.py.

    **Source.** Python documentation, "The Module Search Path"; ``ros2 pkg create``.
    """

    code = "SP061"
    name = "python-package-of-two"
    effect = Effect.STOPS_PACKAGE
    examples = (
        Example("two names", _files("arm", "arm"), neighbors={"hand": _files("hand", "hand")}),
        Example(
            "a copy with the old directory",
            _files("arm", "hand"),
            "setup.py:5:14: hand installs a Python package 'hand' as well: Python finds one of "
            "them; rename this one to 'arm'",
            neighbors={"hand": _files("hand", "hand")},
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        misnamed = _started_roots(package) - {package.name}
        for other in package.workspace if misnamed else ():
            if other.name == package.name:
                continue
            for root in sorted(misnamed & _started_roots(other)):
                keyword = package.setup_py.keyword("packages") or package.setup_py
                message = (
                    f"{other.name} installs a Python package {root!r} as well: Python finds one of "
                    f"them; rename this one to {package.name!r}"
                )
                yield self.report(keyword, message)


def _started_roots(package: Package) -> set[str]:
    """Return the Python packages that a package installs and starts."""
    if package.build_type != "ament_python":
        return set()
    setup = package.setup_py
    packages = setup.packages
    roots = {script.module.partition(".")[0] for script in setup.console_scripts}
    roots &= own_roots(package)
    if isinstance(packages, FindPackages):
        is_plain = not packages.namespace and packages.where in {"", "."}
        return {root for root in roots if is_plain and packages.leaves_out(root) is False}
    if packages is None or isinstance(packages, Unknown):
        return set()
    return roots & {str(name).partition(".")[0] for name in packages}
