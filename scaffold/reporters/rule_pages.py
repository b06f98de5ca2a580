"""The documentation pages of rules, and their URLs."""

from __future__ import annotations

import os
from collections.abc import Iterable
from functools import cache
from inspect import cleandoc
from urllib.parse import quote

from scaffold.diagnostic import Severity
from scaffold.record import NamedTuple

DISTRIBUTION = "ros2-scaffold"
"""The name under which the tool is installed."""
_LABELS = ("repository", "source", "sourcecode", "github", "homepage")
"""Labels of the repository address in the metadata, normalized as by package indexes."""


class RulePage(NamedTuple):
    """A rule, or a code of ament's linters, as its page describes it."""

    code: str
    name: str
    severity: Severity
    summary: str
    """What it reports, without Markdown."""
    markdown: str
    """The full text with summary, **Why.**, **Fix.** and **Source.**."""
    linters: tuple[str, ...]
    """The linters of ament that report the code."""
    url: str | None
    """The address of the page."""


def of(codes: Iterable[str]) -> dict[str, RulePage]:
    """Return the pages of codes reported by the loaded rules, in alphabetical order.

    A rule has a URL if it comes with this tool and the metadata of the tool name a repository.
    """
    from scaffold.ament.codes import CODES, STYLE
    from scaffold.check.rules import docs, registry

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


def links(codes: Iterable[str]) -> dict[str, str]:
    """Return the link targets of codes for a terminal.

    The address of the page, or a page in the user's cache if the project has no address; a code
    without either is left out.
    """
    from scaffold.files import cache

    result: dict[str, str] = {}
    kept = cache.directory("pages")
    for code, page in of(codes).items():
        path = None if kept is None else os.path.join(kept, f"{code}.md")
        if page.url is not None:
            result[code] = page.url
        elif path is not None and cache.write_plain(path, _full_page(code).encode()):
            result[code] = f"file://{quote(os.path.abspath(path))}"
    return result


def _full_page(code: str) -> str:
    from scaffold.ament.codes import STYLE
    from scaffold.check.rules import docs, registry

    rule = registry.loaded().get(code)
    return docs.style_page(STYLE[code]) if rule is None else docs.page(rule)


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
