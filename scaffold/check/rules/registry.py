"""Loads rule files: each file below ``rules/<area>/`` is a rule, without registration."""

from __future__ import annotations

import os
import sys
from collections.abc import Sequence
from functools import cache
from importlib.machinery import ModuleSpec, SourceFileLoader
from types import CodeType, ModuleType

from scaffold.check.cache import rule_bytecode
from scaffold.check.rules.ament_rules import AMENT_RULES
from scaffold.check.rules.rule import Rule
from scaffold.configuration import content
from scaffold.errors import ContentError
from scaffold.files.disk import digest


def load(roots: Sequence[str]) -> list[type[Rule]]:
    """Return the rules of the content directories, sorted by code.

    Args:
        roots: The ``rules`` directories.

    Raises:
        ContentError: a file does not load, has no rule or more than one, is not named like
            its rule, or uses a code or a name again.
    """
    rules: dict[str, type[Rule]] = {}
    taken: dict[str, type[Rule]] = {}
    for rule in AMENT_RULES:
        taken[rule.code] = taken[rule.name] = rule
    own = os.path.join(content.built_in(), "rules")
    for root in roots:
        for rule in _own_rules(root) if root == own else _rules_below(root):
            other = taken.get(rule.code) or taken.get(rule.name)
            if other is not None:
                path, where = (sys.modules[kind.__module__].__file__ for kind in (rule, other))
                raise ContentError(f"{path}: {rule.code} {rule.name} is taken by {where}")
            rules[rule.code] = taken[rule.code] = taken[rule.name] = rule
    return [rules[code] for code in sorted(rules)]


def _rules_below(root: str) -> list[type[Rule]]:
    prefix = f"scaffold_content_{digest(os.fsencode(os.path.abspath(root)))[:8]}"
    files = _rule_files(root)
    codes = rule_bytecode.codes(root, [path for _, path in files], _compile)
    return [
        _load_file((prefix, *names), path, code)
        for (names, path), code in zip(files, codes, strict=True)
    ]


@cache
def _own_rules(root: str) -> list[type[Rule]]:
    """Return the rules of this installation, whose files do not change while it runs."""
    return _rules_below(root)


def _rule_files(root: str) -> list[tuple[tuple[str, ...], str]]:
    """Return the rule files, each with the names of its directories, the area first."""
    result: list[tuple[tuple[str, ...], str]] = []
    pending: list[tuple[str, ...]] = [()]
    for names in pending:
        with os.scandir(os.path.join(root, *names)) as entries:
            in_order = sorted(entries, key=lambda entry: entry.name)
        for entry in in_order:
            if entry.is_dir():
                pending.append((*names, entry.name))
            elif entry.name.endswith(".py") and not entry.name.startswith("_"):
                if not names:
                    where = f"{entry.path}: a rule is in a directory of rules/, that of its area"
                    raise ContentError(where)
                result.append((names, entry.path))
    return result


def _compile(path: str) -> CodeType:
    stem = os.path.basename(path)[:-3]
    try:
        code = SourceFileLoader(stem, path).get_code(stem)
    except Exception as error:
        raise ContentError(f"{path}: {type(error).__name__}: {error}") from error
    assert code is not None  # noqa: S101  there is a source
    return code


def _load_file(names: Sequence[str], path: str, code: CodeType) -> type[Rule]:
    stem = os.path.basename(path)[:-3]
    parent = ".".join(names)
    directory = os.path.dirname(path)
    for count in range(len(names), 0, -1):
        package = ".".join(names[:count])
        if package not in sys.modules:
            module = ModuleType(package)
            module.__path__ = [directory]
            sys.modules[package] = module
        directory = os.path.dirname(directory)
    name = f"{parent}.{stem}"
    module = ModuleType(name)
    module.__file__ = path
    module.__package__ = parent
    module.__spec__ = ModuleSpec(name, SourceFileLoader(name, path), origin=path)
    sys.modules[name] = module
    try:
        exec(code, module.__dict__)  # noqa: S102  what the loader would do
    except Exception as error:
        del sys.modules[name]
        raise ContentError(f"{path}: {type(error).__name__}: {error}") from error
    result = [
        value
        for value in vars(module).values()
        if isinstance(value, type) and issubclass(value, Rule) and value.__module__ == name
    ]
    if len(result) != 1:
        raise ContentError(f"{path}: defines {len(result)} rules; a rule file defines one")
    (rule,) = result
    missing = [key for key in ("code", "name", "examples") if not hasattr(rule, key)]
    if missing:
        raise ContentError(f"{path}: the rule has no {' and no '.join(missing)}")
    if rule.name.replace("-", "_") != stem:
        raise ContentError(f"{path}: defines the rule {rule.name!r}; file and rule share one name")
    return rule


def loaded() -> dict[str, type[Rule]]:
    """Return the rules that this process has loaded, those of the engine included, by code."""
    result: dict[str, type[Rule]] = {}
    pending: list[type[Rule]] = [Rule]
    for kind in pending:
        pending += kind.__subclasses__()
        if hasattr(kind, "code"):
            result[kind.code] = kind
    return result


def is_built_in(rule: type[Rule]) -> bool:
    """Return whether a rule comes with this tool."""
    file = sys.modules[rule.__module__].__file__ or ""
    return rule.__module__.startswith("scaffold.") or file.startswith(
        os.path.join(content.built_in(), "rules", "")
    )
