"""The report of ``migrate``: findings per package, as text and as data."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from scaffold.check.migration import Consequences
    from scaffold.cli.migrating.origins import Origins
    from scaffold.diagnostic import Diagnostic
    from scaffold.distributions import Distribution
    from scaffold.model.package import Package

HEADINGS = ("breaks", "changes silently", "deprecated", "not examined")
COUNTED = ("break", "change silently", "deprecated")


def lines(
    consequences: Sequence[Consequences], found: Origins, target: Distribution, *, is_unsafe: bool
) -> Iterator[str]:
    """Yield the report: packages with their consequences, then the counts.

    Args:
        consequences: The remaining consequences.
        found: The origins of the packages.
        target: The target.
        is_unsafe: Whether unsafe fixes are wanted.
    """
    from scaffold.cli.migrating.origins import sentence, shares
    from scaffold.reporters.summary import count, fixable

    if not found.directories:
        yield (
            f"{sentence([*found.arrived.values()], target)}: nothing to migrate; "
            "`ros2-scaffold check` reports their findings; if they are for another one, use --from"
        )
        return

    for item in consequences:
        groups = [*zip(HEADINGS, item[1:], strict=True)]
        if not any(item[1:]):
            continue
        yield f"{item.result.package.name}:"
        for heading, diagnostics in groups:
            if diagnostics:
                yield f"  {heading}:"
                yield from (f"    {line}" for line in _folded(item.result.package, diagnostics))
    totals = [sum(len(item[at]) for item in consequences) for at in range(1, 4)]
    counts = zip(totals, COUNTED, strict=True)
    named = ", ".join(f"{number} {state}" for number, state in counts)
    every = [diagnostic for item in consequences for diagnostic in item.diagnostics]
    missed = sum(_unexamined_files(item) for item in consequences)
    nothing = "nothing changes in the examined files" if missed else "nothing changes"
    parts = [f"{shares(found)} to {target.title}: {named if every else nothing}"]
    parts += [f"{count(missed, 'file')} not examined"] if missed else []
    fixes = fixable(every, unsafe=is_unsafe)
    parts += [fixes] if fixes else []
    number = len(found.arrived) - len(found.assumed)
    if number:
        parts.append(f"{number} {'is' if number == 1 else 'are'} for {target.title} already")
    yield "; ".join(parts)


def _unexamined_files(item: Consequences) -> int:
    return len({diagnostic.location.path for diagnostic in item.unexamined})


def _folded(package: Package, diagnostics: Sequence[Diagnostic]) -> Iterator[str]:
    """Yield each message once, with its other lines by file."""
    from scaffold.printable import printable
    from scaffold.reporters import text
    from scaffold.reporters.paths import shown

    same: dict[tuple[str, str], list[Diagnostic]] = {}
    for item in diagnostics:
        same.setdefault((item.code, item.text), []).append(item)
    for first, *others in same.values():
        yield text.line(package, first)
        lines: dict[str, list[str]] = {}
        for item in others:
            lines.setdefault(item.location.path, []).append(str(item.location.line))
        for path, numbers in lines.items():
            yield f"    also {printable(shown(package, path))}:{', '.join(numbers)}"


def as_data(
    consequences: Sequence[Consequences],
    found: Origins,
    target: Distribution,
    kept: Sequence[Distribution],
) -> dict[str, object]:
    """Return the report for programs."""
    from scaffold.reporters import json

    def listed(item: Consequences, diagnostics: Sequence[Diagnostic]) -> list[dict[str, object]]:
        result = item.result._replace(diagnostics=list(diagnostics))
        return [*json.diagnostics([result], [target.name])]

    origins = {path: origin.name for origin, paths in found.directories.items() for path in paths}
    return {
        "schema_version": json.SCHEMA_VERSION,
        "from": [origin.name for origin in found.directories],
        "to": target.name,
        "keep": [distribution.name for distribution in kept],
        "packages": [
            {
                "name": item.result.package.name,
                "from": origins[item.result.package.directory],
                "breaks": listed(item, item.breaks),
                "changes": listed(item, item.changes),
                "deprecated": listed(item, item.deprecated),
                "unexamined": listed(item, item.unexamined),
            }
            for item in consequences
        ],
    }
