"""Write ``docs/api.md``: every name that a rule may import, with a line of a rule that uses it.

``python scripts/document_api.py [FILE]``; ``make docs`` calls it.
"""

from __future__ import annotations

import ast
import inspect
import re
import sys
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path
from types import GenericAlias, ModuleType
from typing import TypeGuard

from scaffold import api

ROOT = Path(__file__).parent.parent
INTRODUCTION = f"""\
# The interface of rules

A rule imports `scaffold.api` and its submodules, and nothing else of the engine; ruff checks this
for the rules of this repository. This page is version {api.VERSION} of the interface. The number
grows when a name is removed or changes its meaning; new names do not change it. `make docs` writes
this page from the code; each example is a line of one of our rules.
"""


def main(target: Path) -> int:
    """Write the page."""
    names = sorted(path.stem for path in Path(str(api.__file__)).parent.glob("[a-z]*.py"))
    modules = [api, *(import_module(f"scaffold.api.{name}") for name in names)]
    target.write_text("\n".join([INTRODUCTION, *(_section(module) for module in modules)]))
    return 0


def _section(module: ModuleType) -> str:
    lines = [f"## `{module.__name__}`", "", (module.__doc__ or "").strip(), ""]
    for name in sorted({*module.__all__} - {"VERSION"}, key=lambda name: (name.lower(), name)):
        lines += _entry(module, name)
    return "\n".join(lines)


def _entry(module: ModuleType, name: str) -> Iterator[str]:
    value = getattr(module, name)
    yield f"### `{name}{_signature(value)}`"
    yield ""
    is_alias = isinstance(value, GenericAlias)  # whose documentation is that of tuple
    documented = (callable(value) and not is_alias) or inspect.ismodule(value)
    summary = inspect.cleandoc(value.__doc__ or "").partition("\n\n")[0] if documented else ""
    if summary:
        yield summary.replace("``", "`")
        yield ""
    example = _example(module.__name__, name)
    if example:
        path, line = example
        yield f"[`{path}`](../{path}):"
        yield f"\n```python\n{line}\n```\n"


def _signature(value: object) -> str:
    if not inspect.isfunction(value):
        return ""
    return str(inspect.signature(value)).replace("'", "")


def _example(module: str, name: str) -> tuple[str, str] | None:
    """Return the shortest rule that imports a name from a module, and the line that uses it."""
    statement = rf"from {re.escape(module)} import (\([^)]*\b{name}\b|[^\n(]*\b{name}\b)"
    files = sorted((ROOT / "rules").glob("*/**/*.py"), key=lambda path: path.stat().st_size)
    cut = None  # a use that continues on the next line
    for path in files:
        text = path.read_text(encoding="utf-8")
        if not re.search(statement, text):
            continue
        lines = text.splitlines()
        uses = sorted(node.lineno for node in ast.walk(ast.parse(text)) if _is_use(node, name))
        for use in (lines[number - 1].strip() for number in uses):
            example = path.relative_to(ROOT).as_posix(), use
            if not use.endswith("("):
                return example
            cut = cut or example
    return cut


def _is_use(node: ast.AST, name: str) -> TypeGuard[ast.Name]:
    return isinstance(node, ast.Name) and node.id == name


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1]) if sys.argv[1:] else ROOT / "docs" / "api.md"))
