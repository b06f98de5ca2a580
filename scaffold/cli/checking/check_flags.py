"""The flags of ``check``."""

from __future__ import annotations

import argparse

from scaffold.cli import distro, flags
from scaffold.cli.checking import baselines

OF_REPORT = (
    *("all", "exit_zero", "format", "output_file", "quiet", "severity", "show_source"),
    *("statistics", "style", "unsafe_fixes"),
)
"""The flags that only affect how findings are shown."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Define the flags of the verb."""
    parser.add_argument(
        "paths",
        nargs="*",
        default=["."],
        metavar="PATH",
        help="a package or a directory in it, a workspace, or a single file "
        "(default: the current directory)",
    )
    from scaffold.reporters import NAMES

    parser.add_argument("--format", choices=NAMES, default="text", help="output format")
    parser.add_argument("--output-file", metavar="FILE", help="write the report to a file")
    distro.add_argument(parser)
    _add_rule_arguments(parser)
    _add_fix_arguments(parser)
    _add_report_arguments(parser)
    baselines.add_arguments(parser)
    parser.add_argument(
        "--add-noqa",
        action="store_true",
        help="add `noqa: CODE` comments that silence the findings; with --diff, only show them",
    )
    _add_scope_arguments(parser)
    parser.add_argument(
        "--content",
        action="append",
        default=[],
        metavar="DIR",
        help="a directory with your own rules/, which are executed",
    )


def _add_rule_arguments(parser: argparse.ArgumentParser) -> None:
    """Define the flags that choose rules and their severity."""
    select = parser.add_argument(
        "--select",
        action="append",
        metavar="RULES",
        help="report only these rules: codes, prefixes, names or areas such as launch, separated "
        "by commas, or ALL",
    )
    ignore = parser.add_argument(
        "--ignore",
        action="append",
        metavar="RULES",
        help="do not report these rules; the longest matching prefix wins",
    )
    for action in (select, ignore):
        action.completer = flags.offer_rules  # type: ignore[attr-defined]  # argcomplete
    parser.add_argument(
        "--release",
        action="store_true",
        help="report what blocks a release as errors, such as names that rosdep does not have",
    )


def _add_fix_arguments(parser: argparse.ArgumentParser) -> None:
    """Define the flags that change files."""
    parser.add_argument(
        "--fix",
        action="store_true",
        help="apply safe fixes; fixes of single files may change other files of the package",
    )
    parser.add_argument(
        "--unsafe-fixes",
        action="store_true",
        help="with --fix or --diff, also apply unsafe fixes, which need review; otherwise, count "
        "them",
    )
    parser.add_argument("--diff", action="store_true", help="show what --fix would change")
    parser.add_argument(
        "--whole-packages",
        action="store_true",
        help="check and fix the whole packages that single files belong to, and skip files "
        "without a package",
    )


def _add_scope_arguments(parser: argparse.ArgumentParser) -> None:
    """Define the flags for what is checked, where, and with which reference."""
    parser.add_argument(
        "--since",
        metavar="REV",
        help="report findings in files that differ from this git commit, and what the change "
        "breaks in other files",
    )
    parser.add_argument(
        "--cluster",
        metavar="ADDRESS",
        help="check on the workers of a Dask cluster, given the address of its scheduler, such "
        "as tcp://host:8786; sends them the sources",
    )
    parser.add_argument(
        "--no-types", action="store_true", help="skip the rules that need the type checker"
    )
    parser.add_argument(
        "--stdin-filename",
        metavar="FILE",
        help="check standard input as this file; with --fix, write the result to standard output",
    )
    parser.add_argument(
        "--reference",
        action="store_true",
        help="compare the docstring rules with pydocstyle and show only the differences",
    )
    parser.add_argument(
        "--include-all",
        action="store_true",
        help="also check submodules, files that git ignores, vendored code and copies made by "
        "editors",
    )
    parser.add_argument(
        "--reference-config",
        action="store_true",
        help="check style with ament's default configuration instead of that of the package's "
        "tests",
    )


def _add_report_arguments(parser: argparse.ArgumentParser) -> None:
    """Define the flags that only affect how findings are shown."""
    report = parser.add_argument_group(
        "the report", "hidden findings still count for the exit code"
    )
    report.add_argument(
        "--all",
        action="store_true",
        help="show all findings, even if they do not fit on the screen",
    )
    report.add_argument(
        "--style",
        action="store_true",
        help="on a terminal, show style and docstring findings instead of only counting them",
    )
    report.add_argument(
        "--severity",
        choices=("error", "warning", "info"),
        default="info",
        help="show only findings of this severity and above (format text)",
    )
    report.add_argument(
        "--show-source",
        action=argparse.BooleanOptionalAction,
        help="show the source line of each finding (default: on a terminal)",
    )
    report.add_argument(
        "--statistics", action="store_true", help="show only the number of findings per code"
    )
    report.add_argument("-q", "--quiet", action="store_true", help="omit the summary")
    report.add_argument(
        "--exit-zero", action="store_true", help="exit with 0 even if there are findings"
    )
