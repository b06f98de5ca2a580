"""Adds executables, packages and data files to setup.py."""

from __future__ import annotations

import ast
from collections.abc import Callable, Sequence
from fnmatch import fnmatchcase

from scaffold.edits import Edit
from scaffold.generate.edit.addition import Addition, ByHand, Outcome, Program, inside, spliced
from scaffold.model.python.evaluation.values import UNKNOWN, Glob
from scaffold.model.python.module import PythonModule
from scaffold.model.setup_py import edit as setup_edit
from scaffold.model.setup_py import edit as setup_keywords
from scaffold.model.setup_py.data_files import DataFile
from scaffold.model.setup_py.globs import matches
from scaffold.model.setup_py.keywords import FindPackages
from scaffold.model.setup_py.setup_py import SetupPy
from scaffold.source import Source

PYTEST = "python3-pytest"
"""The rosdep key of pytest."""
_EXTRA = "extras_require={'test': ['pytest']}"


def add_to_setup(
    source: Source, addition: Addition, *, entry_point: bool = True, extra: bool = False
) -> Outcome:
    """Make a program an executable, and install its package and new directories.

    Args:
        source: The file.
        addition: What is added.
        entry_point: Declare the executable here, and not in setup.cfg.
        extra: Say that the tests need pytest.

    Raises:
        ViewError: the file cannot be parsed.
    """
    editor = _Editor(source, addition.package)
    if addition.program is not None:
        editor.install_package(addition.program)
        if entry_point:
            editor.add_entry_point(addition.program)
    for directory in addition.directories:
        editor.install_directory(directory, inside(addition, directory))
    if extra and addition.test is not None:
        editor.add_extra()
    return Outcome(editor.setup.module.source, tuple(editor.by_hand))


def installs_package(setup: SetupPy, name: str) -> bool | None:
    """Return whether an import package is installed; ``None`` if unknown."""
    packages = setup.packages
    if isinstance(packages, FindPackages):
        if not isinstance(packages.include, tuple) or not isinstance(packages.exclude, tuple):
            return None
        return any(fnmatchcase(name, item) for item in packages.include) and not any(
            fnmatchcase(name, item) for item in packages.exclude
        )
    if isinstance(packages, list | tuple) and name in packages:
        return True
    if any(point.module.rpartition(".")[0] == name for point in setup.console_scripts):
        return True  # programs of that package are installed already, in some way
    return False if isinstance(packages, list | tuple) else None


def _is_for(data: DataFile, path: str, share: str) -> bool:
    """Return whether an entry of data_files is for a directory."""
    return str(data.destination).rstrip("/") == share or any(
        str(source.pattern if isinstance(source, Glob) else source).startswith(f"{path}/")
        for source in data.sources
    )


def _installs(data: DataFile, path: str) -> bool:
    """Return whether an entry of data_files installs a file; in doubt it does."""
    return not data.complete or any(
        source is UNKNOWN
        or (bool(matches(source, [path])) if isinstance(source, Glob) else source == path)
        for source in data.sources
    )


