"""``ros2-scaffold VERB``: dispatches to the verb and ensures the exit codes."""

from __future__ import annotations

import atexit
import gc
import os
import sys
from contextlib import nullcontext

from scaffold import __version__
from scaffold.check.cache import runs
from scaffold.cli import terminal
from scaffold.cli.exit_codes import (
    BROKEN_PIPE,
    CLEAN,
    INTERNAL_ERROR,
    INTERRUPTED,
    USAGE_ERROR,
)
from scaffold.cli.search_path import leave_out_current_directory
from scaffold.errors import ScaffoldError

TYPE_CHECKING = False  # the one of typing is slow to import
if TYPE_CHECKING:
    from collections.abc import Sequence
    from contextlib import AbstractContextManager

    from scaffold.generate.checking import RuleProcess


COLLECT_FROM = 500_000
"""The threshold of garbage collection: a short run needs its objects until its end."""


def main(arguments: Sequence[str] | None = None) -> int:
    """Run a verb and return its exit code, one of `scaffold.cli.exit_codes`."""
    given = list(sys.argv[1:] if arguments is None else arguments)
    if arguments is None:
        leave_out_current_directory()
    gc.set_threshold(COLLECT_FROM)
    atexit.register(gc.freeze)  # skips a final garbage collection
    try:
        terminal.prepare()
        if "_ARGCOMPLETE" in os.environ:
            _complete()
        try:
            return _run(given)
        finally:
            terminal.flush()
    except (Exception, KeyboardInterrupt) as error:  # noqa: BLE001  the last line of defence
        return _failed(error)


def _run(given: list[str]) -> int:
    if not given:
        given = ["--help"]
    if given == ["--version"]:
        terminal.show(f"ros2-scaffold {__version__}")
        sys.exit(CLEAN)
    verb = next((word for word in given if not word.startswith("-")), "")
    entry = runs.ReportEntry.of(given) if verb == "check" else None
    last = entry.current() if entry is not None else None
    if last is not None:
        # Before argparse: defining the flags takes longer than checking a small package.
        for warning in last.warnings:
            terminal.warn(warning)
        for note in last.notes:
            terminal.say(note)
        terminal.write_report(last.output)
        return last.code
    from importlib import import_module

    from scaffold.cli.parser import build_parser
    from scaffold.programs.termination import cleaned_up

    with cleaned_up(), _rules_ahead(verb, given) as process:
        parser = build_parser(verb, comes_first=given[:1] == [verb], words=given)
        options = parser.parse_args(given)
        options.entry = entry
        options.rule_process = process
        os.getcwd()  # if it was removed, each verb would report a different error
        return int(import_module(f"scaffold.cli.verbs.{options.verb}").run(options))


def _rules_ahead(verb: str, given: list[str]) -> AbstractContextManager[RuleProcess | None]:
    """Load the rules in a second process, if the verb needs them late.

    It is started before the flags of `new` are defined, which needs all templates.
    """
    if verb != "new" or not {"-h", "--help"}.isdisjoint(given):
        return nullcontext()
    from scaffold.generate import checking

    return checking.ahead()


def _failed(error: Exception | KeyboardInterrupt) -> int:
    """Report in one line why a run failed; return its exit code."""
    if isinstance(error, KeyboardInterrupt):
        import signal

        signal.signal(signal.SIGINT, signal.SIG_IGN)  # a second Ctrl-C while it is ending
    terminal.settle()
    match error:
        case ScaffoldError():
            terminal.error(str(error))
        case KeyboardInterrupt():
            terminal.say("ros2-scaffold: interrupted")
            return INTERRUPTED
        case BrokenPipeError():
            return BROKEN_PIPE
        case OSError() | MemoryError():
            _show_traceback(error)
            terminal.error(_system_error_message(error))
        case _:
            return _defect(error)
    return USAGE_ERROR


def _system_error_message(error: OSError | MemoryError) -> str:
    """Return a message about a system error: space, permission, memory, current directory."""
    if isinstance(error, MemoryError):
        return "out of memory"
    try:
        os.getcwd()
    except OSError:
        return "the current directory no longer exists"
    reason = error.strerror or str(error) or type(error).__name__
    return reason if error.filename is None else f"{os.fsdecode(error.filename)}: {reason}"


def _defect(error: Exception) -> int:
    import traceback

    _show_traceback(error)
    last = traceback.extract_tb(error.__traceback__)[-1]
    terminal.say(
        f"ros2-scaffold: internal error: {type(error).__name__}: {error} "
        f"({os.path.basename(last.filename)}:{last.lineno}); "
        "please open an issue in the repository of this tool; "
        "SCAFFOLD_DEBUG=1 shows more"
    )
    return INTERNAL_ERROR


def _show_traceback(error: Exception) -> None:
    if os.environ.get("SCAFFOLD_DEBUG"):
        import traceback

        terminal.say_lines("".join(traceback.format_exception(error)))


def _complete() -> None:
    from scaffold.cli.parser import build_parser
    from scaffold.cli.verbs.completion import complete, words_before
    from scaffold.errors import ScaffoldError

    try:
        parser = build_parser(words=words_before(os.environ))
    except ScaffoldError:  # unusable content: complete without it
        parser = build_parser()
    complete(parser)


if __name__ == "__main__":
    sys.exit(main())
