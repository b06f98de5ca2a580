"""Write scaffold/data/rosdep_keys.txt: the names that rosdep resolves.

Usage:

    python -m scripts.bundle_rosdep ROSDISTRO

``ROSDISTRO`` is a checkout of github.com/ros/rosdistro.

One line for each key of a system package, and for each package that some distribution lacks: the
name and, after a colon, the distributions that have no rule for it. Keys without any rule for
Ubuntu have no colon: they are meant for other systems.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator, Mapping
from pathlib import Path

import yaml

from scaffold.distributions import DATA, ORDER, Distribution

_SOURCES = ("base", "python", "ruby")
"""The files that rosdep reads on Ubuntu, without the ending."""
_INSTALLERS = frozenset({"apt", "gem", "pip", "snap", "source"})


def _has_rule(rule: object, codename: str) -> bool:
    """Return whether a key has a rule for a version of Ubuntu, or none for any version."""
    systems = rule if isinstance(rule, dict) else {}
    versions = systems.get("ubuntu")
    if not isinstance(versions, dict) or not _INSTALLERS.isdisjoint(versions):
        return True
    return versions.get(codename, versions.get("*")) is not None


def lacking(rosdistro: Path) -> dict[str, list[str]]:
    """Return the distributions that have no rule for a key, by key."""
    result: dict[str, list[str]] = {}
    codenames = {name: Distribution(name).fact("ubuntu") for name in ORDER}
    for source in _SOURCES:
        text = (rosdistro / "rosdep" / f"{source}.yaml").read_text(encoding="utf-8")
        for key, rule in yaml.safe_load(text).items():
            result[key] = [name for name in ORDER if not _has_rule(rule, codenames[name])]
    released = {name: packages(rosdistro, name) for name in ORDER}
    for package in set().union(*released.values()):
        without = [name for name in ORDER if package not in released[name]]
        if without and package not in result:
            result[package] = without
    return result


def packages(rosdistro: Path, distribution: str) -> set[str]:
    """Return the packages of a distribution."""
    text = (rosdistro / distribution / "distribution.yaml").read_text(encoding="utf-8")
    result: set[str] = set()
    for name, repository in yaml.safe_load(text)["repositories"].items():
        release = repository.get("release")
        if release and release.get("version"):
            result.update(release.get("packages", (name,)))
    return result


def lines(keys: Mapping[str, list[str]]) -> Iterator[str]:
    """Yield the lines of the file."""
    for key, without in sorted(keys.items()):
        yield f"{key}: {' '.join(without)}\n" if without else f"{key}\n"


if __name__ == "__main__":
    (Path(DATA) / "rosdep_keys.txt").write_text(
        "".join(lines(lacking(Path(sys.argv[1])))), encoding="utf-8"
    )
