"""The flags of ``check``."""

from __future__ import annotations

import argparse

from scaffold.cli import baselines, distro, flags

OF_REPORT = (
    *("all", "exit_zero", "format", "output_file", "quiet", "severity", "show_source"),
    *("statistics", "style", "unsafe_fixes"),
)
"""The flags that say how findings are shown, and not what is found."""


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
    select = parser.add_argument(
        "--select",
        action="append",
        metavar="RULES",
        help="report only these codes, prefixes of codes, names or areas such as launch, separated "
        "by commas, or ALL",
    )
    ignore = parser.add_argument(
        "--ignore",
        action="append",
        metavar="RULES",
        help="do not report these; the longest matching prefix decides",
    )
    for action in (select, ignore):
        action.completer = flags.offer_rules  # type: ignore[attr-defined]  # argcomplete
    parser.add_argument(
        "--release",
        action="store_true",
        help="report what blocks a release as errors, such as names that rosdep does not have",
    )
    parser.add_argument(
        "--fix",
        action="store_true",
        help="apply the fixes that do not change behavior; those of single files may change others "
        "of their packages",
    )
    parser.add_argument(
        "--unsafe-fixes",
        action="store_true",
        help="with --fix or --diff, also apply unsafe fixes, which need review; else count them",
    )
    parser.add_argument("--diff", action="store_true", help="show what --fix would change")
    parser.add_argument(
        "--whole-packages",
        action="store_true",
        help="check and fix the whole packages of single files, and skip files of no package",
    )
    _add_report_arguments(parser)
    baselines.add_arguments(parser)
    parser.add_argument(
        "--add-noqa",
        action="store_true",
        help="add `noqa: CODE` comments that silence the findings; with --diff, only show them",
    )
    parser.add_argument(
        "--since",
        metavar="REV",
        help="report findings in files that differ from this git commit, and what the change "
        "breaks in other files",
    )
    parser.add_argument(
        "--cluster",
        metavar="ADDRESS",
        help="check on the workers of the Dask cluster whose scheduler is there, such as "
        "tcp://host:8786; they get the sources",
    )
    parser.add_argument(
        "--no-types", action="store_true", help="skip the rules that need the type checker"
    )
    parser.add_argument(
        "--stdin-filename",
        metavar="FILE",
        help="check standard input in place of this file; with --fix, write it to standard output",
    )
    parser.add_argument(
        "--reference",
        action="store_true",
        help="compare the docstring rules with pydocstyle, and show the differences instead",
    )
    parser.add_argument(
        "--include-all",
        action="store_true",
        help="also check submodules, files that git ignores, vendored code and copies of editors",
    )
    parser.add_argument(
        "--reference-config",
        action="store_true",
        help="check style with the configuration that ament ships with, not the one that the tests "
        "of a package use",
    )
    parser.add_argument(
        "--content",
        action="append",
        default=[],
        metavar="DIR",
        help="a directory with rules/ of your own; its Python is run",
    )


def _add_report_arguments(parser: argparse.ArgumentParser) -> None:
    report = parser.add_argument_group(
        "the report", "findings that are not shown still count for the exit code"
    )
    report.add_argument(
        "--all",
        action="store_true",
        help="show every finding, even if they do not fit on the screen",
    )
    report.add_argument(
        "--style",
        action="store_true",
        help="show style and docstring findings where a terminal would only count them",
    )
    report.add_argument(
        "--severity",
        choices=("error", "warning", "info"),
        default="info",
        help="show findings of this level and above only",
    )
    report.add_argument(
        "--show-source",
        action=argparse.BooleanOptionalAction,
        help="show the source line of each finding (default: on a terminal)",
    )
    report.add_argument(
        "--statistics", action="store_true", help="show the number of findings per code instead"
    )
    report.add_argument("-q", "--quiet", action="store_true", help="leave out the summary")
    report.add_argument(
        "--exit-zero", action="store_true", help="exit with 0 even if there are findings"
    )
