"""``ros2-scaffold interfaces [TYPE]``."""

from __future__ import annotations

import argparse
import os
from typing import TYPE_CHECKING

from scaffold.cli import terminal

if TYPE_CHECKING:
    from scaffold.model.interfaces.definitions import Definitions, Interface

FORMATS = ("text", "json")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Define the flags of the verb."""
    types = parser.add_argument(
        "types",
        nargs="*",
        metavar="TYPE",
        help="show these types, such as std_msgs/msg/String, std_msgs/String or String, or list "
        "those of a package (default: list all)",
    )
    types.completer = lambda **_: _definitions(".").all_names()  # type: ignore[attr-defined]  # argcomplete
    parser.add_argument(
        "--workspace",
        default=".",
        metavar="DIR",
        help="packages whose interfaces take precedence (default: the current directory)",
    )
    parser.add_argument("--format", choices=FORMATS, default="text", help="output format")


def run(options: argparse.Namespace) -> int:
    """List interfaces, or show some; unknown and ambiguous types are user errors."""
    definitions = _definitions(options.workspace)
    listed: list[str] = []
    shown: list[Interface] = []
    for word in options.types:
        names = [name for name in definitions.all_names() if name.startswith(f"{word}/")]
        listed += names
        if not names:
            shown.append(definitions.resolve(word))
    if not options.types:
        listed = definitions.all_names()
    if options.format == "json":
        data = [_as_data(interface) for interface in shown]
        terminal.show_json(data if shown else listed)
        return 0
    for name in listed:
        terminal.show(name)
    if shown:
        terminal.show("\n".join(map(_as_text, shown)).removesuffix("\n"))
    return 0


def _definitions(directory: str) -> Definitions:
    from scaffold.errors import InputError
    from scaffold.model.discovery import targets as discovery
    from scaffold.model.workspace.definitions import definitions_for
    from scaffold.model.workspace.workspace import Workspace

    if not os.path.isdir(directory):
        raise InputError(f"{directory}: no such directory")
    try:
        targets = discovery.find([directory])
    except InputError:  # a directory without packages is fine: there are other interfaces
        targets = []
    return definitions_for(Workspace(target.package for target in targets))


def _as_text(interface: Interface) -> str:
    from scaffold.model.interfaces.definitions import render

    return f"# {interface.full_name}\n# from {interface.origin}\n{render(interface)}"


def _as_data(interface: Interface) -> dict[str, object]:
    return {
        "type": interface.full_name,
        "origin": interface.origin,
        **{
            section.name: {
                "constants": [
                    {"type": str(constant.type), "name": constant.name, "value": constant.value}
                    for constant in section.constants
                ],
                "fields": [
                    {"type": str(field.type), "name": field.name, "default": field.default}
                    for field in section.fields
                ],
            }
            for section in interface.sections
        },
    }
