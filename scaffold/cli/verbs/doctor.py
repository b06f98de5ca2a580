"""``ros2-scaffold doctor``."""

from __future__ import annotations

import argparse

from scaffold.cli import terminal

FORMATS = ("text", "json")
SHELLS = ("bash", "zsh", "fish")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Define the flags of the verb."""
    parser.description = (
        "List the ROS 2 environments and which one `smoke` uses, what is missing and how to "
        "install it, and common mistakes. Only variables and files are read; nothing is sourced "
        "or run."
    )
    parser.add_argument("--format", choices=FORMATS, default="text", help="output format")
    parser.add_argument(
        "--shell",
        choices=SHELLS,
        help="print lines for the startup file of a shell instead: setup files, an alias "
        "`build`, and tab completion",
    )


def run(options: argparse.Namespace) -> int:
    """Diagnose the machine, or print the shell lines; return the exit code."""
    from scaffold.cli.exit_codes import CLEAN, FINDINGS
    from scaffold.doctor import checks, report, shell
    from scaffold.doctor.environments import environments
    from scaffold.doctor.machine import Machine

    machine = Machine()
    if options.shell is not None:
        for line in shell.lines(machine, options.shell):
            terminal.show(line)
        return CLEAN
    candidates = environments(machine)
    findings = list(checks.run(machine))
    if options.format == "json":
        terminal.show_json(report.as_data(candidates, findings))
    else:
        for line in report.text(candidates, findings):
            terminal.show(line)
    return CLEAN if report.is_ok(candidates, findings) else FINDINGS
