"""The keys in rosdep's local cache.

``rosdep update`` stores each of its sources as a pickle of plain dictionaries. Unpickling can
execute code, so only plain containers and strings are allowed. Loading them all takes longer than
checking a package, so a key is first searched in the raw bytes.
"""

from __future__ import annotations

import os
import pickle
import re
from collections.abc import Mapping, Sequence
from io import BytesIO
from typing import TYPE_CHECKING

from scaffold import distributions

if TYPE_CHECKING:
    from scaffold.files.disk import Disk

_DISTROS = distributions.ENDED.union(distributions.NAMES)
MAX_BYTES = 50_000_000
"""The size limit of a source; that of a distribution has less than one million bytes."""


class RosdepKeys:
    """The keys of some sources.

    Args:
        sources: The pickles of the sources.
    """

    def __init__(self, sources: Sequence[bytes]) -> None:
        self._sources = sources
        self._results: dict[str, bool] = {}
        self._all: frozenset[str] | None = None

    def resolves(self, key: str) -> bool | None:
        """Return whether a key has a rule for any system; ``None`` if a source is damaged."""
        if key not in self._results:
            if any(_has_key(source, key) for source in self._sources):
                self._results[key] = True
            else:
                everything = self._all_keys()
                if everything is None:
                    return None
                self._results[key] = key in everything
        return self._results[key]

    def _all_keys(self) -> frozenset[str] | None:
        if self._all is None:
            all_keys: set[str] = set()
            for source in self._sources:
                keys = _keys(source)
                if not keys:
                    return None
                all_keys |= keys
            self._all = frozenset(all_keys)
        return self._all


def cached_keys(disk: Disk, variables: Mapping[str, str] = os.environ) -> RosdepKeys | None:
    """Return the keys of rosdep's cache; ``None`` if it lacks sources of the target.

    Args:
        disk: Records what was accessed.
        variables: The environment: ``ROS_HOME``, ``HOME``.
    """
    ros_home = variables.get("ROS_HOME") or os.path.join(os.path.expanduser("~"), ".ros")
    cache = os.path.join(ros_home, "rosdep", "sources.cache")
    try:
        index = disk.read_renewed(os.path.join(cache, "index")).decode()
    except (OSError, ValueError):
        return None
    target = distributions.target().name
    sources: list[bytes] = []
    kinds: set[str] = set()
    for line in index.splitlines():
        kind, _, rest = line.strip().partition(" ")
        url, *tags = rest.split() or [""]
        if kind != "yaml" or not url or not (_DISTROS - {target}).isdisjoint(tags):
            continue
        try:
            sources.append(disk.read_renewed(os.path.join(cache, _file_of(url)), MAX_BYTES))
        except OSError:
            return None
        kinds.add(target if target in tags else "" if not tags else "other")
    return RosdepKeys(sources) if {target, ""} <= kinds else None


def _file_of(url: str) -> str:
    from hashlib import sha1

    return f"{sha1(url.encode(), usedforsecurity=False).hexdigest()}.pickle"


def _has_key(source: bytes, key: str) -> bool:
    """Return whether the bytes contain a key: a memoized string before a dictionary.

    In protocol 2, which rosdep writes: ``X``, the length, the string, ``q`` or ``r`` with
    the memo index, ``}``.
    """
    text = key.encode()
    start = b"X" + len(text).to_bytes(4, "little") + text
    at = source.find(start)
    while at >= 0:
        end = at + len(start)
        if re.match(rb"(?:q.|r....)\}", source[end : end + 6], re.DOTALL):
            return True
        at = source.find(start, end)
    return False


class _PlainUnpickler(pickle.Unpickler):
    """Loads containers, strings and numbers; pickles that import anything are rejected."""

    def find_class(self, module_name: str, global_name: str) -> object:
        raise pickle.UnpicklingError(f"{module_name}.{global_name} is no plain data")


def _keys(source: bytes) -> frozenset[str] | None:
    """Return the keys of a source; ``None`` if it has another form."""
    if len(source) > MAX_BYTES:
        return None
    try:
        data = _PlainUnpickler(BytesIO(source)).load()
    except Exception:  # noqa: BLE001  a damaged pickle may raise anything
        return None
    if not isinstance(data, dict) or not all(isinstance(key, str) for key in data):
        return None
    return frozenset(data)