class _Editor:
    """A setup.py that is edited step by step and parsed again after each."""

    def __init__(self, source: Source, package: str) -> None:
        self.package = package
        self.by_hand: list[ByHand] = []
        self.setup = _read(source)

    def install_package(self, program: Program) -> None:
        name = program.module.rpartition(".")[0]
        installed = installs_package(self.setup, name)
        if installed:
            return
        line = f"packages=['{name}'],"
        if installed is None:
            self._refuse(line, f"it is not clear whether packages= includes {name!r}")
            return
        self._edit(lambda setup: _package_edit(setup, self._expression(name)))
        if not installs_package(self.setup, name):
            self._refuse(line, f"packages= does not include {name!r}")

    def add_entry_point(self, program: Program) -> None:
        if self._has_entry_point(program):
            return
        line = f"'{program.name} = {program.entry_point}',"
        self._edit(
            lambda setup: (
                setup_edit.add_console_script(setup, program.name, program.entry_point)
                or _text_entry(setup, program)
            )
        )
        if not self._has_entry_point(program):
            self._refuse(line, "console_scripts in setup() is not a literal list")

    def install_directory(self, path: str, files: Sequence[str] = ()) -> None:
        """Install the files of a directory to ``share/<package>``, with its name."""
        share = f"share/{self.package}/{path}"
        if not self._data_of(path, share):
            self._add_glob(path, share)
            return
        for file in files:
            if not any(_installs(data, file) for data in self._data_of(path, share)):
                self._add_file(file, path, share)

    def _data_of(self, path: str, share: str) -> list[DataFile]:
        """Return the entries of data_files that are for a directory."""
        return [data for data in self.setup.data_files if _is_for(data, path, share)]

    def _add_glob(self, path: str, share: str) -> None:
        imports_module = any(
            alias.name == "glob" and alias.asname is None
            for node in self.setup.module.walk(ast.Import)
            for alias in node.names
        )
        where = self._destination(path, share)
        files = f"{'glob.glob' if imports_module else 'glob'}({self._quoted(f'{path}/*')})"
        before = self.setup
        self._edit(lambda setup: setup_edit.add_data_files(setup, where, files))
        if self.setup is before:
            self._refuse(f"({where}, {files}),", "data_files is not a literal list")
        elif not imports_module:
            self._edit(lambda s: setup_edit.add_import(s.module, "from glob import glob"))

    def _add_file(self, file: str, path: str, share: str) -> None:
        """Install a file that no entry for its directory matches."""
        before, module = self.setup, self.setup.module
        where, written = self._destination(path, share), self._quoted(file)
        written_out = [
            data.node.elts
            for data in self._data_of(path, share)
            if str(data.destination).rstrip("/") == share and not data.conditional
            if isinstance(data.node, ast.Tuple)
        ]
        lists = [files for _, files in written_out if isinstance(files, ast.List)]
        if lists:
            files = lists[0]
            self._edit(lambda s: setup_edit.append_item(s.module, files, files.elts, written))
        else:
            where = module.text(written_out[0][0]) if written_out else where
            self._edit(lambda setup: setup_edit.add_data_files(setup, where, f"[{written}]"))
        if self.setup is before:
            self._refuse(f"({where}, [{written}]),", "data_files is not a literal list")

    def _destination(self, path: str, share: str) -> str:
        """Return the expression for a directory below ``share``."""
        name = setup_edit.package_expression(self.setup, self.package)
        if name is None:
            return self._quoted(share)
        return f"{self._quoted('share/')} + {name} + {self._quoted(f'/{path}')}"

    def _quoted(self, text: str) -> str:
        """Return a literal with the quotes that setup.py prefers."""
        quote = setup_edit.quote_of(self.setup)
        return f"{quote}{text}{quote}"

    def add_extra(self) -> None:
        has_tests = any(self.setup.keyword(name) for name in ("extras_require", "tests_require"))
        if has_tests or self.setup.has_unknown_keywords:
            return
        before = self.setup
        self._edit(lambda setup: setup_keywords.insert(setup, _EXTRA))
        if self.setup is before:
            self._refuse(f"{_EXTRA},", "the arguments of setup() are not literal")

    def _has_entry_point(self, program: Program) -> bool:
        return any(
            point.name == program.name and point.module == program.module
            for point in self.setup.console_scripts
        )

    def _expression(self, name: str) -> str:
        """Return a name as an expression: the variable with it in setup.py, or a literal."""
        return setup_edit.package_expression(self.setup, name) or self._quoted(name)

    def _edit(self, make: Callable[[SetupPy], Edit | None]) -> None:
        edit = make(self.setup)
        if edit is not None:
            self.setup = _read(spliced(self.setup.module.source, [edit]))

    def _refuse(self, line: str, reason: str) -> None:
        self.by_hand.append(ByHand(self.setup.module.path, line, reason))


def _read(source: Source) -> SetupPy:
    return SetupPy(PythonModule.parse(source))


def _package_edit(setup: SetupPy, expression: str) -> Edit | None:
    word = setup.keyword("packages")
    node = word.node if word is not None else None
    if isinstance(node, ast.List) and not node.elts:
        return Edit(setup.module.path, *setup.module.span(node), f"[{expression}]")
    if isinstance(node, ast.List):
        return setup_edit.append_item(setup.module, node, node.elts, expression)
    return None


def _text_entry(setup: SetupPy, program: Program) -> Edit | None:
    """Add a line to console scripts in a single string."""
    points = setup.console_scripts
    if not points or not setup.entry_points_complete:
        return None
    last = points[-1]
    source = setup.module.source
    start = source.offset(last.location.line, last.location.column)
    line_start = source.text.rfind("\n", 0, start) + 1
    indent = source.text[line_start:start]
    if indent.strip() or not setup.module.text(last.node).endswith(('"""', "'''")):
        return None
    end = source.offset(last.location.end_line, last.location.end_column)
    glue = " = " if " = " in last.text else "="
    text = f"{source.newline}{indent}{program.name}{glue}{program.entry_point}"
    return Edit(setup.module.path, end, end, text)
