"""Which areas of the built-in rules a package gives no occasion for.

`new` asks about what it has rendered, so as not to load rules that cannot speak.
"""

from __future__ import annotations

from scaffold.files.tree import SETUP_CFG, SETUP_PY
from scaffold.model.package import Package


def silent(package: Package) -> frozenset[str]:
    """Return the areas of which no rule can find anything in a package in memory.

    The rules of ``setup_py`` read setup.py or setup.cfg. Those of ``launch`` look at files that
    import launch or launch_ros, or have ``launch`` in their names; those of ``parameters`` at
    YAML files, and at the parameters in such launch files. Where something is suppressed, all
    rules have to run, to tell whether it is used.
    """
    texts = [package.tree.read(path) for path in package.files]
    if any(b"noqa" in text for text in texts):
        return frozenset()
    found: set[str] = set()
    if not package.has(SETUP_PY) and not package.has(SETUP_CFG):
        found.add("setup_py")
    if not any(b"launch" in text for text in texts) and "launch" not in "\n".join(package.files):
        found.add("launch")
        if not any(path.endswith((".yaml", ".yml")) for path in package.files):
            found.add("parameters")
    return frozenset(found)
