"""``ros2-scaffold VERB``: finds the verb, keeps the exit codes."""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Sequence
from importlib import import_module
from typing import NoReturn

from scaffold import __version__
from scaffold.errors import ScaffoldError

CLEAN = 0
FOUND = 1
AT_FAULT = 2
DEFECT = 3
INTERRUPTED = 130

VERBS = {
    "new": "write a package",
    "add": "add a node, an interface or a program to a package",
    "check": "lint packages and find what will break",
    "rules": "list and explain the rules",
    "interfaces": "list the known messages, services and actions, or show some",
    "smoke": "build packages, run their executables and observe them",
}
"""A verb is a module of this package with ``add_arguments`` and ``run``."""


class _Parser(argparse.ArgumentParser):
    """Says what is wrong in one line, as every other error of this tool."""

    def error(self, message: str) -> NoReturn:
        """Print the line and exit."""
        self.exit(AT_FAULT, f"ros2-scaffold: error: {message}; see `{self.prog} --help`\n")


def build_parser(verb: str | None = None) -> argparse.ArgumentParser:
    """Return the parser.

    Args:
        verb: The only verb to define in full; the others are listed but not imported. ``None``
            defines all, as tab completion needs.
    """
    parser = _Parser(
        prog="ros2-scaffold",
        description="Generate, lint, fix, build and prove ROS 2 Python packages.",
    )
    parser.add_argument("--version", action="version", version=f"ros2-scaffold {__version__}")
    # Without the name argparse would lay out a usage text to find it.
    verbs = parser.add_subparsers(dest="verb", metavar="VERB", required=True, prog="ros2-scaffold")
    for name, text in VERBS.items():
        one = verbs.add_parser(name, help=text, description=text[0].upper() + text[1:] + ".")
        if verb is None or verb == name:
            import_module(f"scaffold.cli.{name}").add_arguments(one)
    return parser


def main(arguments: Sequence[str] | None = None) -> int:
    """Run a verb and return its exit code.

    0 clean, 1 something found, 2 the user's input or environment is at fault, 3 a defect of this
    tool, 130 interrupted.
    """
    given = list(sys.argv[1:] if arguments is None else arguments)
    try:
        if "_ARGCOMPLETE" in os.environ:
            _complete()
        verb = next((word for word in given if not word.startswith("-")), "")
        options = build_parser(verb).parse_args(given)
        return int(import_module(f"scaffold.cli.{options.verb}").run(options))
    except ScaffoldError as error:
        sys.stderr.write(f"ros2-scaffold: error: {error}\n")
        return AT_FAULT
    except KeyboardInterrupt:
        sys.stderr.write("ros2-scaffold: interrupted\n")
        return INTERRUPTED
    except BrokenPipeError:
        # The reader went away (`| head`): nothing more can be said, and nothing is wrong.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return CLEAN
    except Exception as error:  # noqa: BLE001  the last line of defence
        return _defect(error)


def _defect(error: Exception) -> int:
    import traceback

    if os.environ.get("SCAFFOLD_DEBUG"):
        traceback.print_exception(error)
    last = traceback.extract_tb(error.__traceback__)[-1]
    sys.stderr.write(
        f"ros2-scaffold: defect: {type(error).__name__}: {error} "
        f"({os.path.basename(last.filename)}:{last.lineno}); "
        "please report it; SCAFFOLD_DEBUG=1 shows more\n"
    )
    return DEFECT


def _complete() -> None:
    import argcomplete

    argcomplete.autocomplete(build_parser())


if __name__ == "__main__":
    sys.exit(main())
