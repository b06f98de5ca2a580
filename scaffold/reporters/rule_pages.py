"""The documentation of the rules behind some findings, and where it is."""

from __future__ import annotations

from collections.abc import Iterable
from functools import cache
from inspect import cleandoc

from scaffold.diagnostic import Severity
from scaffold.record import NamedTuple

DISTRIBUTION = "ros2-scaffold"
"""The name under which the tool is installed."""
_LABELS = ("repository", "source", "sourcecode", "github", "homepage")
"""What the address of the repository may be called in the metadata, as indexes read labels."""


class RulePage(NamedTuple):
    """A rule, or a code of ament's linters, as its page describes it."""

    code: str
    name: str
    severity: Severity
    summary: str
    """What it reports, without Markdown."""
    markdown: str
    """The summary again, **Why.**, **Fix.** and **Source.**."""
    linters: tuple[str, ...]
    """The linters of ament that report the code."""
    url: str | None
    """The address of the page."""


def of(codes: Iterable[str]) -> dict[str, RulePage]:
    """Return the pages of codes that rules of this process report, by code in alphabetic order.

    A rule has a URL if it comes with this tool and the metadata of the tool name a repository.
    """
    from scaffold.ament.codes import CODES, STYLE
    from scaffold.check import docs, registry

    rules = registry.loaded()
    pages: dict[str, RulePage] = {}
    for code in sorted(set(codes)):
        if code in STYLE:
            row = STYLE[code]
            name, severity, summary, text = (
                row.name,
                row.severity,
                row.summary,
                docs.style_text(row),
            )
            is_built_in = True
        else:
            rule = rules[code]
            name, severity, summary = rule.name, rule.severity, docs.summary(rule)
            text = cleandoc(rule.__doc__ or "").replace("``", "`")
            is_built_in = registry.is_built_in(rule)
        linters = docs.linters(CODES[code]) if code in CODES else ()
        repository = _repository() if is_built_in else None
        url = f"{repository}/blob/HEAD/docs/rules/{code}.md" if repository else None
        pages[code] = RulePage(code, name, severity, summary.replace("`", ""), text, linters, url)
    return pages


@cache
def _repository() -> str | None:
    from importlib.metadata import PackageNotFoundError, metadata

    try:
        entries = metadata(DISTRIBUTION).get_all("Project-URL") or []
    except PackageNotFoundError:
        return None
    urls: dict[str, str] = {}
    for entry in entries:
        label, _, address = entry.partition(",")
        urls["".join(filter(str.isalnum, label)).lower()] = address.strip()
    result = [urls[label] for label in _LABELS if label in urls]
    return result[0].rstrip("/").removesuffix(".git") if result else None
