"""The options of flake8 7.0 and its plugins, and the codes that they select.

These include the options of the plugins that Jazzy installs. `read` takes the text of a
configuration file; no other configuration of the user applies, because ament_flake8 always passes
one file.
"""

from __future__ import annotations

import os
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from fnmatch import fnmatch
from functools import lru_cache
from typing import TYPE_CHECKING, Any

from scaffold.record import NamedTuple

if TYPE_CHECKING:
    from configparser import SectionProxy

Names = tuple[str, ...]

SECTION = "flake8"
LOCAL_PLUGINS = "flake8:local-plugins"
IGNORED: Names = ("E121", "E123", "E126", "E226", "E24", "E704", "W503", "W504")
"""The codes that flake8 ignores by default."""
EXCLUDED: Names = (
    ".svn",
    "CVS",
    ".bzr",
    ".hg",
    ".git",
    "__pycache__",
    ".tox",
    ".nox",
    ".eggs",
    "*.egg",
)
PLUGINS: Names = ("A00", "B90", "C4", "C90", "CNL", "D", "E", "F", "I", "Q0", "W")
"""The code prefixes registered by plugins of the distributions."""
IMPORT_STYLES = ("appnexus", "cryptography", "edited", "google", "pep8", "pycharm", "smarkets")
CONVENTIONS = ("all", "google", "numpy", "pep257")
PROPERTIES = "property,cached_property,functools.cached_property"

_CODE = r"[A-Z]{1,3}[0-9]{0,3}"
_TOKENS = r"(?P<code>[A-Z]+[0-9]*(?=$|\s|,))|(?P<file>[^\s:,]+)|(?P<colon>\s*:\s*)|\s*,\s*|\s+"


class OptionsError(Exception):
    """The configuration is invalid: ament_flake8 would stop."""


class Options(NamedTuple):
    """The options of flake8, with flake8's own defaults."""

    max_line_length: int = 79
    max_doc_length: int | None = None
    indent_size: int = 4
    hang_closing: bool = False
    max_complexity: int = -1
    select: Names | None = None
    extend_select: Names = ()
    ignore: Names | None = None
    extend_ignore: Names = ()
    per_file_ignores: tuple[tuple[str, Names], ...] = ()
    """Patterns of files, and the codes ignored in them."""
    exclude: Names = EXCLUDED
    extend_exclude: Names = ()
    filename: Names = ("*.py",)
    disable_noqa: bool = False
    builtins: Names = ()
    builtins_ignorelist: Names = ()
    builtins_allowed_modules: Names = ()
    application_import_names: Names = ()
    application_package_names: Names = ()
    import_order_style: str = "cryptography"
    inline_quotes: str = "'"
    multiline_quotes: str = '"'
    docstring_quotes: str = '"'
    avoid_escape: bool = True
    check_inside_f_strings: bool = False
    docstring_convention: str = "pep257"
    ignore_decorators: str = ""
    property_decorators: str = PROPERTIES
    ignore_self_only_init: bool = False

    def reports(self, code: str) -> bool:
        """Return whether a code is reported."""
        return _reports(self.select, self.extend_select, self.ignore, self.extend_ignore, code)

    def reports_any(self, codes: Sequence[str]) -> bool:
        """Return whether any of some codes is reported."""
        return any(map(self.reports, codes))

    def for_file(self, path: str, directory: str) -> Options:
        """Return the options for one file, with its ignored codes.

        Args:
            path: The absolute path of the file.
            directory: The directory where flake8 is run.
        """
        patterns = [(normal(name, directory), codes) for name, codes in self.per_file_ignores]
        fitting = [item for item in patterns if matches(path, [item[0]])]
        # flake8 uses the longest pattern, and the first of equal ones.
        ignored = max(fitting, key=lambda item: len(item[0]))[1] if fitting else ()
        return self._replace(extend_ignore=(*self.extend_ignore, *ignored), per_file_ignores=())


AMENT = Options(
    max_line_length=99,
    extend_ignore=(
        *("B902", "C816", "D100", "D101", "D102", "D103", "D104", "D105", "D106", "D107"),
        *("D203", "D212", "D404", "I202"),
    ),
    import_order_style="google",
)
"""The configuration that ament_flake8 ships with."""


def normal(path: str, directory: str) -> str:
    """Return a path or pattern normalized like flake8: a plain name matches in any directory."""
    if path == "." or "/" in path:
        path = os.path.abspath(os.path.join(directory, path))
    return path.rstrip("/")


def matches(path: str, patterns: Sequence[str]) -> bool:
    """Return whether an absolute path, or its name, matches one of some patterns."""
    name = path.rpartition("/")[2]
    return any(fnmatch(name, pattern) or fnmatch(path, pattern) for pattern in patterns)


@lru_cache(maxsize=4096)
def _reports(
    select: Names | None, more: Names, ignore: Names | None, extend: Names, code: str
) -> bool:
    """Decide like flake8: explicit codes take precedence over defaults, then longer prefixes."""
    named, unnamed = (*(select or ()), *more), (*(ignore or ()), *extend)
    selected = (*(PLUGINS if select is None else select), *more)
    ignored = (*(IGNORED if ignore is None else ignore), *extend)
    is_named, is_unnamed = code.startswith(named), code.startswith(unnamed)
    if not code.startswith(selected):
        return False
    if not code.startswith(ignored):
        return True
    if is_named != is_unnamed:
        return is_named
    return _longest(code, selected) > _longest(code, ignored)


