"""Names of Debian packages, which are no keys of rosdep."""

from __future__ import annotations

import re

from scaffold.api.distributions import ENDED, NAMES

_OF_ROS = re.compile(rf"ros-({'|'.join((*NAMES, *sorted(ENDED)))})-(.+)")


def key_of_debian(name: str) -> str:
    """Return the key of rosdep for ``ros-jazzy-std-msgs``; nothing for other names."""
    debian = _OF_ROS.fullmatch(name)
    return debian[2].replace("-", "_") if debian else ""
