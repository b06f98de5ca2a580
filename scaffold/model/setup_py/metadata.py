"""The values of setup() that setuptools parses, judged by the library that it parses them with."""

from __future__ import annotations

from collections.abc import Iterator


def is_version(text: str) -> bool:
    """Return whether a text is a version of PEP 440."""
    from packaging.version import InvalidVersion, Version

    try:
        Version(text)
    except InvalidVersion:
        return False
    return True


def is_specifier(text: str) -> bool:
    """Return whether a text is a list of versions of PEP 440, which may be empty."""
    from packaging.specifiers import InvalidSpecifier, SpecifierSet

    try:
        SpecifierSet(text)
    except InvalidSpecifier:
        return False
    return True


def is_requirement(text: str) -> bool:
    """Return whether a text is a requirement of PEP 508."""
    from packaging.requirements import InvalidRequirement, Requirement

    try:
        Requirement(text)
    except InvalidRequirement:
        return False
    return True


def requirements(value: object) -> Iterator[str]:
    """Yield the known requirements in the value of a keyword, without comments."""
    if isinstance(value, dict):
        for item in value.values():
            yield from requirements(item)
    elif isinstance(value, list | tuple | str):
        lines = value.splitlines() if isinstance(value, str) else value
        plain = (line.partition(" #")[0].strip() for line in lines if isinstance(line, str))
        yield from (line for line in plain if line and not line.startswith("#"))
