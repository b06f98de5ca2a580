"""Copies a template, or one of its files, as a starting point for your own."""

from __future__ import annotations

import os
import re
import shutil
from collections.abc import Mapping
from difflib import get_close_matches
from pathlib import Path

from scaffold.errors import ConflictError, InputError
from scaffold.generate.templates.template import BASE, FOLDERS, MANIFEST, Template


def copy(templates: Mapping[str, Template], kind: str, content: str, name: str = "") -> str:
    """Copy a template into a content directory; return the path of the copy.

    Args:
        templates: All templates.
        kind: The name of a template, optionally with the path of one of its files.
        content: The content directory to copy it to.
        name: The name of the copy; by default that of the template, which it overrides.

    Raises:
        InputError: there is no such template or file.
        ConflictError: the destination exists already.
    """
    original, _, path = kind.partition("/")
    if original not in templates:
        closest = get_close_matches(original, templates, n=1)
        hint = f"; did you mean {closest[0]!r}?" if closest else "; `ros2-scaffold templates`"
        raise InputError(f"there is no template {original!r}{hint}")
    template = templates[original]
    source = os.path.join(template.directory, path)
    if path and not os.path.isfile(source):
        raise InputError(f"the template {original!r} has no file {path!r}")
    folders = [folder for folder, role in FOLDERS.items() if role is template.role]
    names = [BASE] if original == BASE else [*folders, name or original]
    place = os.path.join(content, "templates", *names, *([path] if path else []))
    if os.path.lexists(place):
        raise ConflictError(f"{place} already exists; nothing was written")
    os.makedirs(os.path.dirname(place), exist_ok=True)
    if path:
        shutil.copyfile(source, place)
    else:
        shutil.copytree(source, place, copy_function=shutil.copyfile)
        _rename_in_examples(os.path.join(place, MANIFEST), original, names[-1])
    return place


def _rename_in_examples(path: str, original: str, name: str) -> None:
    """Replace the kind in examples with parts ``KIND:NAME`` by that of the copy."""
    text = Path(path).read_text(encoding="utf-8")
    renamed = re.sub(rf"\b{re.escape(original)}:(?=\w)", f"{name}:", text)
    Path(path).write_text(renamed, encoding="utf-8")
