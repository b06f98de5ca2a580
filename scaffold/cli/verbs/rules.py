"""``ros2-scaffold rules [CODE]``."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from scaffold.cli import flags, terminal

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from scaffold.check.rules.rule import Rule


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Define the flags of the verb."""
    codes = parser.add_argument(
        "codes",
        nargs="*",
        metavar="RULE",
        help="explain a rule, given its code or name; list the rules of an area such as cmake, "
        "or with a prefix such as CM",
    )
    codes.completer = flags.offer_rules  # type: ignore[attr-defined]  # argcomplete
    parser.add_argument("--format", choices=("text", "json"), default="text", help="output format")
    parser.add_argument(
        "--content",
        action="append",
        default=[],
        metavar="DIR",
        help="a directory with your own rules/",
    )
    parser.add_argument(
        "--write-docs", metavar="DIR", help="write one page per rule to a directory instead"
    )


def run(options: argparse.Namespace) -> int:
    """List the rules, or explain some."""
    from scaffold.check import selection
    from scaffold.check.rules import docs, registry
    from scaffold.check.session import all_rules
    from scaffold.cli import settings
    from scaffold.configuration import content

    own = settings.load(options.content).content
    loaded = registry.load(content.roots("rules", own))
    rules, areas = all_rules(loaded), selection.area_prefixes(loaded)
    if options.write_docs:
        docs.write(options.write_docs, rules)
    elif options.format == "json":
        chosen = [code for word in options.codes for code in _codes(word, rules, areas)]
        terminal.show_json(
            [docs.as_data(rule) for rule in rules if not options.codes or rule.code in chosen]
        )
    elif options.codes:
        shown = [_explained(word, rules, areas) for word in options.codes]
        terminal.show("\n".join(shown).removesuffix("\n"))
    else:
        terminal.show(_rule_lines(rules, ()))
        terminal.show(_summary(rules))
    return 0


def _explained(word: str, rules: list[type[Rule]], areas: Mapping[str, str]) -> str:
    """Return the documentation of the rules that match a word."""
    from scaffold.ament.codes import STYLE
    from scaffold.check.rules import docs

    codes = _codes(word, rules, areas)
    if len(codes) > 1:
        chosen = [rule for rule in rules if rule.code in codes]
        return _rule_lines(chosen, [code for code in codes if code in STYLE])
    for rule in rules:
        if rule.code in codes:
            return docs.page(rule)
    return docs.style_page(STYLE[codes[0]])


def _codes(word: str, rules: list[type[Rule]], areas: Mapping[str, str]) -> list[str]:
    """Return the codes that match a word, as for ``check --select``."""
    from scaffold.ament.codes import STYLE
    from scaffold.check import selection
    from scaffold.errors import ConfigError, InputError

    names = {
        **{rule.code: rule.name for rule in rules},
        **{item: STYLE[item].name for item in STYLE},
    }
    if word.upper() in names:
        return [word.upper()]
    try:
        prefixes = selection.resolve([word], names, areas, "RULE")
    except ConfigError as error:
        raise InputError(str(error).partition(": ")[2]) from error
    return [code for code in names if code.startswith(prefixes)]


def _rule_lines(rules: list[type[Rule]], style: Sequence[str]) -> str:
    """Return a line for each rule, and for each code of flake8 and pydocstyle."""
    from scaffold.ament.codes import STYLE
    from scaffold.check.rules import docs

    rows = [
        (
            *(rule.code, rule.severity.value, "fix" if docs.has_fix(rule) else "", rule.name),
            docs.summary(rule),
        )
        for rule in rules
    ]
    rows += [
        (code, item.severity.value, "fix" if item.fix else "", item.name, item.summary)
        for code, item in ((code, STYLE[code]) for code in style)
    ]
    width = max((len(name) for *_, name, _ in rows), default=0)
    return "\n".join(
        f"{code:<5}  {severity:<7}  {fix:<3}  {name:<{width}}  {summary}"
        for code, severity, fix, name, summary in rows
    )


def _summary(rules: list[type[Rule]]) -> str:
    from scaffold.ament.codes import STYLE

    return (
        f"\n{len(rules)} rules. Python style and docstrings keep the codes of flake8 and "
        f"pydocstyle, with ament's verdict: {len(STYLE)} codes from {min(STYLE)} to "
        f"{max(STYLE)}.\n`ros2-scaffold rules CODE` explains one."
    )
