"""Builds packages without running them."""

from __future__ import annotations

import asyncio
import os
from collections.abc import Sequence

from scaffold.model.package import Package
from scaffold.smoke import environment
from scaffold.smoke.building.build import Layout, build
from scaffold.smoke.cleanup import leftovers
from scaffold.smoke.result import Build

TIMEOUT = 900.0
"""Seconds after which a build is given up."""


def only_build(packages: Sequence[Package]) -> dict[str, Build]:
    """Build packages in a temporary directory; return the results by name.

    Raises:
        EnvironmentMissingError: there is no usable ROS 2.
    """
    with leftovers.recorded_run() as run:
        selected = environment.select(os.environ, origin=run.origin)
        layout = Layout.below(run.scratch / "workspace")
        return asyncio.run(
            build(selected, packages, layout, run.scratch, origin=run.origin, timeout=TIMEOUT)
        )
