"""SP009: setup.py and package.xml name the same package."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Edit, Example, Fix, Package, Report, Rule, Safety
from scaffold.api.manifest import name_used_elsewhere
from scaffold.api.setup_py import setup_edit

_MANIFEST = '<package format="3"><name>talker</name></package>\n'


class NameDiffers(Rule):
    """The name in setup.py is not the name in package.xml.

    **Why.** Executables land below the one name and ``ros2 run`` looks below the other.

    **Fix.** Use one name in setup.py, setup.cfg, ``resource/`` and package.xml.

    **Source.** ``colcon_ros/task/ament_python/build.py``; ROS 2 documentation, "Creating a
    package".
    """

    code = "SP009"
    name = "name-differs"
    examples = (
        Example(
            "one name",
            {
                "package.xml": _MANIFEST,
                "setup.py": "from setuptools import setup\n\nsetup(name='talker')\n",
            },
        ),
        Example(
            "left over in a package that CMake builds",
            {
                "package.xml": _MANIFEST.replace(
                    "</package>", "<export><build_type>ament_cmake</build_type></export></package>"
                ),
                "CMakeLists.txt": "project(talker)\nfind_package(ament_cmake REQUIRED)\n"
                "ament_package()\n",
                "setup.py": "from setuptools import setup\n\nsetup(version='0.1.0')\n",
            },
        ),
        Example(
            "copied from another package",
            {
                "package.xml": _MANIFEST,
                "setup.py": "from setuptools import setup\n\nsetup(name='listener')\n",
            },
            Report(
                "setup.py:3:12",
                "the name is 'listener', but 'talker' in package.xml, line 1",
                unsafe_fix="write talker",
            ),
            fixed={"setup.py": "from setuptools import setup\n\nsetup(name='talker')\n"},
        ),
        Example(
            "a comma too many",
            {
                "package.xml": _MANIFEST,
                "setup.py": "from setuptools import setup\n\npackage_name = 'talker',\n\n"
                "setup(name=package_name)\n",
            },
            Report(
                "setup.py:5:12",
                "the name is a tuple, not a str: the build stops; remove the comma after it",
            ),
        ),
        Example(
            "no name",
            {
                "package.xml": _MANIFEST,
                "setup.py": "from setuptools import setup\n\nsetup(version='0.1.0')\n",
            },
            Report(
                "setup.py:3:1",
                "setup() has no name: nothing is installed as 'talker'; add name='talker'",
            ),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        if package.build_type == "ament_cmake":
            return  # nothing runs setup.py
        name = package.manifest.name
        keyword = package.setup_py.keyword("name")
        if keyword is None and package.setup_py.call is not None and name:
            if not _is_named_elsewhere(package):
                message = (
                    f"setup() has no name: nothing is installed as {name!r}; add name={name!r}"
                )
                yield self.report(package.setup_py, message)
            return
        if keyword is not None and isinstance(keyword.value, tuple | list):
            message = "the name is a tuple, not a str: the build stops; remove the comma after it"
            yield self.report(keyword, message)
        if keyword is None or not isinstance(keyword.value, str) or not name:
            return
        if keyword.value.replace("-", "_") == name.replace("-", "_") or name_used_elsewhere(
            package
        ):
            return
        setup = package.setup_py
        line = package.manifest.all("name")[0].location.line
        message = f"the name is {keyword.value!r}, but {name!r} in package.xml, line {line}"
        start, end = setup_edit.literal_span(setup, keyword)
        fix = None
        if setup.module.source.text[start + 1 : end - 1] == keyword.value:
            edit = Edit("setup.py", start + 1, end - 1, name)
            fix = Fix(f"write {name}", (edit,), Safety.UNSAFE)
        yield self.report(setup.module.source.location(start, end), message, fix)


def _is_named_elsewhere(package: Package) -> bool:
    """Tell whether the name may come from another file, or from arguments that are not known."""
    if package.setup_py.has_unknown_keywords or package.has("pyproject.toml"):
        return True
    return package.has("setup.cfg") and "[metadata]" in package.source("setup.cfg").text
