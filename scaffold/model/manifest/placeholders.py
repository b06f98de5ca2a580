"""Placeholder text that a generator wrote."""

from __future__ import annotations

import re

_WORDS = r"(?i)(todo|fixme|tbd|change[ _-]?me|your[ _-](?:name|email|license|description))\b"
_ADDRESSES = (
    r"(?i)[^@]*@(?:todo\.\w+|todo|your[-_.]?domain\.\w+|domain\.tld|email\.(?:com|todo))"
    r"|(?:your|user|you|my)[._-]?(?:email|mail|name)@\S*"
)


def is_placeholder(text: str) -> bool:
    """Return whether a text is only a placeholder.

    ``TODO: Package description`` is what ``ros2 pkg create`` writes.
    """
    return re.match(_WORDS, text.strip()) is not None


def is_placeholder_address(address: str) -> bool:
    """Return whether an email address is a placeholder, such as ``user@todo.todo``."""
    return re.fullmatch(_ADDRESSES, address.strip()) is not None
