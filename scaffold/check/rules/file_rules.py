"""Base classes for rules that read one kind of file and are called once per file."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any

from scaffold.check.rules.rule import Rule
from scaffold.diagnostic import Diagnostic
from scaffold.source import ViewError

if TYPE_CHECKING:
    from scaffold.model.launch.python_file import LaunchFile
    from scaffold.model.messages.inference import MessageTypes
    from scaffold.model.package import Package
    from scaffold.model.python.module import PythonModule
    from scaffold.model.rclpy.file import RclpyFile


class FileRule(Rule):
    """A rule that reads the files of one kind separately.

    A subclass defines ``check_file``, or ``check_in`` if it reads more than the file.
    """

    def check(self, package: Package) -> Iterator[Diagnostic]:
        """Yield the findings in all files."""
        for path in self.paths(package):
            try:
                yield from self.check_path(package, path)
            except ViewError:
                continue

    def paths(self, package: Package) -> Sequence[str]:
        """Return the files that may be of this kind."""
        return package.python_files

    def check_path(self, package: Package, path: str) -> Iterator[Diagnostic]:
        """Yield the findings in a file; raises ViewError if it cannot be read."""
        raise NotImplementedError

    def check_in(self, package: Package, file: Any) -> Iterator[Diagnostic]:  # noqa: ANN401,ARG002
        """Yield the findings in a file, given its package."""
        return self.check_file(file)

    def check_file(self, file: Any) -> Iterator[Diagnostic]:  # noqa: ANN401  see the subclasses
        """Yield what is wrong in a file."""
        raise NotImplementedError

    @property
    def looks_further(self) -> bool:
        """Whether the findings in a file may depend on other files."""
        return type(self).check_in is not FileRule.check_in


class PythonRule(FileRule):
    """A rule that reads every Python file of a package that parses."""

    def check_path(self, package: Package, path: str) -> Iterator[Diagnostic]:
        """Yield the findings in a file; raises ViewError if it cannot be read."""
        return self.check_in(package, package.module(path))

    def check_file(self, module: PythonModule) -> Iterator[Diagnostic]:
        """Yield what is wrong in a file."""
        raise NotImplementedError


class TestRule(FileRule):
    """A rule that reads the Python files that pytest collects."""

    __test__ = False  # not for pytest itself

    def paths(self, package: Package) -> Sequence[str]:
        """Return the files that pytest collects."""
        from scaffold.model.tests import test_paths

        return test_paths(package)

    def check_path(self, package: Package, path: str) -> Iterator[Diagnostic]:
        """Yield the findings in a file; raises ViewError if it cannot be read."""
        return self.check_in(package, package.module(path))

    def check_file(self, module: PythonModule) -> Iterator[Diagnostic]:
        """Yield what is wrong in a file."""
        raise NotImplementedError


class RclpyRule(FileRule):
    """A rule that reads Python files that import rclpy, except for tests."""

    def paths(self, package: Package) -> Sequence[str]:
        """Return the files that import rclpy."""
        from scaffold.model.rclpy.files import rclpy_paths

        return rclpy_paths(package)

    def check_path(self, package: Package, path: str) -> Iterator[Diagnostic]:
        """Yield the findings in a file; raises ViewError if it cannot be read."""
        from scaffold.model.rclpy.file import rclpy_file

        return self.check_in(package, rclpy_file(package, path))

    def check_file(self, file: RclpyFile) -> Iterator[Diagnostic]:
        """Yield what is wrong in a file."""
        raise NotImplementedError


class MessageRule(FileRule):
    """A rule that reads Python files that use message, service or action classes."""

    def paths(self, package: Package) -> Sequence[str]:
        """Return the files that import such classes."""
        from scaffold.model.messages.files import message_paths

        return message_paths(package)

    def check_path(self, package: Package, path: str) -> Iterator[Diagnostic]:
        """Yield the findings in a file; raises ViewError if it cannot be read."""
        from scaffold.model.messages.inference import MessageTypes

        return self.check_in(package, MessageTypes.of(package, path))

    def check_file(self, types: MessageTypes) -> Iterator[Diagnostic]:
        """Yield what is wrong in a file."""
        raise NotImplementedError


class LaunchRule(FileRule):
    """A rule that reads launch files written in Python."""

    def paths(self, package: Package) -> Sequence[str]:
        """Return the files that import launch, except those of tests."""
        from scaffold.model.launch.python_file import launch_paths

        return launch_paths(package)

    def check_path(self, package: Package, path: str) -> Iterator[Diagnostic]:
        """Yield the findings in a file; raises ViewError if it cannot be read."""
        from scaffold.model.launch.python_file import LaunchFile

        return self.check_in(package, LaunchFile.of(package, path))

    def check_file(self, launch: LaunchFile) -> Iterator[Diagnostic]:
        """Yield what is wrong in a file."""
        raise NotImplementedError
