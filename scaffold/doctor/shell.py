"""Lines for the startup file of a shell: ROS 2, the workspace, an alias, completion."""

from __future__ import annotations

import os
from collections.abc import Iterator
from shlex import quote

from scaffold.doctor.machine import Machine

SHELLS = ("bash", "zsh", "fish")
START_FILES = {"bash": "~/.bashrc", "zsh": "~/.zshrc", "fish": "~/.config/fish/config.fish"}

_WORKSPACE = "ros2_ws"
_COLCON = "/usr/share/colcon_argcomplete/hook/colcon-argcomplete"
_CD = "/usr/share/colcon_cd/function/colcon_cd"


def lines(machine: Machine, shell: str) -> Iterator[str]:
    """Yield the lines; the shell skips files that do not exist."""
    yield f"# ros2-scaffold doctor --shell {shell} >> {START_FILES[shell]}"
    setup = f"{machine.installed}/{machine.distribution}/setup"
    workspace = machine.workspace
    home = os.path.join(machine.variables.get("HOME", "~"), _WORKSPACE)
    top = home if workspace is None else workspace.top
    yield from _fish(top) if shell == "fish" else _posix(shell, setup, top)


def _posix(shell: str, setup: str, top: str) -> Iterator[str]:
    for path in (
        f"{setup}.{shell}",
        os.path.join(top, "install", f"local_setup.{shell}"),
    ):
        yield _sourcing(path)
    local = quote(os.path.join("install", f"local_setup.{shell}"))
    build = f"cd {quote(top)} && colcon build && source {local}"
    yield f"alias build={quote(build)}"
    if shell == "zsh":
        yield "autoload -U +X compinit && compinit"
    for command in ("ros2", "colcon"):
        yield (
            f"command -v register-python-argcomplete > /dev/null && command -v {command} > "
            f'/dev/null && eval "$(register-python-argcomplete {command})"'
        )
    yield _sourcing(f"{_COLCON}.{shell}")
    yield _sourcing(f"{_CD}.sh")
    yield (f'command -v ros2-scaffold > /dev/null && eval "$(ros2-scaffold completion {shell})"')


def _fish(top: str) -> Iterator[str]:
    yield "# ROS 2 has no setup file for fish: start fish from a bash that has sourced it."
    yield f"alias build {quote(f'cd {quote(top)}; and colcon build')}"
    for command in ("ros2", "colcon"):
        yield (
            f"command -q register-python-argcomplete; and command -q {command}; and "
            f"register-python-argcomplete --shell fish {command} | source"
        )
    yield "command -q ros2-scaffold; and ros2-scaffold completion fish | source"


def _sourcing(path: str) -> str:
    return f"[ ! -f {quote(path)} ] || source {quote(path)}"