def _longest(code: str, prefixes: Names) -> int:
    return max(len(prefix) for prefix in prefixes if code.startswith(prefix))


def read(text: str, directory: str) -> tuple[Options, list[str]]:
    """Return the options in a configuration file, and notes on what is not supported.

    Args:
        text: The content of the file.
        directory: Its directory; paths in it are relative to that.

    Raises:
        OptionsError: flake8 does not start with this file.
    """
    from configparser import Error, RawConfigParser

    parser = RawConfigParser()
    try:
        parser.read_string(text)
    except Error as error:
        raise OptionsError(" ".join(str(error).split())) from error
    notes = []
    if parser.has_section(LOCAL_PLUGINS):
        notes.append(
            f"[{LOCAL_PLUGINS}] names plugins, which are not run: their codes are not checked"
        )
    values: dict[str, Any] = {}
    if SECTION in parser:
        values = dict(_values(parser[SECTION], directory))
    if values.pop("doctests", False):
        notes.append("'doctests': code in docstrings is not checked")
    values.pop("require_plugins", None)
    return Options(**values), notes


def _values(section: SectionProxy, directory: str) -> Iterator[tuple[str, Any]]:
    for written in section:
        name = written.replace("-", "_")
        convert = _CONVERSIONS.get("inline_quotes" if name == "quotes" else name)
        if convert is None or ("-" in written and "_" in written):
            continue  # flake8 ignores unknown options
        try:
            value = convert(section, written)
        except ValueError as error:
            raise OptionsError(f"{written!r}: {error}") from error
        if name in {"exclude", "extend_exclude"}:
            value = tuple(normal(path, directory) for path in value)
        yield ("inline_quotes" if name == "quotes" else name), value


def _names(section: SectionProxy, key: str) -> Names:
    return tuple(filter(None, re.split(r"[,\s]", section.get(key, ""))))


def _ignored_codes(section: SectionProxy, key: str) -> Names:
    """Return a list of codes; flake8 only validates those to be ignored."""
    codes = _names(section, key)
    for code in codes:
        if not re.fullmatch(_CODE, code, re.ASCII):
            raise ValueError(f"{code!r} is not a code")
    return codes


def _number(section: SectionProxy, key: str) -> int:
    return int(section.get(key, ""))


def _switch(section: SectionProxy, key: str) -> bool:
    return bool(section.getboolean(key))


def _text(section: SectionProxy, key: str) -> str:
    return str(section.get(key, ""))


def _choice(*allowed: str) -> Callable[[SectionProxy, str], str]:
    def choose(section: SectionProxy, key: str) -> str:
        value = _text(section, key)
        if value not in allowed:
            raise ValueError(f"{value!r} is not one of {', '.join(allowed)}")
        return value

    return choose


def _inline_quotes(section: SectionProxy, key: str) -> str:
    return _quotes(_choice("'", '"', "single", "double")(section, key))


def _long_quotes(section: SectionProxy, key: str) -> str:
    return _quotes(_choice("'", '"', "single", "double", "'''", '"""')(section, key))


def _quotes(value: str) -> str:
    return {"single": "'", "double": '"'}.get(value, value[:1])


def _by_file(section: SectionProxy, key: str) -> tuple[tuple[str, Names], ...]:
    """Return the pairs of ``per-file-ignores``: lists of files, a colon, lists of codes."""
    text = _text(section, key)
    result: list[tuple[str, Names]] = []
    files: list[str] = []
    codes: list[str] = []
    after_colon, is_separated = False, True
    # linear: other characters are matched one by one
    for token in re.finditer(_TOKENS, text):
        kind = token.lastgroup
        if kind is None:
            is_separated = True
        elif kind == "colon" and not after_colon:
            after_colon = is_separated = True
        elif is_separated and kind == "file":
            if after_colon:
                result += [(name, tuple(codes)) for name in files if codes]
                files, codes, after_colon = [], [], False
            files.append(token[0])
            is_separated = False
        elif is_separated and kind == "code" and after_colon:
            codes.append(token[0])
            is_separated = False
        else:
            raise ValueError(f"expected a list of files or codes at {token[0]!r}")
    if text.strip() and not after_colon:
        raise ValueError("codes are missing at the end")
    return (*result, *((name, tuple(codes)) for name in files if codes))


_CONVERSIONS: Mapping[str, Callable[[SectionProxy, str], Any]] = {
    **dict.fromkeys(("max_line_length", "max_doc_length", "indent_size"), _number),
    "max_complexity": _number,
    **dict.fromkeys(("select", "extend_select", "builtins", "builtins_ignorelist"), _names),
    **dict.fromkeys(("application_import_names", "application_package_names"), _names),
    "builtins_allowed_modules": _names,
    **dict.fromkeys(("exclude", "extend_exclude", "filename", "require_plugins"), _names),
    **dict.fromkeys(("ignore", "extend_ignore"), _ignored_codes),
    **dict.fromkeys(("hang_closing", "disable_noqa", "doctests", "avoid_escape"), _switch),
    **dict.fromkeys(("check_inside_f_strings", "ignore_self_only_init"), _switch),
    "per_file_ignores": _by_file,
    "import_order_style": _choice(*IMPORT_STYLES),
    "inline_quotes": _inline_quotes,
    "multiline_quotes": _long_quotes,
    "docstring_quotes": _long_quotes,
    "docstring_convention": _choice(*CONVENTIONS),
    "ignore_decorators": _text,
    "property_decorators": _text,
}
