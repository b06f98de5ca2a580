"""SP008: setup.py and package.xml have the same metadata."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import (
    Diagnostic,
    Edit,
    Effect,
    Example,
    Fix,
    Package,
    Report,
    Rule,
    Safety,
    Severity,
)
from scaffold.api.manifest import (
    Manifest,
    is_placeholder,
    is_placeholder_address,
    name_used_elsewhere,
    spdx_of,
)
from scaffold.api.setup_py import setup_edit

_MANIFEST = (
    '<package format="3">\n'
    "  <name>talker</name>\n"
    "  <version>0.2.0</version>\n"
    "  <description>Talks.</description>\n"
    '  <maintainer email="ada@example.com">Ada</maintainer>\n'
    "  <license>Apache-2.0</license>\n"
    "</package>\n"
)
_SETUP = (
    "from setuptools import setup\n\n"
    "setup(\n"
    "    name='talker',\n"
    "    version='{}',\n"
    "    maintainer='Ada',\n"
    "    maintainer_email='ada@example.com',\n"
    "    description='Talks.',\n"
    "    license='{}',\n"
    ")\n"
)
_MAX_LENGTH = 40
"""The maximum length of a text in a one-line message."""
_CONTEXT = 15
"""The number of characters to show before the first difference."""
_MANIFEST_NAME = '<package format="3"><name>talker</name></package>\n'


class MetadataDiffers(Rule):
    """Name, version, maintainer, description or license differ between setup.py and package.xml.

    **Why.** If the names differ, executables are installed under one name, and ``ros2 run``
    searches the other. Otherwise, ``ros2 pkg xml`` and ``importlib.metadata`` disagree, and
    ``catkin_prepare_release`` stops at different versions.

    **Fix.** Use the same values in both, or read package.xml in setup.py; setup.cfg and
    ``resource/`` must have the same name. No automatic fix: only the author knows which one is
    right.

    **Source.** ROS 2 documentation, "Writing a simple publisher and subscriber (Python)": "match
    exactly"; ``colcon_ros/task/ament_python/build.py``; ``catkin_pkg/package_version.py``.
    """

    code = "SP008"
    name = "metadata-differs"
    severity = Severity.WARNING
    other_severities = {Severity.ERROR: "it is the name"}
    effect = Effect.DECLARED_WRONG
    examples = (
        Example(
            "the same", {"package.xml": _MANIFEST, "setup.py": _SETUP.format("0.2.0", "Apache-2.0")}
        ),
        Example(
            "another version and another license",
            {"package.xml": _MANIFEST, "setup.py": _SETUP.format("0.1.0", "MIT")},
            "setup.py:5:13: version is '0.1.0', but '0.2.0' in package.xml, line 3; use the same "
            "value",
            "setup.py:9:13: license is 'MIT', but 'Apache-2.0' in package.xml, line 6; use the "
            "same value",
        ),
        Example(
            "long descriptions with the same beginning",
            {
                "package.xml": _MANIFEST.replace(
                    "Talks.", "Publishes greetings on a topic, ten times a second."
                ),
                "setup.py": _SETUP.format("0.2.0", "Apache-2.0").replace(
                    "Talks.", "Publishes greetings on a topic, ten times a minute."
                ),
            },
            "setup.py:8:17: description is '...c, ten times a minute.', but '...c, ten times a "
            "second.' in package.xml, line 4; use the same value",
        ),
        Example(
            "one name",
            {
                "package.xml": _MANIFEST_NAME,
                "setup.py": "from setuptools import setup\n\nsetup(name='talker')\n",
            },
        ),
        Example(
            "a name left over in a package that CMake builds",
            {
                "package.xml": _MANIFEST_NAME.replace(
                    "</package>", "<export><build_type>ament_cmake</build_type></export></package>"
                ),
                "CMakeLists.txt": "project(talker)\nfind_package(ament_cmake REQUIRED)\n"
                "ament_package()\n",
                "setup.py": "from setuptools import setup\n\nsetup(version='0.1.0')\n",
            },
        ),
        Example(
            "the name of the package that it was copied from",
            {
                "package.xml": _MANIFEST_NAME,
                "setup.py": "from setuptools import setup\n\nsetup(name='listener')\n",
            },
            Report(
                "setup.py:3:12",
                "the name is 'listener', but 'talker' in package.xml, line 1",
                unsafe_fix="Replace with talker",
                severity=Severity.ERROR,
            ),
            fixed={"setup.py": "from setuptools import setup\n\nsetup(name='talker')\n"},
        ),
        Example(
            "an extra comma after the name",
            {
                "package.xml": _MANIFEST_NAME,
                "setup.py": "from setuptools import setup\n\npackage_name = 'talker',\n\n"
                "setup(name=package_name)\n",
            },
            Report(
                "setup.py:5:12",
                "the name is a tuple, not a str: the build stops; remove the comma after it",
                severity=Severity.ERROR,
            ),
        ),
        Example(
            "no name",
            {
                "package.xml": _MANIFEST_NAME,
                "setup.py": "from setuptools import setup\n\nsetup(version='0.1.0')\n",
            },
            Report(
                "setup.py:3:1",
                "setup() has no name: nothing is installed as 'talker'; add name='talker'",
                severity=Severity.ERROR,
            ),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        yield from self._check_rest(package)
        yield from self._check_name(package)

    def _check_rest(self, package: Package) -> Iterator[Diagnostic]:
        manifest = package.manifest
        setup = package.setup_py
        for name, wanted in _expected(manifest).items():
            keyword = setup.keyword(name)
            if keyword is None or not isinstance(keyword.value, str) or not any(wanted):
                continue
            if is_placeholder(wanted[0]) or is_placeholder_address(wanted[0]):
                continue
            if _normal(keyword.value) in {_normal(item) for item in wanted}:
                continue
            if name == "license" and _means_one_of(keyword.value, wanted):
                continue
            tag = "maintainer" if name.startswith("maintainer") else name
            element = manifest.one(tag)
            line = element.location.line if element else 1
            in_setup_py, in_manifest = _short(keyword.value, wanted[0])
            message = (
                f"{name} is {in_setup_py}, but {in_manifest} in package.xml, line {line}; "
                f"use the same value"
            )
            yield self.report(keyword, message)

    def _check_name(self, package: Package) -> Iterator[Diagnostic]:
        if package.build_type == "ament_cmake":
            return  # nothing runs setup.py
        name = package.manifest.name
        keyword = package.setup_py.keyword("name")
        if keyword is None and package.setup_py.call is not None and name:
            if not _is_named_elsewhere(package):
                message = (
                    f"setup() has no name: nothing is installed as {name!r}; add name={name!r}"
                )
                yield self.report(package.setup_py, message, severity=Severity.ERROR)
            return
        if keyword is not None and isinstance(keyword.value, tuple | list):
            message = "the name is a tuple, not a str: the build stops; remove the comma after it"
            yield self.report(keyword, message, severity=Severity.ERROR)
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
            fix = Fix(f"Replace with {name}", (edit,), Safety.UNSAFE)
        at = setup.module.source.location(start, end)
        yield self.report(at, message, fix, severity=Severity.ERROR)


def _expected(manifest: Manifest) -> dict[str, list[str]]:
    """Return the values that match package.xml, by keyword."""
    maintainers = manifest.all("maintainer")
    names = [element.text for element in maintainers]
    addresses = [element.get("email") or "" for element in maintainers]
    licenses = [element.text for element in manifest.all("license")]
    return {
        "version": [manifest.version] if manifest.version.count(".") == 2 else [],  # noqa: PLR2004
        "description": [manifest.description] if manifest.description else [],
        "maintainer": _or_all(names),
        "maintainer_email": _or_all(addresses),
        "license": [*_or_all(licenses), " AND ".join(licenses), " and ".join(licenses)],
    }


def _or_all(values: list[str]) -> list[str]:
    return [*values, ", ".join(values), "; ".join(values)] if values else []


def _means_one_of(license_: str, wanted: list[str]) -> bool:
    """Return whether two spellings mean the same license."""
    identifiers = set(spdx_of(license_))
    return any(not identifiers.isdisjoint(spdx_of(item)) for item in wanted)


def _normal(text: str) -> str:
    return " ".join(text.split())


def _short(first: str, second: str) -> list[str]:
    """Return two texts for a message, shortened so that they still differ."""
    plain = [_normal(first), _normal(second)]
    pairs = enumerate(zip(*plain, strict=False))
    same = next((at for at, (left, right) in pairs if left != right), min(map(len, plain)))
    start = max(same - _CONTEXT, 0) if same > _MAX_LENGTH - _CONTEXT else 0
    return [repr(_part(text, start)) for text in plain]


def _part(text: str, start: int) -> str:
    part = f"...{text[start:]}" if start and len(text) > _MAX_LENGTH else text
    return part if len(part) <= _MAX_LENGTH else f"{part[: _MAX_LENGTH - 3]}..."


def _is_named_elsewhere(package: Package) -> bool:
    """Return whether the name may come from another file or from unknown arguments."""
    if package.setup_py.has_unknown_keywords or package.has("pyproject.toml"):
        return True
    return package.has("setup.cfg") and "[metadata]" in package.source("setup.cfg").text
