"""``ros2-scaffold check [PATHS]``."""

from __future__ import annotations

import argparse
import sys
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from scaffold.check.rule import Rule
    from scaffold.check.selection import Selection
    from scaffold.check.session import Result
    from scaffold.config import Config

FORMATS = ("text", "json")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Define the flags of the verb."""
    parser.add_argument(
        "paths",
        nargs="*",
        default=["."],
        metavar="PATH",
        help="a package, a workspace or a single file (default: the current directory)",
    )
    parser.add_argument("--format", choices=FORMATS, default="text", help="form of the report")
    parser.add_argument(
        "--select",
        action="append",
        metavar="CODES",
        help="report these codes only; prefixes, separated by commas",
    )
    parser.add_argument(
        "--ignore", action="append", metavar="CODES", help="do not report these codes"
    )
    parser.add_argument(
        "--fix", action="store_true", help="mend what can be mended without changing behaviour"
    )
    parser.add_argument(
        "--unsafe-fixes",
        action="store_true",
        help="with --fix: also what the author should look at afterwards",
    )
    parser.add_argument("--diff", action="store_true", help="show what --fix would change")
    parser.add_argument(
        "--content",
        action="append",
        default=[],
        metavar="DIR",
        help="a directory with rules/ of your own; its Python is run",
    )


def run(options: argparse.Namespace) -> int:
    """Check packages; return the exit code."""
    from scaffold import config, content, reporters
    from scaffold.check import registry
    from scaffold.check.session import Session
    from scaffold.model import discovery

    settings = config.load(content=tuple(options.content))
    rules = registry.load(content.roots("rules", settings.content))
    selection = _selection(options, settings, rules)
    session = Session(rules, selection)
    targets = discovery.find(options.paths)
    if options.fix or options.diff:
        return _fix(options, session, targets)
    results = list(session.run(targets))
    reporters.get(options.format)(results, sys.stdout)
    return exit_code(results)


def exit_code(results: list[Result]) -> int:
    """Return 0 for nothing but advice, 1 for something found, 3 for a rule that failed."""
    from scaffold.check.diagnostic import Severity
    from scaffold.check.internal import RuleCrashed
    from scaffold.cli.main import CLEAN, DEFECT, FOUND

    found = [diagnostic for result in results for diagnostic in result.diagnostics]
    if any(diagnostic.code == RuleCrashed.code for diagnostic in found):
        return DEFECT
    return FOUND if any(d.severity is not Severity.INFO for d in found) else CLEAN


def _selection(
    options: argparse.Namespace, settings: Config, rules: list[type[Rule]]
) -> Selection:
    from scaffold.check import selection
    from scaffold.check.session import all_rules

    codes: set[str] = set()
    chosen: dict[str, tuple[str, ...]] = {}
    for key in ("select", "ignore"):
        given = selection.split(getattr(options, key))
        origin = f"--{key}"
        if not given and f"check.{key}" in settings.values:
            given = selection.split(settings.strings(f"check.{key}"))
            origin = settings.origin(f"check.{key}")
        if given:
            codes = codes or {rule.code for rule in all_rules(rules)} | _style_codes()
            selection.validate(given, codes, origin)
        chosen[key] = given
    return selection.Selection(chosen["select"], chosen["ignore"], settings.per_path_ignores())


def _style_codes() -> set[str]:
    from scaffold.style.codes import CODES

    return set(CODES)
