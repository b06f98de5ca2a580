"""Adds interfaces and C++ programs to CMakeLists.txt."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from scaffold.errors import ConflictError, InputError
from scaffold.generate.edit.addition import Addition, Compiled
from scaffold.generate.edit.cmake_editor import INSTALL_PYTHON, Editor
from scaffold.model.cmake import edit as cmake_edit
from scaffold.model.cmake.edit import Edits
from scaffold.model.cmake.lists import CMakeLists, Install
from scaffold.model.cmake.parser import Argument, Command
from scaffold.model.cmake.rosidl import GENERATE, Generation, generations_of

GENERATORS = "rosidl_default_generators"
RUNTIME = "rosidl_default_runtime"
_MAKERS = ("add_library", "add_executable")
"""Commands whose first argument is a target, ``ament_auto_add_library`` among them, end so."""
_ADD_TEST = "ament_add_test"
_EXPORT = "ament_export_dependencies"
_LANGUAGES = ("C", "CXX", "CUDA", "OBJC", "OBJCXX", "Fortran", "HIP", "ISPC", "Swift", "ASM")
_STANDARD = "cxx_std_17"


def add_interfaces(editor: Editor, addition: Addition) -> None:
    """Generate code for interfaces, in an existing call or a new one.

    Raises:
        InputError: something else in the package has the name that the generated code needs.
    """
    for path in addition.interfaces:
        generation = _generation(editor.lists)
        if generation is None:
            _refuse_conflict(editor.lists)
        elif any(listed.path == path for listed in generation.files):
            for name in addition.interface_depends:
                editor.edit(cmake_edit.insert_find_package(editor.lists, name))
                _add_dependency(editor, name)
            continue
        elif not generation.files:
            editor.refuse(f'"{path}"', f"the files of {GENERATE}() are not a literal list")
            continue
        line = f'{GENERATE}(${{PROJECT_NAME}} "{path}")'
        if editor.refused(line):
            continue
        before = editor.lists
        _enable(editor, "C", "CXX")
        for name in [GENERATORS, *addition.interface_depends]:
            editor.edit(cmake_edit.insert_find_package(editor.lists, name))
        generation = _generation(editor.lists)
        editor.edit(
            _list_file(editor.lists, generation, path) if generation else _block(editor.lists, path)
        )
        for name in addition.interface_depends:
            _add_dependency(editor, name)
        _export_runtime(editor)
        generation = _generation(editor.lists)
        if generation is None or path not in [listed.path for listed in generation.files]:
            editor.lists = before
            editor.refuse(line, "the end of the file is not always reached")


def add_compiled(editor: Editor, program: Compiled) -> None:
    """Build a C++ program and install it where ``ros2 run`` looks for it.

    Raises:
        ConflictError: a target has its name already.
    """
    for command in _defining_commands(editor.lists, program.name):
        if program.source in (editor.lists.expand_list(command.arguments[1:], command) or ()):
            return
        at = command.location
        raise ConflictError(
            f"{at.path}:{at.line}:{at.column}: {command.name}() already defines a target "
            f"{program.name!r}; choose another name"
        )
    lines = [
        f"add_executable({program.name} {program.source})",
        f"target_compile_features({program.name} PRIVATE {_STANDARD})",
    ]
    install = f"install(TARGETS {program.name} DESTINATION lib/${{PROJECT_NAME}})"
    if editor.refused(f"{lines[0]} and {install}"):
        return
    before = editor.lists
    _enable(editor, "CXX")
    old = _installed_targets(editor.lists, editor.package)
    behind = _last_target(editor.lists, before=old.command if old else None)
    if old is not None and behind is not None:
        for line in reversed(lines):
            editor.edit(cmake_edit.insert_below(editor.lists, behind, line))
        old = _installed_targets(editor.lists, editor.package) or old
        last = old.items[-1].argument
        editor.edit(cmake_edit.append_arguments(editor.lists, old.command, last, [program.name]))
    else:
        block = [*lines, "", "install(", "  TARGETS", f"    {program.name}"]
        block += ["  DESTINATION lib/${PROJECT_NAME}", ")"]
        editor.edit(cmake_edit.insert_before_end(editor.lists, block))
    _run_in_tests(editor, program.name)
    if not any(_defining_commands(editor.lists, program.name)):
        editor.lists = before
        editor.refuse(f"{lines[0]} and {install}", "no safe place to insert it")


def _defining_commands(lists: CMakeLists, name: str | None) -> Iterator[Command]:
    """Yield the commands that define a target."""
    for command in lists.commands:
        makes = command.name.endswith(_MAKERS)
        if makes and lists.expand_list(command.arguments[:1], command) == [name]:
            yield command


def _run_in_tests(editor: Editor, name: str) -> None:
    """Run a program when tests are built: it passes when it ends without an error."""
    lists = editor.lists
    lines = (
        f"{_ADD_TEST}({name}_runs",
        f"  COMMAND $<TARGET_FILE:{name}> GENERATE_RESULT_FOR_RETURN_CODE_ZERO)",
    )
    block = cmake_edit.testing_block(lists)
    others = [
        call for call in lists.find(_ADD_TEST) if block is not None and call.branch is block[0]
    ]
    if not others:
        editor.edit(cmake_edit.insert_in_testing(lists, lines))
        return
    start = lists.source.text.rfind("\n", 0, others[-1].start) + 1
    indent = lists.source.text[start : others[-1].start]
    text = f"{lists.source.newline}{indent}".join(lines)
    editor.edit(cmake_edit.insert_below(lists, others[-1], text))


# -- interfaces


def _generation(lists: CMakeLists) -> Generation | None:
    """Return the call that generates the interfaces of the package, outside of tests."""
    for item in generations_of(lists):
        if not item.for_tests and "SKIP_INSTALL" not in item.options and item.command.depth == 0:
            return item
    return None


def _refuse_conflict(lists: CMakeLists) -> None:
    """Raise if a target or a Python package has the name that generated code would have."""
    name = lists.project_name
    python = [
        command
        for command in lists.find(INSTALL_PYTHON)
        if lists.expand_list(command.arguments[:1], command) == [name]
    ]
    for command in [*_defining_commands(lists, name), *python]:
        at = command.location
        raise InputError(
            f"{at.path}:{at.line}:{at.column}: {command.name}() makes something with the name "
            f"{name!r}, and so would the generated code of interfaces: put them into a package "
            f"of their own, such as {name}_interfaces"
        )


def _list_file(lists: CMakeLists, generation: Generation, path: str) -> Edits | None:
    """Add a file after the last one of its kind."""
    ending = path.rpartition(".")[2]
    like = [file for file in generation.files if file.path.endswith(f".{ending}")]
    last = (like or generation.files)[-1].argument
    holder = _command_of(lists, last)
    if holder is None:
        return None
    written = f'"{path}"' if last.quoted else cmake_edit.quote(path)
    return cmake_edit.append_arguments(lists, holder, last, [written], raw=True)


def _command_of(lists: CMakeLists, argument: Argument) -> Command | None:
    """Return the command that an argument belongs to."""
    for command in lists.commands:
        if command.start <= argument.start < command.end:
            return command
    return None


def _block(lists: CMakeLists, path: str) -> Edits | None:
    lines = [f"{GENERATE}(${{PROJECT_NAME}}", f'  "{path}"', ")"]
    return cmake_edit.insert_before_end(lists, lines)


def _add_dependency(editor: Editor, name: str) -> None:
    """Add a package whose types the interfaces use to the dependencies."""
    generation = _generation(editor.lists)
    if generation is None or generation.dependencies is None or name in generation.dependencies:
        return
    command = generation.command
    given = command.keyword("DEPENDENCIES", {"LIBRARY_NAME", "ADD_LINTER_TESTS", "SKIP_INSTALL"})
    keyword = [argument for argument in command.arguments if argument.value == "DEPENDENCIES"]
    last = [*command.arguments, *keyword, *given][-1]
    words = [name] if keyword else [f"DEPENDENCIES {name}"]
    editor.edit(cmake_edit.append_arguments(editor.lists, command, last, words, raw=True))


def _export_runtime(editor: Editor) -> None:
    calls = editor.lists.find(_EXPORT)
    if not any(call.has(RUNTIME) for call in calls):
        line = f"{_EXPORT}({RUNTIME})"
        editor.edit(cmake_edit.insert_before_end(editor.lists, [line]))


# -- programs and languages


def _enable(editor: Editor, *languages: str) -> None:
    """Enable compilers, which ``project(name NONE)`` disables."""
    project = editor.lists.project
    if project is None:
        return
    written = [
        argument for argument in project.arguments[1:] if argument.value in {*_LANGUAGES, "NONE"}
    ]
    if not written:
        return
    none = [item for item in written if item.value == "NONE"]
    missing = [
        language for language in languages if language not in [other.value for other in written]
    ]
    if none and len(languages) > 1 and not project.has("LANGUAGES"):
        editor.edit(cmake_edit.remove_argument(editor.lists, none[0]))
    elif none:
        editor.edit(cmake_edit.replace_argument(editor.lists, none[0], missing[0]))
        _enable(editor, *languages)
    elif missing:
        editor.edit(cmake_edit.append_arguments(editor.lists, project, written[-1], missing))


def _installed_targets(lists: CMakeLists, package: str) -> Install | None:
    """Return the install command of targets with only a destination."""
    for install in lists.installs:
        is_plain = [argument.value for argument in install.command.arguments[:1]] == ["TARGETS"]
        if (
            is_plain
            and install.command.name == "install"
            and install.command.depth == 0
            and set(install.destinations) == {""}
            and install.destinations[""] == f"lib/{package}"
            and not install.command.has("EXPORT")
            and install.items
        ):
            return install
    return None


def _last_target(lists: CMakeLists, before: Command | None) -> Command | None:
    """Return the last command about a target above the one that installs it."""
    commands: Sequence[Command] = [
        command
        for command in lists.commands
        if (command.name == "add_executable" or "target_" in command.name)
        and command.depth == 0
        and before is not None
        and command.index < before.index
    ]
    return commands[-1] if commands else None
