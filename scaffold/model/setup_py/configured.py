"""The keywords of setup() that setup.cfg gives, read as setuptools does."""

from __future__ import annotations

import ast
from collections.abc import Iterator

from scaffold.formats.ini import IniFile, IniLine, IniOption
from scaffold.model.python.evaluation.values import Glob
from scaffold.model.setup_py.data_files import DataFile
from scaffold.model.setup_py.keywords import FindPackages, Keyword

_FIND = {"find:": False, "find_namespace:": True}
"""The values of ``packages`` that search for them, and whether without ``__init__.py``."""
_WILDCARDS = frozenset("*?[{")


def configured(cfg: IniFile, call: ast.expr) -> Iterator[Keyword]:
    """Yield the keywords, each with the call of setup() as its expression."""
    for key in ("scripts", "py_modules"):
        option = cfg.option("options", key)
        if option is not None:
            value: object = [line.text for line in _items(option)]
            yield Keyword(key, value, call, option.location)
    option = cfg.option("options", "packages")
    if option is not None:
        yield Keyword("packages", _packages(cfg, option), call, option.location)
    option = cfg.option("options", "package_dir")
    if option is not None:
        pairs = [line.text.partition("=") for line in _items(option)]
        value = {name.strip(): place.strip() for name, _, place in pairs}
        yield Keyword("package_dir", value, call, option.location)
    option = cfg.option("options", "include_package_data")
    if option is not None:
        value = option.value.strip().lower() in {"1", "true", "yes"}
        yield Keyword("include_package_data", value, call, option.location)
    section = cfg.sections.get("options.entry_points")
    if section is not None:
        yield Keyword("entry_points", section.options, call, section.name_location)
    section = cfg.sections.get("options.package_data")
    if section is not None:
        value = {
            key: [line.text for line in _items(option)] for key, option in section.options.items()
        }
        yield Keyword("package_data", value, call, section.name_location)
    section = cfg.sections.get("options.data_files")
    if section is not None:
        files = [_data_file(option, call) for option in section.options.values()]
        yield Keyword("data_files", files, call, section.name_location)


def _packages(cfg: IniFile, option: IniOption) -> list[str] | FindPackages:
    is_namespace = _FIND.get(option.value.strip())
    if is_namespace is None:
        return [line.text.rstrip("/").replace("/", ".") for line in _items(option)]
    section = cfg.sections.get("options.packages.find")
    given = {
        key: tuple(line.text for line in _items(item))
        for key, item in (section.options.items() if section else ())
    }
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
