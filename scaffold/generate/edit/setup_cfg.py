"""Adds executables to setup.cfg, if the entry points are there."""

from __future__ import annotations

from scaffold.edits import Edit
from scaffold.formats.ini import IniFile, IniOption
from scaffold.generate.edit.addition import Addition, ByHand, Outcome, spliced
from scaffold.source import Source

SECTION = "options.entry_points"
KEY = "console_scripts"


def scripts(file: IniFile) -> IniOption | None:
    """Return the option with the executables."""
    return file.option(SECTION, KEY)


def add_to_setup_cfg(source: Source, addition: Addition) -> Outcome:
    """Declare an executable below the others.

    Raises:
        ParseError: setuptools would reject the file.
    """
    option = scripts(IniFile.parse(source))
    program = addition.program
    if option is None or program is None:
        return Outcome(source)
    names = [line.text.partition("=")[0].strip() for line in option.lines]
    if program.name in names:
        return Outcome(source)
    line = f"{program.name} = {program.entry_point}"
    last = option.lines[-1].location if option.lines else option.key_location
    if option.lines and last.line == option.key_location.line:
        reason = f"{KEY} begins on the line of its key"
        return Outcome(source, (ByHand(source.path, line, reason),))
    indent = " " * (last.column - 1) if option.lines else "    "
    at = source.offset(last.end_line, 1)
    end = source.text.find("\n", at)
    end = len(source.text) if end < 0 else end
    if source.text[end - 1 : end] == "\r":
        end -= 1
    glue = line if not option.lines or " = " in option.lines[-1].text else line.replace(" = ", "=")
    return Outcome(
        spliced(source, [Edit(source.path, end, end, f"{source.newline}{indent}{glue}")])
    )


def add_directories(source: Source, addition: Addition, *, has_others: bool) -> Outcome:
    """Install executables where ``ros2 run`` looks for them, not in ``bin/``.

    Args:
        source: setup.cfg; empty if there is none.
        addition: What is added.
        has_others: Whether the package has executables already, which would be moved.

    Raises:
        ParseError: setuptools would reject the file.
    """
    directory = f"$base/lib/{addition.package}"
    by_hand: list[ByHand] = []
    for section, key in (("develop", "script_dir"), ("install", "install_scripts")):
        file = IniFile.parse(source)
        value = file.get(section, key, key.replace("_", "-"))
        if addition.program is None or (value or "").strip().rstrip("/") == directory:
            continue
        if value is not None:
            reason = f"it is {value}, where `ros2 run` does not find executables"
            by_hand.append(ByHand(source.path, f"[{section}] {key}={directory}", reason))
        elif has_others:
            reason = "`ros2 run` requires it, but it also moves the other executables out of bin/"
            by_hand.append(ByHand(source.path, f"[{section}] {key}={directory}", reason))
        else:
            source = spliced(source, [file.set(section, key, directory)])
    return Outcome(source, tuple(by_hand))
