"""Adds programs, tests, directories, interfaces and compiled code to CMakeLists.txt."""

from __future__ import annotations

from scaffold.generate.edit import cmake_compiled
from scaffold.generate.edit.addition import Addition, Outcome, inside
from scaffold.generate.edit.cmake_editor import Editor
from scaffold.source import Source


def add_to_cmake(source: Source, addition: Addition, *, python_package: bool = False) -> Outcome:
    """Install a program and directories, and run a test, unless the file does so already.

    Args:
        source: The file.
        addition: What is added.
        python_package: Install the Python package with the name of the project, too.

    Raises:
        ParseError: CMake could not parse the file.
    """
    editor = Editor(source, addition.package)
    if addition.interfaces:
        cmake_compiled.add_interfaces(editor, addition)
    if addition.compiled is not None:
        cmake_compiled.add_compiled(editor, addition.compiled)
    if python_package:
        editor.install_python()
    if addition.program is not None:
        editor.install_program(addition.program.path)
    for directory in addition.directories:
        editor.install_directory(directory, inside(addition, directory))
    if addition.test is not None:
        editor.add_test(addition.test)
    return Outcome(editor.lists.source, tuple(editor.by_hand))
