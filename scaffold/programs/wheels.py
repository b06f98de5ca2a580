"""Finds the ROS 2 distribution whose wheels a Python environment contains."""

from __future__ import annotations

import os
from glob import escape, glob

from scaffold import distributions
from scaffold.distributions import Distribution
from scaffold.programs import installation


def of(prefix: str) -> str:
    """Return the name of the distribution; the default, if no wheel has one.

    Args:
        prefix: The Python environment.
    """
    packages = f"{escape(prefix)}/lib/python*/site-packages"
    names = (name for name in distributions.NAMES if glob(f"{packages}/ros_{name}_*.dist-info"))
    return next(names, distributions.DEFAULT)


def command(distribution: Distribution) -> str:
    """Return the command that installs the wheels of a distribution; empty if it has none."""
    extra = str(distribution.fact("wheels.extra"))
    return installation.command(extra) if extra else ""


def command_apart(distribution: Distribution) -> str:
    """Return the same command for a separate environment; empty if there are no wheels."""
    extra = str(distribution.fact("wheels.extra"))
    return installation.apart(extra) if extra else ""


def container(distribution: Distribution, paths: list[str]) -> str:
    """Return the command that runs ``smoke`` in a container with a distribution.

    Args:
        distribution: The distribution of the image.
        paths: The arguments of ``smoke``, below the current directory.
    """
    from shlex import join, quote

    source = installation.source()
    mount = f"-v {quote(source)}:/tool:ro " if os.path.isabs(source) else ""
    tool = "/tool" if mount else source
    steps = (
        "apt-get update",
        "apt-get install -y git pipx",
        "rosdep update",
        f"rosdep install --from-paths {join(paths)} --ignore-src -y",
        f"pipx run --spec {quote(tool)} {installation.PROJECT} smoke {join(paths)}",
    )
    image = f"ros:{distribution.name}"
    return (
        f'docker run --rm -it -v "$PWD":/ws {mount}-w /ws {image} bash -c '
        f"{quote(' && '.join(steps))}"
    )
