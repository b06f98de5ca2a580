"""Write scaffold/data/dependencies.txt: the dependencies of each released package.

Usage:

    python -m scripts.bundle_dependencies RECIPES ROSDEP

``RECIPES`` is a checkout of github.com/ros/meta-ros, whose recipes are generated from the
package.xml of every released package: they list its dependencies by kind. They name non-ROS
packages as in OpenEmbedded; the rules of ``ROSDEP``, a checkout of
github.com/ros/rosdistro, translate that back. Only Python keys are kept of those.

One line for each package: its name, a colon, and its run-time and exported dependencies.
Distributions with differences have separate lines, with their names before the colon.
"""

from __future__ import annotations

import re
import sys
from collections.abc import Iterator, Mapping
from pathlib import Path

import yaml

from scaffold.distributions import DATA, ORDER

_LIST = re.compile(
    r"^ROS_(?:EXPORT|BUILDTOOL_EXPORT|EXEC)_DEPENDS = \"([^\"]*)\"", flags=re.MULTILINE
)
_NAME = re.compile(r"^ROS_BPN = \"([^\"]+)\"", flags=re.MULTILINE)


def python_keys(rosdep: Path) -> dict[str, str]:
    """Return the keys of Python packages by their names in OpenEmbedded."""
    result: dict[str, str] = {}
    rules = yaml.safe_load((rosdep / "rosdep" / "python.yaml").read_text(encoding="utf-8"))
    for key, systems in rules.items():
        names = systems.get("openembedded", ()) if key.startswith("python3-") else ()
        for name in names if isinstance(names, list) else ():
            result.setdefault(name.partition("@")[0], key)
    return result


def released(recipes: Path, keys: Mapping[str, str]) -> dict[str, str]:
    """Return the dependencies of the packages of one distribution."""
    texts = [path.read_text(encoding="utf-8") for path in recipes.rglob("*.bb")]
    named = {match[1]: text for text in texts if (match := _NAME.search(text))}
    keys = {**keys, **{name.replace("_", "-"): name for name in named}}
    result = {}
    for name, text in named.items():
        written = " ".join(_LIST.findall(text)).replace("\\", "").split()
        brought = {keys.get(item.removesuffix("-native"), name) for item in written} - {name}
        result[name] = " ".join(sorted(brought))
    return result


def lines(distributions: Mapping[str, Mapping[str, str]]) -> Iterator[str]:
    """Yield the lines of the file."""
    for name in sorted(set().union(*distributions.values())):
        places: dict[str, list[str]] = {}
        for distribution, packages in distributions.items():
            if name in packages:
                places.setdefault(packages[name], []).append(distribution)
        usual = max(places, key=lambda brought: len(places[brought]))
        yield f"{name}: {usual}".rstrip() + "\n"
        for brought, where in places.items():
            if brought != usual:
                yield f"{name} {' '.join(where)}: {brought}".rstrip() + "\n"


if __name__ == "__main__":
    checkout, rosdep = map(Path, sys.argv[1:])
    keys = python_keys(rosdep)
    every = {
        name: released(checkout / f"meta-ros2-{name}" / "generated-recipes", keys) for name in ORDER
    }
    (Path(DATA) / "dependencies.txt").write_text("".join(lines(every)), encoding="utf-8")
