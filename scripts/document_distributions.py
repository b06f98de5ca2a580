"""Write docs/distributions from the data of each distribution.

``python scripts/document_distributions.py [DIRECTORY]``; ``make docs`` calls it.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path

from scaffold import changes, distributions
from scaffold.changes import Change
from scaffold.check.rules import docs, registry
from scaffold.configuration import content
from scaffold.distributions import ALIASES, DEFAULT, ORDER, Distribution, named
from scaffold.model.rclpy.api import names_of

DOCS = Path(__file__).parent.parent / "docs" / "distributions"
FIXED = frozenset({"ament_target_dependencies", "static_transform_publisher", "ros2 bag record"})
"""Codes fixed by separate rules."""
KINDS = ("name", "call", "command", "launch", "option", "executable", "interface", "package")
_LISTED = 30
"""The maximum number of names of a change with separate lines."""
_INTRODUCTION = """\
# Distributions

`check --distro NAME` checks packages for a distribution, `migrate --to NAME` moves them to one.
`make docs` writes these pages from the data that both use.

| | supported | Python | CMake | NumPy | setuptools | rclpy |
|---|---|---|---|---|---|---|
"""


def main(directory: Path) -> int:
    """Write the pages."""
    directory.mkdir(exist_ok=True)
    rows = "".join(f"{_row(named(name))}\n" for name in ORDER)
    aliases = "".join(
        f"\n{name.capitalize()} is checked like [{of.capitalize()}]({of}.md): for Python packages "
        "they are the same so far.\n"
        for name, of in ALIASES.items()
    )
    (directory / "README.md").write_text(f"{_INTRODUCTION}{rows}{aliases}")
    for name in ORDER:
        (directory / f"{name}.md").write_text("\n".join(_page(named(name))) + "\n")
    return 0


def _row(distro: Distribution) -> str:
    facts = ("support", "python", "cmake", "numpy", "setuptools", "rclpy")
    cells = [
        f"[{distro.title}]({distro.name}.md)",
        *(str(distro.fact(fact)) for fact in facts),
    ]
    return f"| {' | '.join(cells)} |"


def _page(distro: Distribution) -> Iterator[str]:
    yield f"# {distro.title}"
    yield ""
    facts = ("CMake", "NumPy", "setuptools", "rclpy")
    versions = ", ".join(f"{fact} {distro.fact(fact.lower())}" for fact in facts)
    yield f"Supported {distro.fact('support')}; Python {distro.python_version}, {versions}."
    yield ""
    yield from _build(distro)
    yield from _linters(distro)
    with distributions.targeting(distro):
        yield from _table("Removed", [item for item in _changes() if item.is_removed])
        yield from _table("Deprecated", [item for item in _changes() if item.is_deprecated])
    changed = [item for item in _changes() if item.changed and distro.place >= item.changed.place]
    yield from _table("Changed", changed)
    yield from _rules(distro)
    yield from _interfaces(distro)
    yield from _members(distro)


def _build(distro: Distribution) -> Iterator[str]:
    stops = distro.fact("build.cmake_minimum_error_below")
    if stops:
        warns = distro.fact("build.cmake_minimum_warning_below")
        yield f"- CMake stops at a `cmake_minimum_required` below {stops}, and warns below {warns}."
    both = distro.fact("build.package_may_be_installed_twice")
    yield (
        "- A package may generate interfaces and install a Python package of its own name."
        if both
        else "- Interfaces and a Python package of the same name are packages of their own."
    )
    extra = distro.fact("wheels.extra")
    if extra:
        yield (
            "- There are wheels for Python, which need no installation of ROS 2: the extra "
            f"`{extra}`."
        )
    yield from (f"- {line}" for line in _templates(distro))
    yield ""


def _templates(distro: Distribution) -> Iterator[str]:
    """Yield the code of `new` that differs between distributions."""
    if distro.fact("templates.has_init_block"):
        yield "`new` writes `with rclpy.init():`: the end of the block disconnects."
    else:
        yield "`new` writes `rclpy.init()` and, in `finally`, `rclpy.try_shutdown()`."
    if distro.fact("templates.is_typed"):
        yield (
            "`new` writes `py.typed` and a test with ament_xmllint into packages of ament_python, "
            "as `ros2 pkg create` does; it leaves out a test with ament_mypy, and the annotations "
            "of tests that this reads: rclpy's own do not pass it."
        )
    variables = distro.fact("templates.only_here").items()
    settings = ", ".join(f"`{name}={value}`" for name, value in variables)
    yield f"Tests that `new` writes stay on their machine by {settings}."


def _linters(distro: Distribution) -> Iterator[str]:
    versions = ", ".join(f"{name} {version}" for name, version in distro.fact("linters").items())
    yield "## Linters"
    yield ""
    yield f"The style verdict is that of {versions}."
    yield ""
    if "flake8-docstrings" not in distro.fact("linters"):
        yield "- Docstrings are judged by ament_pep257 alone: flake8 has no plugin for them."
    unknown = distro.fact("copyright.unknown_licenses")
    if unknown:
        names = ", ".join(f"`{name}`" for name in unknown)
        yield f"- ament_copyright does not know the license {names} any more."
    if distro.fact("copyright.is_case_sensitive"):
        yield "- ament_copyright reads notices in line comments, with a capital `Copyright`."
    yield ""


def _changes() -> Iterator[Change]:
    for kind in KINDS:
        yield from changes.of_kind(kind)


def _table(title: str, listed: list[Change]) -> Iterator[str]:
    if not listed:
        return
    yield f"## {title}"
    yield ""
    yield "| name | since | what to do | fixed | decided in |"
    yield "|---|---|---|---|---|"
    for item in listed:
        first = item.removed if title == "Removed" else item.deprecated or item.changed
        since = first.title if first is not None else ""
        instead = f"`{item.use}`" if item.use else item.advice
        if item.use == "*":
            instead = "the rest of the name"
        is_new = item.since.name != changes.EARLIEST and item.changed is None
        later = f" (from {item.since.title} on)" if is_new else ""
        has_fix = item.use and item not in changes.of_kind("executable")
        fixed = "yes" if has_fix or item.names[0] in FIXED else ""
        separator = "<br>" if len(item.names) <= _LISTED else ", "
        names = separator.join(f"`{name}`" for name in item.names)
        yield f"| {names} | {since} | {instead}{later} | {fixed} | {item.source} |"
    yield ""


def _rules(distro: Distribution) -> Iterator[str]:
    """Yield the rules with examples for a distribution; those of the default are all others."""
    rules = [
        rule
        for rule in registry.load(content.roots("rules"))
        if any(item.distro == distro.name and item.reports for item in rule.examples)
    ]
    if not rules or distro.name == DEFAULT:
        return
    yield f"## Rules with examples for {distro.title}"
    yield ""
    for rule in rules:
        yield f"- [{rule.code}](../rules/{rule.code}.md) {docs.summary(rule)}"
    yield ""


def _interfaces(distro: Distribution) -> Iterator[str]:
    """Yield the interfaces that differ from those of the default distribution."""
    base, own = _definitions(named(DEFAULT)), _definitions(distro)
    gone, added = sorted(base.keys() - own.keys()), sorted(own.keys() - base.keys())
    other = sorted(name for name in base.keys() & own.keys() if base[name] != own[name])
    packages = sorted({name.partition("/")[0] for name in (*gone, *added, *other)})
    if not packages:
        return
    yield f"## Interfaces, compared with {DEFAULT.capitalize()}"
    yield ""
    title = distro.title
    yield f"| package | not in {title} | only in {title} | other fields and constants |"
    yield "|---|---|---|---|"
    for package in packages:
        cells = [
            ", ".join(f"`{name.partition('/')[2]}`" for name in names if _is_of(name, package))
            for names in (gone, added)
        ]
        fields = [
            f"`{name.partition('/')[2]}`: {_fields(base[name], own[name])}"
            for name in other
            if _is_of(name, package)
        ]
        yield f"| {package} | {' | '.join(cells)} | {'<br>'.join(fields)} |"


def _is_of(name: str, package: str) -> bool:
    return name.startswith(f"{package}/")


def _fields(base: str, own: str) -> str:
    """Return the added and removed fields of an interface."""
    before, after = base.splitlines(), own.splitlines()
    more = [line for line in after if line not in before]
    less = [line for line in before if line not in after]
    parts = [f"has {_joined(more)}"] * bool(more) + [f"lacks {_joined(less)}"] * bool(less)
    return ", ".join(parts) or "another order"


def _members(distro: Distribution) -> Iterator[str]:
    """Yield the differences of the public members of rclpy from the previous distribution."""
    before = named(ORDER[max(ORDER.index(distro.name) - 1, 0)])
    old, new = _public(before), _public(distro)
    lines: list[str] = []
    for class_ in sorted(old.keys() | new.keys()):
        added = sorted(new.get(class_, set()) - old.get(class_, set()))
        gone = sorted(old.get(class_, set()) - new.get(class_, set()))
        if class_ not in old:
            if not _is_name(before, class_):
                lines.append(f"- `{class_}` is new")
        elif class_ not in new:
            if not _is_name(distro, class_):
                lines.append(f"- `{class_}` is gone")
        elif added or gone:
            changes_ = [f"has {_joined(added)}"] * bool(added)
            changes_ += [f"lacks {_joined(gone)}"] * bool(gone)
            lines.append(f"- `{class_}` {', '.join(changes_)}")
    if lines:
        yield ""
        yield f"## Classes of rclpy, compared with {before.title}"
        yield ""
        yield from lines


def _is_name(distro: Distribution, class_: str) -> bool:
    """Return whether a module has a name that another distribution has as a class."""
    module, _, name = class_.rpartition(".")
    return name in names_of(distro).get(module, ())


def _joined(names: list[str]) -> str:
    return ", ".join(f"`{name}`" for name in names)


def _public(distro: Distribution) -> dict[str, set[str]]:
    return {
        name: {member for member in members if not member.startswith("_")}
        for name, members in names_of(distro).items()
        if name.startswith("rclpy.") and name.rpartition(".")[2][:1].isupper()
    }


def _definitions(distro: Distribution) -> dict[str, str]:
    result: dict[str, str] = {}
    text = Path(distro.path("interfaces.txt")).read_text()
    for chunk in text.split("\n@ ")[1:]:
        head, *definitions = chunk.rstrip("\n").split("\n= ")
        for definition in definitions:
            title, _, fields = definition.partition("\n")
            result[f"{head.partition(' ')[0]}/{title.replace(' ', '/')}"] = fields.rstrip("\n")
    return result


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1]) if sys.argv[1:] else DOCS))
