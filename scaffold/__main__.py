"""Entry point of ``ros2-scaffold`` and ``python -m scaffold``; handles an early Ctrl-C."""

from __future__ import annotations

import sys

_SHORT = (["check"], ["new"])
"""The verbs that are run often and import many modules."""


def main() -> int:
    """Run the command line; return its exit code."""
    try:
        from scaffold.cli.main import main as run

        return _exit_without_teardown(run()) if sys.argv[1:2] in _SHORT else run()
    except KeyboardInterrupt:  # outside of the handling by verbs
        return _interrupted()


def _exit_without_teardown(code: int) -> int:
    """Exit without the teardown of all modules, which takes up to a tenth of the time of a verb.

    Returns:
        The exit code, for a normal exit, if there are other threads.
    """
    import atexit
    import os

    threading = sys.modules.get("threading")
    if threading is None or threading.active_count() == 1:
        atexit._run_exitfuncs()  # noqa: SLF001  cleanup still runs
        os._exit(code)
    return code


def _interrupted() -> int:
    import signal

    signal.signal(signal.SIGINT, signal.SIG_IGN)  # a second Ctrl-C while it is ending
    from scaffold.cli import terminal
    from scaffold.cli.exit_codes import INTERRUPTED

    terminal.say("ros2-scaffold: interrupted")
    return INTERRUPTED


if __name__ == "__main__":
    sys.exit(main())
