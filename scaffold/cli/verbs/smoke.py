"""``ros2-scaffold smoke [PATHS]``."""

from __future__ import annotations

import argparse
import sys
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Sequence

    from scaffold.distributions import Distribution
    from scaffold.model.discovery.targets import Target
    from scaffold.model.package import Package
    from scaffold.smoke.cleanup.interruption import Interruption
    from scaffold.smoke.options import Options
    from scaffold.smoke.result import Smoke

FORMATS = ("text", "json", "junit", "github")
SIGNALS = {"INT": ("SIGINT",), "TERM": ("SIGTERM",), "both": ("SIGINT", "SIGTERM")}


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Define the flags of the verb."""
    parser.description = (
        "Build packages with colcon and run each of their executables in a separate ROS domain "
        "on the loopback network. Observe it from another process, compare the result with its "
        "source, and stop it. This is the only verb that runs the code of the packages."
    )
    parser.add_argument(
        "paths",
        nargs="*",
        default=["."],
        metavar="PATH",
        help="a package or a workspace (default: the current directory)",
    )
    _add_selection(parser)
    _add_further_runs(parser)
    _add_environment(parser)
    _add_report(parser)
    _add_limits(parser)
    parser.add_argument(
        "--workspace",
        metavar="DIR",
        help="keep build, install and log in this directory instead of a temporary one",
    )
    parser.add_argument(
        "--keep", action="store_true", help="keep the scratch directory and print its path"
    )


def _add_selection(parser: argparse.ArgumentParser) -> None:
    """Define the flags that choose the packages to run."""
    selection = parser.add_mutually_exclusive_group()
    selection.add_argument(
        "--packages-select",
        nargs="+",
        metavar="NAME",
        help="run only these packages; their dependencies are built as well",
    )
    selection.add_argument(
        "--packages-up-to",
        nargs="+",
        metavar="NAME",
        help="run these packages and their dependencies",
    )
    selection.add_argument(
        "--since",
        metavar="REV",
        help="run the packages that differ from this git commit, and those that depend on them",
    )


def _add_further_runs(parser: argparse.ArgumentParser) -> None:
    """Define the flags for what is run besides each executable alone."""
    parser.add_argument(
        "--together",
        action="store_true",
        help="also run all executables of a package in one domain, and report why nodes do not "
        "connect: types, quality of service, names",
    )
    parser.add_argument(
        "--launch",
        action="store_true",
        help="also run the launch files of a package, each in a separate domain",
    )
    parser.add_argument(
        "--test",
        action="store_true",
        help="also run `colcon test`; failing tests and linters are problems",
    )


def _add_environment(parser: argparse.ArgumentParser) -> None:
    """Define the flags that choose the ROS 2 and the machines to run on."""
    parser.add_argument(
        "--distro",
        action="append",
        metavar="NAMES",
        help="the ROS 2 distributions to run on, separated by commas; on others, nothing is "
        "run (default: check.distribution of the configuration, else what `new --distro` made "
        "the packages for, else ROS_DISTRO, else the available one)",
    )
    parser.add_argument(
        "--ros",
        metavar="WHICH",
        help="use this ROS 2 environment: 'sourced', 'wheels', the name of an installation in "
        "/opt/ros, or a directory with a setup.bash (default: the first usable one)",
    )
    parser.add_argument(
        "--cluster",
        metavar="ADDRESS",
        help="run the packages on the workers of a Dask cluster, given the address of its "
        "scheduler, such as tcp://host:8786; sends them the sources",
    )


def _add_report(parser: argparse.ArgumentParser) -> None:
    """Define the flags of the report."""
    parser.add_argument("--format", choices=FORMATS, default="text", help="output format")
    parser.add_argument(
        "--output-file",
        metavar="FILE",
        help="write the report to a file instead of standard output",
    )
    parser.add_argument(
        "--report",
        metavar="DIR",
        help="also write a page with plots, graphs and tables to DIR/index.html",
    )
    parser.add_argument(
        "--verbose",
        action="store_true",
        help="also show intervals, sizes, quality of service, parameters, logs and resources",
    )


def _add_limits(parser: argparse.ArgumentParser) -> None:
    """Define the flags that say how long and how each executable runs."""
    parser.add_argument(
        "--duration",
        type=_seconds,
        default=5.0,
        metavar="S",
        help="seconds to observe each executable once its node appears (default: 5)",
    )
    parser.add_argument(
        "--timeout",
        type=_seconds,
        default=20.0,
        metavar="S",
        help="seconds within which the node and the first messages of an executable must appear "
        "(default: 20)",
    )
    parser.add_argument(
        "--build-timeout",
        type=_seconds,
        default=900.0,
        metavar="S",
        help="seconds after which the build is aborted (default: 900)",
    )
    parser.add_argument(
        "--signal",
        choices=tuple(SIGNALS),
        default="INT",
        help="signal to stop with: as sent by Ctrl+C, by systemd and containers, or both in "
        "separate runs (default: INT)",
    )
    parser.add_argument(
        "--jobs",
        type=_positive,
        default=4,
        metavar="N",
        help="number of executables to run in parallel (default: 4)",
    )


def run(options: argparse.Namespace) -> int:
    """Build, run and observe packages; return the exit code."""
    from signal import Signals

    from scaffold.smoke.cleanup.interruption import InterruptedBySignalError, Interruption

    interruption = Interruption()
    try:
        with interruption, interruption.at_once():
            return _run(options, interruption)
    except InterruptedBySignalError as end:
        _announce(f"interrupted by {Signals(end.number).name}")
        return 128 + end.number


def _run(options: argparse.Namespace, interruption: Interruption) -> int:
    from scaffold.cli import terminal
    from scaffold.cli.exit_codes import CLEAN, FINDINGS, USAGE_ERROR
    from scaffold.model.discovery import targets
    from scaffold.smoke.session import packages_of

    _validate(options)
    found_targets = targets.find(options.paths)
    packages, run_only = _selected(options, found_targets, packages_of(found_targets))
    wanted = _distributions(options, packages)
    settings = _settings(options, run_only, wanted)
    result = _observed(options, packages, settings, interruption)
    try:
        _report(options, result)
    except OSError:
        interruption.check()  # the terminal may be gone
        raise
    _announce_unobserved(options, packages, wanted, result.environment["distribution"])
    if result.scratch:
        terminal.say(f"kept: {result.scratch}")
    interruption.check()
    if result.ended_early:
        _announce(result.ended_early)
        return USAGE_ERROR
    return CLEAN if result.ok else FINDINGS


def _settings(
    options: argparse.Namespace, run_only: frozenset[str] | None, wanted: Sequence[Distribution]
) -> Options:
    from pathlib import Path
    from signal import Signals

    from scaffold.smoke.options import Options

    return Options(
        duration=options.duration,
        timeout=options.timeout,
        build_timeout=options.build_timeout,
        signals=tuple(Signals[name] for name in SIGNALS[options.signal]),
        workspace=Path(options.workspace).absolute() if options.workspace else None,
        keep=options.keep,
        jobs=options.jobs,
        run_only=run_only,
        test=options.test,
        together=options.together,
        launch=options.launch,
        ros=options.ros,
        wanted=wanted,
    )


def _observed(
    options: argparse.Namespace,
    packages: Sequence[Package],
    settings: Options,
    interruption: Interruption,
) -> Smoke:
    """Run the packages, here or on a cluster, and return what was observed."""
    from functools import partial

    from scaffold.cli.status_line import StatusLine

    if options.cluster is None:
        from scaffold.smoke.session import smoke
    else:
        from scaffold.smoke.on_cluster import smoke_on_cluster

        smoke = partial(smoke_on_cluster, options.cluster)
    with StatusLine() as status:
        return smoke(
            packages,
            settings,
            progress=status.show,
            announce=status.announce,
            interruption=interruption,
        )


def _announce_unobserved(
    options: argparse.Namespace,
    packages: Sequence[Package],
    wanted: Sequence[Distribution],
    observed: str,
) -> None:
    """Say on which distributions the packages were not observed, or that there are none."""
    from scaffold import distributions
    from scaffold.cli import distro

    if not packages:
        _announce(f"no package differs from {options.since}")
        return
    for note in distro.note_of_smoke(observed):
        _announce(note)
    others = [item for item in wanted if item.name != observed]
    if others:
        _announce(f"not observed: {distributions.titles(others)}, which the packages are for, too")


def _distributions(
    options: argparse.Namespace, packages: Sequence[Package]
) -> Sequence[Distribution]:
    """Return the distributions on which the packages can be run; any if they name none.

    Raises:
        InputError: there is no common distribution.
    """
    import os

    from scaffold import distributions
    from scaffold.cli import distro
    from scaffold.cli.packages import common_directory
    from scaffold.configuration import config
    from scaffold.errors import InputError
    from scaffold.files.disk import Disk

    disk = Disk()
    settings = config.load(common_directory(options.paths, disk), (), disk)
    named = distro.wanted(options.distro, settings)
    if named is not None:
        return named
    records = {package.name: distro.recorded(package.directory) for package in packages}
    for_each = {name: named for name, named in records.items() if named is not None}
    if not for_each:
        shell = os.environ.get(distro.VARIABLE, "")
        return [distributions.named(shell)] if shell in distributions.NAMES else []
    common = [
        item
        for item in next(iter(for_each.values()))
        if all(item in named for named in for_each.values())
    ]
    if not common:
        each = "; ".join(
            f"{name} is for {distributions.titles(named)}" for name, named in for_each.items()
        )
        raise InputError(
            f"no distribution works for all packages: {each}; select some with --packages-select"
        )
    return common


def _selected(
    options: argparse.Namespace, found_targets: Sequence[Target], packages: Sequence[Package]
) -> tuple[list[Package], frozenset[str] | None]:
    """Return the packages to build, and the names of those to run; ``None`` for all."""
    from scaffold.smoke.selection import named, with_dependencies

    if options.packages_select:
        names = named(packages, options.packages_select, "--packages-select")
    elif options.packages_up_to:
        wanted = named(packages, options.packages_up_to, "--packages-up-to")
        names = with_dependencies(packages, wanted)
    elif options.since is not None:
        from scaffold.cli.checking.since import Since

        changed = Since(found_targets[0].package.directory, options.since, found_targets).targets()
        names = {target.package.name for target in changed}
    else:
        return [*packages], None
    needed = with_dependencies(packages, names)
    return [package for package in packages if package.name in needed], frozenset(names)


def _validate(options: argparse.Namespace) -> None:
    """Make sure that reports can be written, before the work starts.

    Raises:
        InputError: they cannot.
    """
    import os

    from scaffold.cli import reports
    from scaffold.errors import InputError

    reports.validate_path(options.output_file)
    if options.cluster is not None and (options.workspace or options.keep):
        flag = "--workspace" if options.workspace else "--keep"
        raise InputError(
            f"{flag}: cannot be combined with --cluster, whose workers build in temporary "
            "directories"
        )
    directory = options.report
    if directory is not None and os.path.exists(directory) and not os.path.isdir(directory):
        raise InputError(f"--report {directory}: is a file, not a directory")


def _report(options: argparse.Namespace, result: Smoke) -> None:
    """Write the report, the page, and the job summary, even if one of them fails.

    Raises:
        InputError: one of them could not be written.
    """
    from scaffold.cli import reports as outputs
    from scaffold.errors import InputError
    from scaffold.smoke.reports import github, html

    refused: list[InputError] = []
    for is_asked, write in (
        (options.report is not None, lambda: html.write(result, options.report)),
        (
            options.format == "github",
            lambda: outputs.add_job_summary(github.job_summary(result)),
        ),
        (True, lambda: _write(options, result)),
    ):
        try:
            if is_asked:
                write()
        except InputError as error:
            refused.append(error)
    for refusal in refused:
        raise refusal


def _write(options: argparse.Namespace, result: Smoke) -> None:
    from io import StringIO

    from scaffold.cli import reports as outputs
    from scaffold.smoke import reports

    if options.output_file is None:
        reports.report(result, options.format, sys.stdout, verbose=options.verbose)
        return
    text = StringIO()
    reports.report(result, options.format, text, verbose=options.verbose)
    content = text.getvalue().encode("utf-8", "backslashreplace")
    outputs.write_file(options.output_file, content, "--output-file")


def _announce(text: str) -> None:
    from scaffold.cli import terminal

    terminal.say(f"ros2-scaffold: {text}")


def _seconds(text: str) -> float:
    try:
        value = float(text)
    except ValueError:
        value = 0.0
    if not 0 < value < float("inf"):
        raise argparse.ArgumentTypeError(f"{text!r} is not a positive number of seconds")
    return value


def _positive(text: str) -> int:
    if not text.isdecimal() or int(text) < 1:
        raise argparse.ArgumentTypeError(f"{text!r} is not a positive integer")
    return int(text)
