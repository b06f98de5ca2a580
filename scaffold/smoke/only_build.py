"""Building packages without running them."""

from __future__ import annotations

import asyncio
import os
import tempfile
import uuid
from collections.abc import Sequence
from pathlib import Path

from scaffold.model.package import Package
from scaffold.smoke import environment, process
from scaffold.smoke.build import Layout, build
from scaffold.smoke.result import Build

TIMEOUT = 900.0
"""Seconds after which a build is given up."""


def only_build(packages: Sequence[Package]) -> dict[str, Build]:
    """Build packages in a directory that is removed; return what became of each, by name.

    Raises:
        EnvironmentMissingError: there is no ROS 2 to do it with.
    """
    found = environment.select(os.environ)
    mark = uuid.uuid4().hex
    with tempfile.TemporaryDirectory(prefix="ros2-scaffold-build-") as directory:
        scratch = Path(directory)
        layout = Layout.below(scratch / "workspace")
        try:
            return asyncio.run(build(found, packages, layout, scratch, mark=mark, timeout=TIMEOUT))
        finally:
            process.sweep(mark)
