"""The documentation of a rule as text, for the terminal and for ``docs/rules``."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from inspect import cleandoc
from typing import TYPE_CHECKING

from scaffold.check.rules.rule import Example, Report, Rule
from scaffold.check.selection import area_prefixes
from scaffold.diagnostic import Severity
from scaffold.distributions import DEFAULT
from scaffold.edits import Safety

if TYPE_CHECKING:
    from scaffold.ament.codes import AmentCode

_LANGUAGES = {
    ".xml": "xml",
    ".urdf": "xml",
    ".xacro": "xml",
    ".py": "python",
    ".txt": "cmake",
    ".cfg": "ini",
    ".yaml": "yaml",
}

_FIXED_WITH: dict[Safety | None, str] = {
    Safety.SAFE: " · fixable with `--fix`",
    Safety.UNSAFE: " · fixable with `--fix --unsafe-fixes`",
}

_PLUGINS = {
    "A": "flake8-builtins",
    "B": "flake8-blind-except",
    "C": "flake8-comprehensions",
    "CNL": "flake8-class-newline",
    "D": "pydocstyle",
    "D0": "flake8-deprecated",
    "E": "pycodestyle",
    "F": "pyflakes",
    "I": "flake8-import-order",
    "Q": "flake8-quotes",
    "W": "pycodestyle",
}
"""The plugins of style codes by prefix; the longest decides."""
_STYLE_HEAD = """\
## Python style and docstrings

The codes of flake8 and pydocstyle that ament_flake8 and ament_pep257 report."""


def summary(rule: type[Rule]) -> str:
    """Return the first line of a rule's docstring, as plain Markdown."""
    return cleandoc(rule.__doc__ or "").partition("\n")[0].rstrip(".").replace("``", "`")


def page(rule: type[Rule]) -> str:
    """Return the documentation of a rule as Markdown."""
    text = cleandoc(rule.__doc__ or "").replace("``", "`")
    facts = (
        f"Severity: {_severity(rule)} · since {rule.since}{_FIXED_WITH.get(rule.fix_safety(), '')}"
    )
    parts = [f"# {rule.code} {rule.name}", facts, text]
    rejected = [example for example in rule.examples if example.reports]
    accepted = [example for example in rule.examples if not example.reports]
    if rejected:
        parts += ["## Reported", *(_example(rule, example) for example in rejected[:2])]
    if accepted:
        parts += ["## Accepted", *(_example(rule, example) for example in accepted[:1])]
    return "\n\n".join(parts) + "\n"


def style_page(style: AmentCode) -> str:
    """Return the documentation of a code of flake8 or pydocstyle as Markdown."""
    facts = f"Severity: {style.severity.value} · reported by {' and '.join(linters(style))}"
    facts += _FIXED_WITH.get(style.fix, "")
    return f"# {style.code} {style.name}\n\n{facts}\n\n{style_text(style)}\n"


def style_text(style: AmentCode) -> str:
    """Return the description and the origin of a code of flake8 or pydocstyle, as Markdown."""
    text = style.summary[0].upper() + style.summary[1:]
    plugin = max((start for start in _PLUGINS if style.code.startswith(start)), key=len)
    source = f"{_PLUGINS[plugin]}, as {linters(style)[0]} runs it"
    if style.is_optional:
        source += " if the package configures it to report this code"
    return f"{text}.\n\n**Source.** {source}."


def linters(row: AmentCode) -> tuple[str, ...]:
    """Return the names of the linters of ament that report a code."""
    from scaffold.ament.codes import LINTERS

    return tuple(name for flag, name in LINTERS.items() if row.linters & flag)


def as_data(rule: type[Rule]) -> dict[str, object]:
    """Return the metadata of a rule as data."""
    return {
        "code": rule.code,
        "name": rule.name,
        "severity": rule.severity.value,
        "since": rule.since,
        "fixable": has_fix(rule),
        "summary": summary(rule),
    }


def write(directory: str, rules: Sequence[type[Rule]]) -> None:
    """Write a page per code and tables of all; remove pages of codes that no longer exist."""
    import os

    from scaffold.ament.codes import STYLE

    os.makedirs(directory, exist_ok=True)
    pages = {f"{rule.code}.md": page(rule) for rule in rules}
    pages |= {f"{code}.md": style_page(style) for code, style in STYLE.items()}
    styles = _rows(
        (item.code, item.name, item.severity, item.fix, item.summary) for item in STYLE.values()
    )
    pages["README.md"] = f"# Rules\n\n{_by_area(rules)}\n\n{_STYLE_HEAD}\n\n{styles}\n"
    for name in os.listdir(directory):
        if name.endswith(".md") and name not in pages:
            os.remove(os.path.join(directory, name))
    for name, text in pages.items():
        with open(os.path.join(directory, name), "w", encoding="utf-8") as file:
            file.write(text)


def _by_area(rules: Sequence[type[Rule]]) -> str:
    """Return a table for each area, under its name as `--select` takes it."""
    tables: dict[str, list[type[Rule]]] = {}
    for rule in rules:
        tables.setdefault(rule.code[:2], []).append(rule)
    areas = area_prefixes(rules)
    headings = {area: tables.pop(prefix) for area, prefix in sorted(areas.items())}
    headings["The check itself"] = [rule for rest in tables.values() for rule in rest]
    return "\n\n".join(f"## {area}\n\n{table(listed)}" for area, listed in headings.items())


def table(rules: Sequence[type[Rule]]) -> str:
    """Return a Markdown table of rules."""
    return _rows(
        (rule.code, rule.name, rule.severity, rule.fix_safety(), summary(rule)) for rule in rules
    )


def _rows(rows: Iterable[tuple[str, str, Severity, Safety | None, str]]) -> str:
    lines = [
        f"| [{code}]({code}.md) | {name} | {severity.value} | {'yes' if fix else ''} | {summary} |"
        for code, name, severity, fix, summary in rows
    ]
    return "\n".join(["| code | name | severity | fix | what |", "|---|---|---|---|---|", *lines])


def has_fix(rule: type[Rule]) -> bool:
    """Return whether a rule can fix what it reports."""
    return rule.fix_safety() is not None


def _severity(rule: type[Rule]) -> str:
    others = [f"{severity.value} if {why}" for severity, why in rule.other_severities.items()]
    if rule.release_refused:
        others.append(f"error with `--release`: {rule.release_refused}")
    return "; ".join([rule.severity.value, *others])


def _example(rule: type[Rule], example: Example) -> str:
    target = "" if example.distro == DEFAULT else f", for {example.distro.capitalize()}"
    parts = [f"*{example.title}{target}*"]
    for path, text in example.files.items():
        parts.append(f"`{path}`:")
        if text:
            parts.append(f"```{_language(path)}\n{text.rstrip()}\n```")
    if example.reports:
        lines = "\n".join(_report(rule, report) for report in example.reports)
        parts += ["What is reported:", f"```text\n{lines}\n```"]
    return "\n\n".join(parts)


def _report(rule: type[Rule], report: Report) -> str:
    severity = report.severity or rule.severity
    return f"{report.at}: {severity.value} {rule.code} {report.message} [{rule.name}]"


def _language(path: str) -> str:
    return next((name for ending, name in _LANGUAGES.items() if path.endswith(ending)), "text")
