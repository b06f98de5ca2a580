"""SP008: setup.py and package.xml say the same."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Report, Rule, Severity
from scaffold.api.manifest import Manifest, is_placeholder, is_placeholder_address, spdx_of

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


class MetadataDiffers(Rule):
    """Version, maintainer, description or license differ between setup.py and package.xml.

    **Why.** ``ros2 pkg xml`` and ``importlib.metadata`` then tell different things;
    ``catkin_prepare_release`` stops at two versions.

    **Fix.** Write the same in both, or read package.xml in setup.py. No automatic fix: only
    the author knows which one is right.

    **Source.** ROS 2 documentation, "Writing a simple publisher and subscriber (Python)": "match
    exactly"; ``catkin_pkg/package_version.py``.
    """

    code = "SP008"
    name = "metadata-differs"
    severity = Severity.WARNING
    examples = (
        Example(
            "the same", {"package.xml": _MANIFEST, "setup.py": _SETUP.format("0.2.0", "Apache-2.0")}
        ),
        Example(
            "another version and another license",
            {"package.xml": _MANIFEST, "setup.py": _SETUP.format("0.1.0", "MIT")},
            Report("setup.py:5:13", "version is '0.1.0', but '0.2.0' in package.xml, line 3"),
            Report("setup.py:9:13", "license is 'MIT', but 'Apache-2.0' in package.xml, line 6"),
        ),
        Example(
            "long descriptions that begin with the same words",
            {
                "package.xml": _MANIFEST.replace(
                    "Talks.", "Publishes greetings on a topic, ten times a second."
                ),
                "setup.py": _SETUP.format("0.2.0", "Apache-2.0").replace(
                    "Talks.", "Publishes greetings on a topic, ten times a minute."
                ),
            },
            Report(
                "setup.py:8:17",
                "description is '...c, ten times a minute.', but '...c, ten times a "
                "second.' in package.xml, line 4",
            ),
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
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
            here, there = _short(keyword.value, wanted[0])
            message = f"{name} is {here}, but {there} in package.xml, line {line}"
            yield self.report(keyword, message)


def _expected(manifest: Manifest) -> dict[str, list[str]]:
    """Return what package.xml allows for each keyword."""
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
    """Tell whether two spellings mean the same license."""
    identifiers = set(spdx_of(license_))
    return any(not identifiers.isdisjoint(spdx_of(item)) for item in wanted)


def _normal(text: str) -> str:
    return " ".join(text.split())


_LONGEST = 40
"""Characters of a text in a message: it is for one line."""
_CONTEXT = 15
"""Characters before the first difference, where the beginnings are the same."""


def _short(first: str, second: str) -> list[str]:
    """Return two texts for a message, cut so that they differ."""
    plain = [_normal(first), _normal(second)]
    pairs = enumerate(zip(*plain, strict=False))
    same = next((at for at, (left, right) in pairs if left != right), min(map(len, plain)))
    start = max(same - _CONTEXT, 0) if same > _LONGEST - _CONTEXT else 0
    return [repr(_part(text, start)) for text in plain]


def _part(text: str, start: int) -> str:
    part = f"...{text[start:]}" if start and len(text) > _LONGEST else text
    return part if len(part) <= _LONGEST else f"{part[: _LONGEST - 3]}..."
