"""IM043: two modules do not import names from each other."""

from __future__ import annotations

from collections.abc import Iterator

from scaffold.api import Diagnostic, Example, Package, Rule, fact
from scaffold.api.python import Import, imports_by_path

_FILES = {"talker/__init__.py": "", "talker/text.py": "TEXT = ''\n"}


class CircularImport(Rule):
    """Two modules import names from each other at module level.

    **Why.** The second one is not complete when the first imports from it: ``ImportError: cannot
    import name 'Talker' from partially initialized module``.

    **Fix.** Move what both need to a third module.

    **Source.** Python documentation, FAQ: "What are the best practices for using import in a
    module".
    """

    code = "IM043"
    name = "circular-import"
    examples = (
        Example("one direction", {**_FILES, "talker/node.py": "from talker.text import TEXT\n"}),
        Example(
            "both directions",
            {
                "talker/__init__.py": "",
                "talker/text.py": "from talker.node import NODE\n\nTEXT = ''\n",
                "talker/node.py": "from talker.text import TEXT\n\nNODE = 1\n",
            },
            "talker/node.py:1:1: circular import: talker/text.py:1 imports from this module, too: "
            "ImportError; move the common names to a third module",
            "talker/text.py:1:1: circular import: talker/node.py:1 imports from this module, too: "
            "ImportError; move the common names to a third module",
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        edges: dict[tuple[str, str], Import] = {}
        for where, imports in imports_by_path(package):
            for item in imports:
                if item.top_level and item.names and not item.guarded:
                    path = _file_of(package, where, item)
                    if path and path != where:
                        edges.setdefault((where, path), item)
        for (path, other), item in edges.items():
            back = edges.get((other, path))
            if back is None or not _takes_names(package, item, other):
                continue
            if _takes_names(package, back, path):
                message = (
                    f"circular import: {other}:{back.location.line} imports from this module, "
                    f"too: ImportError; move the common names to a third module"
                )
                yield self.report(item, message)


def _takes_names(package: Package, node: Import, path: str) -> bool:
    """Return whether an import needs names that the module defines after its own imports."""
    late = _late_names(package, path)
    return any(name.name in late for name in node.names)


@fact
def _late_names(package: Package, path: str) -> frozenset[str]:
    """Return the names that a module defines after its own imports."""
    module = package.module(path)
    last = max((other.location.line for other in module.imports if other.top_level), default=0)
    return frozenset(
        name
        for name, bindings in module.index.bindings(module.tree).items()
        for binding in bindings
        if binding.kind != "import" and getattr(binding.node, "lineno", 0) > last
    )


def _file_of(package: Package, where: str, node: Import) -> str:
    parts = node.module.split(".") if node.module else []
    if node.level:
        parts = [*where.split("/")[: -node.level], *parts]
    base = "/".join(parts)
    return next((path for path in (f"{base}.py", f"{base}/__init__.py") if package.has(path)), "")
