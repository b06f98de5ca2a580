"""Checks standard input in place of a file of a package, for editors."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

from scaffold.cli import terminal
from scaffold.errors import InputError

if TYPE_CHECKING:
    import argparse

    from scaffold.check.result import Result
    from scaffold.check.session import Session
    from scaffold.diagnostic import Diagnostic
    from scaffold.files.disk import Disk
    from scaffold.model.discovery.targets import Target
    from scaffold.model.package import Package
    from scaffold.model.workspace.policy import Policy

WORD = "-"
"""The path that means standard input."""


def validate(options: argparse.Namespace) -> bool:
    """Return whether standard input is to be checked.

    Raises:
        InputError: other flags conflict with it.
    """
    name = options.stdin_filename
    if name is None:
        if WORD in options.paths:
            raise InputError(
                "- means standard input: add --stdin-filename with the name of the file"
            )
        return False
    if options.paths not in ([WORD], ["."]):
        raise InputError("--stdin-filename only works with standard input: omit the paths")
    for flag in ("diff", "reference"):
        if getattr(options, flag):
            raise InputError(f"--{flag} cannot be combined with --stdin-filename")
    return True


def read(path: str, disk: Disk) -> bytes:
    """Return the text of standard input.

    Args:
        path: The file that it replaces, which need not exist.
        disk: Records what was accessed outside of the package.

    Raises:
        InputError: the path is a directory, or the text is too large.
    """
    from scaffold.files.disk import MAX_BYTES

    if disk.is_directory(path):
        raise InputError(f"--stdin-filename {path}: is a directory, not a file")
    data = sys.stdin.buffer.read(MAX_BYTES + 1)
    if len(data) > MAX_BYTES:
        raise InputError(f"standard input: {MAX_BYTES // 1_000_000} MB is the limit")
    return data


def target_of(data: bytes, path: str, disk: Disk, policy: Policy) -> Target:
    """Return a target in which a text replaces the content of a file.

    Args:
        data: The text.
        path: The file, which need not exist.
        disk: Records what was accessed outside of the package.
        policy: The configuration of rules.

    Raises:
        InputError: the path is in no package and not that of a Python file.
    """
    from scaffold.check.fixes.overlay import Overlay
    from scaffold.model.discovery import targets as discovery

    (target,) = discovery.find([path], disk, are_saved=False, policy=policy)
    overlay = Overlay(target.package.tree)
    overlay.changed[_name(target)] = data
    target.package.change(overlay)
    return target


def fix(session: Session, target: Target, *, unsafe: bool) -> tuple[bytes, Result]:
    """Write the fixed text to standard output; return it and the remaining findings.

    Other files are not changed, so fixes that change one are skipped.
    """
    from scaffold.check.fixes import fixer
    from scaffold.check.result import Result

    name = _name(target)

    def check(package: Package) -> list[Diagnostic]:
        (result,) = session.run_batch([target._replace(package=package)])
        return [_without_outside_fix(name, diagnostic) for diagnostic in result.diagnostics]

    before = target.package.tree.read(name)
    fixed = fixer.fix(target.package, check, unsafe=unsafe)
    text = fixed.changed.get(name, before)
    terminal.write_bytes(text)
    return text, Result(fixed.package, len(fixed.package.files), fixed.diagnostics)


def _name(target: Target) -> str:
    return next(iter(target.only or ()))


def _without_outside_fix(name: str, diagnostic: Diagnostic) -> Diagnostic:
    """Return a diagnostic without a fix that changes other files."""
    changes = diagnostic.fix.changes if diagnostic.fix is not None else ()
    if all(change.path == name for change in changes):
        return diagnostic
    return diagnostic._replace(fix=None)
