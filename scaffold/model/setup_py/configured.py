"""The keywords of setup() that setup.cfg gives, read as setuptools does."""

from __future__ import annotations

import ast
from collections.abc import Callable, Iterator, Mapping

from scaffold.formats.ini import IniFile, IniLine, IniOption, IniSection
from scaffold.model.python.evaluation.values import Glob
from scaffold.model.setup_py.data_files import DataFile
from scaffold.model.setup_py.keywords import FindPackages, Keyword

_FIND = {"find:": False, "find_namespace:": True}
"""The values of ``packages`` that search for them, and whether without ``__init__.py``."""
_WILDCARDS = frozenset("*?[{")


def configured(cfg: IniFile, call: ast.expr) -> Iterator[Keyword]:
    """Yield the keywords, each with the call of setup() as its expression."""
    for key, read in _OPTIONS.items():
        option = cfg.option("options", key)
        if option is not None:
            yield Keyword(key, read(option), call, option.location)
    option = cfg.option("options", "packages")
    if option is not None:
        yield Keyword("packages", _packages(cfg, option), call, option.location)
    for key, read_section in _SECTIONS.items():
        section = cfg.sections.get(f"options.{key}")
        if section is not None:
            yield Keyword(key, read_section(section, call), call, section.name_location)


def _packages(cfg: IniFile, option: IniOption) -> list[str] | FindPackages:
    is_namespace = _FIND.get(option.value.strip())
    if is_namespace is None:
        return [text.rstrip("/").replace("/", ".") for text in _texts(option)]
    section = cfg.sections.get("options.packages.find")
    given = {key: tuple(_texts(item)) for key, item in (section.options.items() if section else ())}
    return FindPackages(
        next(iter(given.get("where") or ()), "."),
        given.get("exclude", ()),
        given.get("include") or ("*",),
        is_namespace,
        section.name_location if section else option.location,
    )


def _data_file(option: IniOption, call: ast.expr) -> DataFile:
    items = _items(option)
    return DataFile(
        option.key,
        tuple(
            line.text if _WILDCARDS.isdisjoint(line.text) else Glob(line.text, recursive=True)
            for line in items
        ),
        complete=True,
        location=option.location,
        node=call,
        destination_location=option.key_location,
        source_locations=tuple(line.location for line in items),
    )


def _items(option: IniOption) -> list[IniLine]:
    """Return the items of a list: one per line, or separated by commas in a single line."""
    if "\n" in option.value:
        return [line for line in option.lines if line.text]
    return [
        line._replace(text=text.strip())
        for line in option.lines
        for text in line.text.split(",")
        if text.strip()
    ]


def _texts(option: IniOption) -> list[str]:
    return [line.text for line in _items(option)]


def _directories(option: IniOption) -> dict[str, str]:
    pairs = (text.partition("=") for text in _texts(option))
    return {name.strip(): place.strip() for name, _, place in pairs}


def _flag(option: IniOption) -> bool:
    return option.value.strip().lower() in {"1", "true", "yes"}


_OPTIONS: Mapping[str, Callable[[IniOption], object]] = {
    "scripts": _texts,
    "py_modules": _texts,
    "package_dir": _directories,
    "include_package_data": _flag,
}
"""What the options in ``[options]`` mean."""
_SECTIONS: Mapping[str, Callable[[IniSection, ast.expr], object]] = {
    "entry_points": lambda section, _: section.options,
    "package_data": lambda section, _: {
        key: _texts(option) for key, option in section.options.items()
    },
    "data_files": lambda section, call: [
        _data_file(option, call) for option in section.options.values()
    ],
}
"""What the sections ``[options.…]`` mean."""
