"""A cache of compiled Jinja templates in the user's cache."""

from __future__ import annotations

import os

from jinja2 import BytecodeCache
from jinja2.bccache import Bucket

from scaffold.files import cache

_HEAD = b"scaffold-template-2\n"
_MAX_FILES = 500
"""The maximum number of cached templates per form."""


class Compiled(BytecodeCache):
    """A bytecode cache; Jinja checks that an entry matches the source.

    A cache that cannot be read or written is ignored.

    Args:
        form: Distinguishes compiled code that differs for the same text.
    """

    def __init__(self, form: str) -> None:
        self._kept = cache.directory(f"templates_{form}")

    def load_bytecode(self, bucket: Bucket) -> None:
        """Load cached code into a bucket."""
        data = (
            cache.read_sealed(os.path.join(self._kept, bucket.key), _HEAD) if self._kept else None
        )
        if data is not None:
            bucket.bytecode_from_string(data)

    def dump_bytecode(self, bucket: Bucket) -> None:
        """Save the code of a bucket."""
        if self._kept is None:
            return
        place = os.path.join(self._kept, bucket.key)
        if cache.write_sealed(place, _HEAD, bucket.bytecode_to_string()):
            cache.trim(self._kept, _MAX_FILES)
