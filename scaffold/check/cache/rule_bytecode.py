"""Bytecode of all rule files of a directory in one file of the user's cache.

Finding, opening and reading two hundred files takes longer than executing them. The one file is
used only while no rule file has changed, so it may be deleted at any time.
"""

from __future__ import annotations

import marshal
import os
import sys
from collections.abc import Callable, Sequence
from types import CodeType

from scaffold.files import cache
from scaffold.files.disk import digest, stamp

MAX_ROOTS = 16
_MAGIC = b"scaffold-rules-1\n"


def codes(
    root: str, paths: Sequence[str], compile_one: Callable[[str], CodeType]
) -> list[CodeType]:
    """Return the code of rule files.

    Args:
        root: Their directory.
        paths: The files.
        compile_one: Returns the code of a file.
    """
    kept = cache.directory("rules")
    if kept is None:
        return [compile_one(path) for path in paths]
    place = os.path.join(kept, digest(os.path.abspath(root).encode("utf-8", "surrogateescape")))
    stamps = "\n".join([sys.version, *(f"{path} {stamp(path)}" for path in paths)])
    head = _MAGIC + digest(stamps.encode("utf-8", "surrogateescape")).encode()
    data = cache.read_sealed(place, head)
    if data is not None:
        types: list[CodeType] = marshal.loads(data)  # noqa: S302  own files
        return types
    made = [compile_one(path) for path in paths]
    if cache.write_sealed(place, head, marshal.dumps(made)):
        cache.trim(kept, MAX_ROOTS)
    return made
