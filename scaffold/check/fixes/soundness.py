"""Rejects fixes after which an edited file no longer parses."""

from __future__ import annotations

from collections.abc import Callable

from scaffold.source import ParseError, Source


def reader_of(path: str) -> Callable[[str, str], None] | None:
    """Return a parser for files of this kind, given path and text, which raises for broken ones.

    ``None`` for unsupported files.
    """
    name = path.rpartition("/")[2]
    if name == "CMakeLists.txt":
        return _read_cmake
    return _READERS.get(name.rpartition(".")[2]) if "." in name else None


def breaks(path: str, before: str, after: str) -> bool:
    """Return whether a file parses before an edit but not after it."""
    read = reader_of(path)
    return read is not None and not _is_read(read, path, after) and _is_read(read, path, before)


def _is_read(read: Callable[[str, str], None], path: str, text: str) -> bool:
    try:
        read(path, text)
    except (SyntaxError, ValueError, RecursionError, MemoryError, ParseError):
        return False
    return True


def _read_python(path: str, text: str) -> None:
    import ast
    import warnings

    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        ast.parse(text.removeprefix("\ufeff"), path)


def _read_xml(path: str, text: str) -> None:
    from scaffold.formats import xml_reader

    xml_reader.parse(Source(path, text))


def _read_cmake(path: str, text: str) -> None:
    from scaffold.model.cmake.lists import CMakeLists

    for at, message in CMakeLists.parse(Source(path, text)).errors:
        raise ParseError(at, message)


def _read_yaml(path: str, text: str) -> None:
    from scaffold.formats import yaml as yaml_tree

    yaml_tree.parse(Source(path, text))


def _read_ini(path: str, text: str) -> None:
    from scaffold.formats.ini import IniFile

    IniFile.parse(Source(path, text))


_READERS: dict[str, Callable[[str, str], None]] = {
    "py": _read_python,
    "xml": _read_xml,
    "xacro": _read_xml,
    "urdf": _read_xml,
    "launch": _read_xml,
    "cmake": _read_cmake,
    "yaml": _read_yaml,
    "yml": _read_yaml,
    "cfg": _read_ini,
}
