"""Writes bundled interface packages as sources that colcon can build."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from pathlib import Path

from scaffold import distributions, lazy_re
from scaffold.model.interfaces.sources import BundleSource, KnownPackage
from scaffold.model.interfaces.syntax import SECTIONS

_ALL_GENERATORS = ("rosidl_default_generators",)
_FOR_PYTHON = (
    "rosidl_cmake", "rosidl_generator_type_description", "rosidl_generator_c",
    "rosidl_typesupport_c", "rosidl_typesupport_fastrtps_c", "rosidl_typesupport_introspection_c",
    "rosidl_generator_py",
)  # fmt: skip
"""The generators that Python needs, so that less C++ is compiled."""

_OTHER_PACKAGE = lazy_re.compile(r"^([a-z][a-z0-9_]*)/[A-Z]", re.MULTILINE)

MANIFEST = """\
<?xml version="1.0"?>
<package format="3">
  <name>{name}</name>
  <version>{version}</version>
  <description>Interfaces of ROS 2 {title}.</description>
  <maintainer email="nobody@example.org">nobody</maintainer>
  <license>Apache-2.0</license>
  <buildtool_depend>ament_cmake</buildtool_depend>
  <buildtool_depend>rosidl_default_generators</buildtool_depend>
{depends}  <exec_depend>rosidl_default_runtime</exec_depend>
  <member_of_group>rosidl_interface_packages</member_of_group>
  <export>
    <build_type>ament_cmake</build_type>
  </export>
</package>
"""

CMAKE = """\
cmake_minimum_required(VERSION 3.8)
project({name})
find_package(ament_cmake REQUIRED)
{generators}{finds}rosidl_generate_interfaces(${{PROJECT_NAME}}
{files}{dependencies})
ament_export_dependencies(rosidl_default_runtime)
ament_package()
"""


class Bundle:
    """The packages whose interfaces are bundled."""

    def __init__(self) -> None:
        self._source = BundleSource()

    @property
    def content(self) -> bytes:
        """The complete content, to detect changes."""
        return Path(distributions.target().path("interfaces.txt")).read_bytes()

    def closure(self, names: Iterable[str], available: Iterable[str]) -> list[str]:
        """Return the packages to build, with their dependencies, sorted.

        Args:
            names: The wanted packages; those not in the bundle are skipped.
            available: Packages that need not be built.
        """
        installed = {*available}
        result: set[str] = set()
        waiting = [*names]
        while waiting:
            name = waiting.pop()
            package = self._source.package(name)
            if package is not None and name not in result | installed:
                result.add(name)
                waiting += self._dependencies(name, package)
        return sorted(result)

    def write(self, name: str, directory: Path, *, complete: bool) -> None:
        """Write the sources of a package to a directory that does not exist.

        Args:
            name: The package.
            directory: The directory to write to.
            complete: Whether to generate all that dependents need, not only the Python part.
        """
        package = self._source.package(name)
        if package is None:
            raise KeyError(name)
        texts = dict(self._texts(package))
        for path, text in texts.items():
            file = directory / path
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(text, encoding="utf-8")
        needed = sorted(self._dependencies(name, package))
        depends = "".join(f"  <depend>{other}</depend>\n" for other in needed)
        manifest = MANIFEST.format(
            name=name,
            title=distributions.target().title,
            version=self._version(package),
            depends=depends,
        )
        (directory / "package.xml").write_text(manifest, encoding="utf-8")
        finds = "".join(f"find_package({other} REQUIRED)\n" for other in needed)
        files = "".join(f'  "{path}"\n' for path in texts)
        dependencies = f"  DEPENDENCIES {' '.join(needed)}\n" if needed else ""
        generators = _ALL_GENERATORS if complete else _FOR_PYTHON
        lists = CMAKE.format(
            name=name,
            generators="".join(f"find_package({other} REQUIRED)\n" for other in generators),
            finds=finds,
            files=files,
            dependencies=dependencies,
        )
        (directory / "CMakeLists.txt").write_text(lists, encoding="utf-8")

    def _texts(self, package: KnownPackage) -> Iterator[tuple[str, str]]:
        for kind in SECTIONS:
            for name in package.names(kind) or ():
                text = package.text(kind, name)
                if text is not None:
                    yield f"{kind}/{name}.{kind}", text.source.text

    def _dependencies(self, name: str, package: KnownPackage) -> set[str]:
        dependencies: set[str] = set()
        for path, text in self._texts(package):
            dependencies.update(_OTHER_PACKAGE.findall(text))
            if path.endswith(".action"):
                dependencies.add("action_msgs")
        return dependencies - {name}

    def _version(self, package: KnownPackage) -> str:
        for kind in SECTIONS:
            for name in package.names(kind) or ():
                text = package.text(kind, name)
                if text is not None:
                    return text.origin.split()[1]
        return "0.0.0"
