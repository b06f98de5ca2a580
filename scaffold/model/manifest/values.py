"""Validation of the values in package.xml, for each format."""

from __future__ import annotations

import re

NAME = r"[a-z][a-z0-9]*(_[a-z0-9]+)*"
_NUMBER = r"(0|[1-9][0-9]*)"
VERSION = rf"{_NUMBER}\.{_NUMBER}\.{_NUMBER}"
LIMIT = rf"{_NUMBER}(\.{_NUMBER}){{0,2}}"
_LOCAL = r"[-a-zA-Z0-9_%+]+"
_DOMAIN = r"[-a-zA-Z0-9%]+"
EMAIL = rf"{_LOCAL}(\.{_LOCAL})*@{_DOMAIN}(\.{_DOMAIN})*\.[a-zA-Z]{{2,}}"
GROUP_CONDITION = r"[$A-Za-z0-9_ <>!=()-]*"
CONDITION = r"[$A-Za-z0-9_ \"'<>!=()-]*"
URL_TYPES = ("website", "bugtracker", "repository")


def fits(pattern: str, value: str) -> bool:
    """Return whether a normalized value matches a pattern completely."""
    return re.fullmatch(pattern, value) is not None


_HIGHEST_PORT = 2**31 - 1


def is_uri(value: str) -> bool:
    """Return whether a value is a URI or a relative reference.

    As in schemas, characters that would have to be escaped (spaces, quotes, anything outside of
    ASCII) may be written as they are.
    """
    plain = re.sub(r"[ <>\"{}|\\^`]|[^\x00-\x7f]", "_", value)
    character = r"[A-Za-z0-9._~!$&'()*+,;=@:-]|%[0-9A-Fa-f]{2}"
    segments = rf"(?:/(?:{character})*)*"
    host = rf"(?:\[[^\]]*\]|(?:{character.replace('@:', '')})*)"
    authority = rf"//(?:(?:{character.replace('@', '')})*@)?{host}(?::(?P<port>[0-9]+))?"
    behind = rf"(?:{character}|[/?])*"
    rootless = rf"(?:{character})+{segments}"
    schemeless = rf"(?:{character.replace(':', '')})+{segments}"
    absolute = rf"/(?:(?:{character})+{segments})?"
    fragment = rf"(?:{character}|[/?\[\]])*"
    tail = rf"(?:\?{behind})?(?:#{fragment})?"
    for start, path in ((r"[A-Za-z][A-Za-z0-9+.-]*:", rootless), ("", schemeless)):
        whole = rf"{start}(?:{authority}{segments}|{absolute}|{path}|){tail}"
        match = re.fullmatch(whole, plain)
        port = (match["port"] or "").lstrip("0") if match else ""
        if match and len(port) <= len(str(_HIGHEST_PORT)) and int(port or 0) <= _HIGHEST_PORT:
            return True
    return False
