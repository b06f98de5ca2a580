"""``ros2-scaffold rules [CODE]``."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from scaffold.cli import terminal

if TYPE_CHECKING:
    from scaffold.check.rule import Rule


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Define the flags of the verb."""
    parser.add_argument(
        "codes", nargs="*", metavar="CODE", help="explain these: a code such as CM001, or a name"
    )
    parser.add_argument("--format", choices=("text", "json"), default="text", help="output format")
    parser.add_argument(
        "--content",
        action="append",
        default=[],
        metavar="DIR",
        help="a directory with rules/ of your own",
    )
    parser.add_argument(
        "--write-docs", metavar="DIR", help="write a page per rule into a directory instead"
    )


def run(options: argparse.Namespace) -> int:
    """List the rules, or explain some."""
    from scaffold.ament.codes import STYLE
    from scaffold.check import docs, registry
    from scaffold.check.session import all_rules
    from scaffold.cli import settings
    from scaffold.configuration import content

    own = settings.load(options.content).content
    rules = all_rules(registry.load(content.roots("rules", own)))
    if options.write_docs:
        docs.write(options.write_docs, rules)
    elif options.codes:
        pages = [_page(word, rules) for word in options.codes]
        terminal.show("\n".join(pages).removesuffix("\n"))
    elif options.format == "json":
        terminal.show_json([docs.as_data(rule) for rule in rules])
    else:
        width = max(len(rule.name) for rule in rules)
        for rule in rules:
            fix = "fix" if docs.has_fix(rule) else ""
            facts = f"{rule.code}  {rule.severity.value:<7}  {fix:<3}  {rule.name:<{width}}"
            terminal.show(f"{facts}  {docs.summary(rule)}")
        terminal.show(
            f"\n{len(rules)} rules. Python style and docstrings keep the codes of flake8 and "
            f"pydocstyle, with ament's verdict: {len(STYLE)} codes from {min(STYLE)} to "
            f"{max(STYLE)}.\n`ros2-scaffold rules CODE` explains one."
        )
    return 0


def _page(word: str, rules: list[type[Rule]]) -> str:
    """Return what is known about the rule of a code or a name."""
    from scaffold.ament.codes import STYLE
    from scaffold.check import docs
    from scaffold.check.selection import nearest
    from scaffold.errors import InputError

    for rule in rules:
        if word.upper() == rule.code or word == rule.name:
            return docs.page(rule)
    style = STYLE.get(word.upper())
    if style is not None:
        return docs.style_page(style)
    known = [*(rule.code for rule in rules), *(rule.name for rule in rules), *STYLE]
    raise InputError(f"there is no rule {word!r}{nearest(word, known)}")
