"""Distributes a check over the workers of a cluster."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Mapping, Sequence

from scaffold import distributions
from scaffold.check.cluster import batch_process
from scaffold.check.cluster.batch import Batch, Checked, Key, Settings, key_of
from scaffold.check.result import Earlier, Result
from scaffold.check.several import AgreedSession
from scaffold.cluster.client import connected
from scaffold.cluster.mirror import Mirror, Packer
from scaffold.errors import EnvironmentMissingError
from scaffold.files.tree import DiskTree
from scaffold.model.discovery.targets import Target
from scaffold.model.package import Package

BATCHES = 4
"""For each thread of the cluster: enough that none waits long for the last one, and few enough
that unpacking the sources for each does not count."""
_INDEX = "share/ament_index/resource_index/packages"


class ClusterSession(AgreedSession):
    """A session that checks packages on a cluster, with the built-in rules."""

    address = ""
    """The address of the scheduler."""
    tell: Callable[[str], None]
    """Called with messages for the user."""
    settings: Settings
    """The settings for the sessions of workers."""

    def run(
        self,
        targets: Sequence[Target],
        earlier: Mapping[str, Earlier] | None = None,  # noqa: ARG002  the contract
    ) -> Iterator[Result]:
        """Check packages on the cluster; yield in the order given.

        Raises:
            EnvironmentMissingError: there is no usable cluster.
        """
        if not targets:
            return
        checked: dict[Key, Checked | None] = {}
        left = [*targets]
        with connected(self.address, self.tell) as cluster:
            batches = self._batches(targets, cluster.threads * BATCHES)
            files = _mirror(targets, self.settings.paths)
            for done in cluster.map(batch_process.check, batches, files):
                if done.result is not None:
                    self.types_failure = self.types_failure or done.result.types_failure
                    checked.update((item.key, item) for item in done.result.checked)
                else:
                    unchecked = batches[done.name].targets
                    checked.update((key, None) for key in unchecked)
                    names = [item.package.name for item in targets if key_of(item) in unchecked]
                    self.unchecked.setdefault(done.error, []).extend(names)
                while left and key_of(left[0]) in checked:
                    target = left.pop(0)
                    yield _result(target, checked.pop(key_of(target)))

    def _batches(self, targets: Sequence[Target], most: int) -> dict[str, Batch]:
        """Split the packages into batches of about equal size, by name."""
        size = -(-len(targets) // most)
        kept = tuple(item.name for item in distributions.kept())
        return {
            str(start): Batch(
                frozenset(map(key_of, targets[start : start + size])),
                self.settings,
                os.getcwd(),
                distributions.target().name,
                kept,
                _variables(),
            )
            for start in range(0, len(targets), size)
        }


def _result(target: Target, checked: Checked | None) -> Result:
    if checked is None:
        return Result(target.package, 0, [])
    return Result(target.package, checked.files, [*checked.diagnostics], None, checked.foreign)


def _variables() -> dict[str, str]:
    """Return the variables by which `check` finds installed packages, with their paths."""
    ros_home = os.environ.get("ROS_HOME") or os.path.join(os.path.expanduser("~"), ".ros")
    prefixes = filter(os.path.isabs, os.environ.get("AMENT_PREFIX_PATH", "").split(os.pathsep))
    return {"ROS_HOME": ros_home, "AMENT_PREFIX_PATH": os.pathsep.join(prefixes)}


def _mirror(targets: Sequence[Target], paths: Sequence[str]) -> Mirror:
    """Pack the packages, those around them, and other accessed files.

    Raises:
        EnvironmentMissingError: a file cannot be read.
    """
    packer = Packer()
    variables = _variables()
    try:
        packer.add(os.path.join(os.getcwd(), ""))
        for package in _packages(targets):
            _add(packer, package)
        for path in filter(os.path.isdir, paths):
            packer.add_tree(path)
            packer.add_above(path)
        for prefix in filter(None, variables["AMENT_PREFIX_PATH"].split(os.pathsep)):
            _add_if_there(packer, os.path.join(prefix, _INDEX))
        _add_if_there(packer, os.path.join(variables["ROS_HOME"], "rosdep", "sources.cache"))
    except OSError as error:
        raise EnvironmentMissingError(
            f"--cluster: {error.filename} cannot be sent: {error.strerror}"
        ) from error
    return packer.mirror()


def _add(packer: Packer, package: Package) -> None:
    packer.add_above(os.path.join(package.directory, "."))
    if isinstance(package.tree, DiskTree) and type(package.tree) is not DiskTree:
        for path in package.files:
            packer.add(os.path.join(package.directory, path))
    else:
        packer.add_tree(package.directory)


def _add_if_there(packer: Packer, directory: str) -> None:
    if os.path.isdir(directory):
        packer.add_tree(directory)


def _packages(targets: Sequence[Target]) -> Iterator[Package]:
    """Yield the packages to check, and those around them."""
    for target in targets:
        yield target.package
    workspaces = {id(item.package.known_workspace): item for item in targets}.values()
    for workspace in (item.package.known_workspace for item in workspaces):
        if workspace is not None:
            yield from workspace
            yield from workspace.around or ()
