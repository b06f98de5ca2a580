"""Measures how the time of regular expressions grows with the size of the text.

    .venv/bin/python benchmarks/regex_growth.py

Each text is the known worst case of its reader; it is doubled until the reader takes a tenth
of a second or the text has half a megabyte. A growth of 2 is linear, one of 4 quadratic.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from contextlib import suppress

from scaffold.ament.flake8.pycodestyle import statements
from scaffold.check.suppression import apply
from scaffold.formats.ini import IniFile
from scaffold.formats.xml_reader import parse
from scaffold.generate.edit import readme
from scaffold.model.cmake.lexer import tokenize
from scaffold.model.package import Package
from scaffold.smoke.processes import output
from scaffold.source import Source

FIRST = 2_000
MOST = 500_000
ENOUGH = 0.1

Reader = Callable[[str], object]


def _attributes(text: str) -> object:
    return parse(Source("a.xml", f"<a b='{text}'/>")).root.attributes


def _instructions(text: str) -> object:
    document = parse(Source("a.xml", f"<?a {text}?><a/>"))
    return [instruction.pseudo_attributes for instruction in document.instructions]


def _suppressions(text: str) -> object:
    return apply(Package.of({"a.py": f"x = 1  # noqa: {text}\n"}), [], {"E501"})


CASES: dict[str, tuple[str, Reader]] = {
    "attributes of XML": ("a", _attributes),
    "instructions of XML": ("a", _instructions),
    "comparisons": (" ", lambda text: list(statements.comparisons(f"x{text}= 1"))),
    "types": (" ", lambda text: list(statements.comparisons(f"x == type({text}"))),
    "negations": ("\t", lambda text: list(statements.negations(f"not{text}"))),
    "tables": (" ", lambda text: readme._DELIMITER.fullmatch(f"-{text}x")),  # noqa: SLF001
    "sections of setup.cfg": ("[", lambda text: IniFile.parse(Source("setup.cfg", f"{text}\n"))),
    "lines of setup.cfg": ("a = ", lambda text: IniFile.parse(Source("setup.cfg", f"[a]\n{text}"))),
    "words of CMake": ("a", tokenize),
    "suppressions": ("A", _suppressions),
    "errors of builds": (" error in a", lambda text: output._ERROR_LINE.search(f"a{text}")),  # noqa: SLF001
    "warnings of builds": ("Warning:", output._WARNING_LINE.search),  # noqa: SLF001
}


def _seconds(reader: Reader, text: str) -> float:
    start = time.process_time()
    with suppress(Exception):  # rejecting a text is as good
        reader(text)
    return time.process_time() - start


def main() -> None:
    """Print the growth of each reader."""
    for name, (unit, reader) in CASES.items():
        size, before, spent = FIRST, 0.0, 0.0
        while size <= MOST and spent < ENOUGH:
            before, spent = spent, _seconds(reader, unit * (size // len(unit)))
            size *= 2
        growth = spent / before if before > 0 else 1.0
        print(f"{name:24} {size // 2:8} characters {spent * 1000:8.1f} ms, growth {growth:.1f}")


if __name__ == "__main__":
    main()
