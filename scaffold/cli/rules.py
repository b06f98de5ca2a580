"""``ros2-scaffold rules [CODE]``."""

from __future__ import annotations

import argparse
import sys


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Define the flags of the verb."""
    parser.add_argument(
        "codes", nargs="*", metavar="CODE", help="explain these: a code such as CM001, or a name"
    )
    parser.add_argument("--format", choices=("text", "json"), default="text")
    parser.add_argument(
        "--content", action="append", default=[], metavar="DIR", help="with rules of your own"
    )
    parser.add_argument(
        "--write-docs",
        metavar="DIR",
        help="write a page per rule into a directory instead",
    )


def run(options: argparse.Namespace) -> int:
    """List the rules, or explain some."""
    from scaffold import config, content
    from scaffold.check import registry
    from scaffold.check.session import all_rules

    settings = config.load(content=tuple(options.content))
    rules = all_rules(registry.load(content.roots("rules", settings.content)))
    if options.write_docs:
        return _write_docs(options.write_docs, rules)
    if options.format == "json":
        return _as_json(options.codes, rules)
    if options.codes:
        return _explain(options.codes, rules)
    return _list(rules)


def _list(rules: list[type[Rule]]) -> int:
    from scaffold.check.docs import has_fix, summary
    from scaffold.style.codes import CODES

    rows = [(r.code, r.severity.value, has_fix(r), r.name, summary(r)) for r in rules]
    width = max(len(row[3]) for row in rows)
    for code, severity, fixable, name, text in rows:
        fix = "fix" if fixable else ""
        sys.stdout.write(f"{code}  {severity:<7}  {fix:<3}  {name:<{width}}  {text}\n")
    sys.stdout.write(
        f"\n{len(rows)} rules, and {len(CODES)} codes of Python style and docstrings with "
        "ament's verdict:\n"
    )
    for code, style in CODES.items():
        sys.stdout.write(f"{code}  {style.name:<{width + 14}}  {style.text}\n")
    return 0


def _explain(codes: list[str], rules: list[type[Rule]]) -> int:
    from scaffold.check.docs import page

    pages = [page(rule) if rule else "" for rule in (_find(code, rules) for code in codes)]
    for number, (code, text) in enumerate(zip(codes, pages, strict=True)):
        sys.stdout.write("\n" * bool(number) + (text or _style_page(code)))
    return 0


def _find(code: str, rules: list[type[Rule]]) -> type[Rule] | None:
    return next((rule for rule in rules if code in (rule.code, rule.name) or code.upper() == rule.code), None)


def _style_page(code: str) -> str:
    from scaffold.check.selection import validate
    from scaffold.style.codes import CODES

    style = CODES.get(code.upper())
    if style is None:
        raise unknown
    return f"# {code.upper()} {style.name}\n\nReported by {style.linter}.\n\n{style.text}.\n"
