"""``ros2-scaffold completion SHELL``."""

from __future__ import annotations

import argparse
from collections.abc import Mapping

from scaffold.cli import terminal

SHELLS = ("bash", "zsh", "fish")
_HOW = {
    "bash": '# In ~/.bashrc: eval "$(ros2-scaffold completion bash)"\n',
    "zsh": '# In ~/.zshrc, after compinit: eval "$(ros2-scaffold completion zsh)"\n',
    "fish": "# In ~/.config/fish/config.fish: ros2-scaffold completion fish | source\n",
}


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Define the flags of the verb."""
    parser.add_argument("shell", choices=SHELLS, help="the shell")


def run(options: argparse.Namespace) -> int:
    """Print the code for the shell."""
    from argcomplete.shell_integration import shellcode

    code = shellcode(["ros2-scaffold"], shell=options.shell)
    terminal.show(_HOW[options.shell] + code.strip("\n"))
    return 0


def words_before(variables: Mapping[str, str]) -> list[str]:
    """Return the words before the one to complete, without the program."""
    from argcomplete.lexers import split_line

    line = variables.get("COMP_LINE", "").encode()
    before = line[: int(variables.get("COMP_POINT", len(line)))].decode(errors="ignore")
    return split_line(before)[3][1:]


def complete(parser: argparse.ArgumentParser) -> None:
    """Print completions for the shell; those with control characters are skipped."""
    from argcomplete.finders import CompletionFinder

    class Finder(CompletionFinder):
        def filter_completions(self, completions: list[str]) -> list[str]:
            return [
                completion
                for completion in super().filter_completions(completions)
                if completion.isprintable()
            ]

    Finder()(parser)
