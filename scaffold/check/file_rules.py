"""Rules that read one kind of file: they say which, and are asked file by file."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from scaffold.check.rule import Rule
from scaffold.diagnostic import Diagnostic

if TYPE_CHECKING:
    from scaffold.model.launch.python_file import LaunchFile
    from scaffold.model.messages.inference import MessageTypes
    from scaffold.model.package import Package
    from scaffold.model.python.module import PythonModule
    from scaffold.model.rclpy.file import RclpyFile


class PythonRule(Rule):
    """Reads every Python file of a package that can be parsed."""

    def check(self, package: Package) -> Iterator[Diagnostic]:
        """Yield what is wrong in any of the files."""
        for module in package.modules():
            yield from self.check_file(module)

    def check_file(self, module: PythonModule) -> Iterator[Diagnostic]:
        """Yield what is wrong in a file."""
        raise NotImplementedError


class TestRule(Rule):
    """Reads the Python files that pytest collects."""

    __test__ = False  # not for pytest itself

    def check(self, package: Package) -> Iterator[Diagnostic]:
        """Yield what is wrong in any of the files."""
        from scaffold.model.tests import test_modules

        for module in test_modules(package):
            yield from self.check_file(module)

    def check_file(self, module: PythonModule) -> Iterator[Diagnostic]:
        """Yield what is wrong in a file."""
        raise NotImplementedError


class RclpyRule(Rule):
    """Reads the Python files that import rclpy, tests aside: those try what nodes must not do."""

    def check(self, package: Package) -> Iterator[Diagnostic]:
        """Yield what is wrong in any of the files."""
        from scaffold.model.rclpy.file import rclpy_files

        for file in rclpy_files(package):
            yield from self.check_file(file)

    def check_file(self, file: RclpyFile) -> Iterator[Diagnostic]:
        """Yield what is wrong in a file."""
        raise NotImplementedError


class MessageRule(Rule):
    """Reads the Python files that use classes of messages, services or actions."""

    def check(self, package: Package) -> Iterator[Diagnostic]:
        """Yield what is wrong in any of the files."""
        from scaffold.model.messages.inference import MessageTypes

        for types in MessageTypes.of_package(package):
            yield from self.check_file(types)

    def check_file(self, types: MessageTypes) -> Iterator[Diagnostic]:
        """Yield what is wrong in a file."""
        raise NotImplementedError


class LaunchRule(Rule):
    """Reads the launch files that are written in Python."""

    def check(self, package: Package) -> Iterator[Diagnostic]:
        """Yield what is wrong in any of the files."""
        from scaffold.model.launch.python_file import LaunchFile

        for launch in LaunchFile.of_package(package):
            yield from self.check_file(launch)

    def check_file(self, launch: LaunchFile) -> Iterator[Diagnostic]:
        """Yield what is wrong in a file."""
        raise NotImplementedError
