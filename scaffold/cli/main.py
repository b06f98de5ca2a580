"""``ros2-scaffold VERB``: finds the verb, keeps the exit codes."""

from __future__ import annotations

import atexit
import gc
import os
import sys

from scaffold import __version__
from scaffold.check import memory
from scaffold.cli.exit_codes import CLEAN, INTERNAL_ERROR, INTERRUPTED, USAGE_ERROR
from scaffold.errors import ScaffoldError

TYPE_CHECKING = False  # the one of typing is slow to import
if TYPE_CHECKING:
    from collections.abc import Sequence


COLLECT_FROM = 100_000
"""Objects after which Python looks for garbage: what a short run makes, it needs until its end."""

VERBS = {
    "new": "write a package",
    "add": "add a node, an interface, a program or a launch file to a package",
    "update": "bring a package in step with the templates of today",
    "check": "lint packages and find what will break",
    "rules": "list and explain the rules",
    "templates": "list the templates, or test those of a team",
    "interfaces": "list the known messages, services and actions, or show some",
    "smoke": "build packages, run their executables and observe them",
    "completion": "print what a shell needs for tab completion",
}
"""A verb is a module of this package with ``add_arguments`` and ``run``."""


def main(arguments: Sequence[str] | None = None) -> int:
    """Run a verb and return its exit code.

    0 clean, 1 something found, 2 the user's input or environment is at fault, 3 a defect of this
    tool, 130 interrupted.
    """
    given = list(sys.argv[1:] if arguments is None else arguments)
    gc.set_threshold(COLLECT_FROM)
    atexit.register(gc.freeze)  # else Python looks through everything once more
    try:
        if "_ARGCOMPLETE" in os.environ:
            _complete()
        if given == ["--version"]:
            sys.stdout.write(f"ros2-scaffold {__version__}\n")
            sys.exit(CLEAN)
        return _run(given)
    except ScaffoldError as error:
        from scaffold.printable import printable

        sys.stderr.write(f"ros2-scaffold: error: {printable(str(error))}\n")
        return USAGE_ERROR
    except KeyboardInterrupt:
        sys.stderr.write("ros2-scaffold: interrupted\n")
        return INTERRUPTED
    except BrokenPipeError:
        # The reader went away (`| head`): nothing more can be said, and nothing is wrong.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return CLEAN
    except Exception as error:  # noqa: BLE001  the last line of defence
        return _defect(error)


def _run(given: list[str]) -> int:
    verb = next((word for word in given if not word.startswith("-")), "")
    slot = memory.Slot.of(given) if verb == "check" else None
    last = slot.last if slot is not None else None
    if last is not None and last.is_current():
        # Before argparse: laying out the flags takes longer than looking at a small package.
        sys.stdout.write(last.output)
        return last.code
    from importlib import import_module

    from scaffold.cli.parser import build_parser

    options = build_parser(verb, comes_first=given[:1] == [verb]).parse_args(given)
    options.slot = slot
    return int(import_module(f"scaffold.cli.{options.verb}").run(options))


def _defect(error: Exception) -> int:
    import traceback

    if os.environ.get("SCAFFOLD_DEBUG"):
        traceback.print_exception(error)
    from scaffold.printable import printable

    last = traceback.extract_tb(error.__traceback__)[-1]
    sys.stderr.write(
        f"ros2-scaffold: defect: {type(error).__name__}: {printable(str(error))} "
        f"({os.path.basename(last.filename)}:{last.lineno}); "
        "please report it; SCAFFOLD_DEBUG=1 shows more\n"
    )
    return INTERNAL_ERROR


def _complete() -> None:
    import argcomplete

    from scaffold.cli.parser import build_parser

    argcomplete.autocomplete(build_parser())


if __name__ == "__main__":
    sys.exit(main())
