"""Packages and what ament_lint_cmake reports about them, by code."""

from __future__ import annotations

from collections.abc import Mapping

from scaffold.check.rules.rule import Example, Report

LONG = "set(WORDS " + "word " * 26 + "word)\n"


MODULE = "include(FindPackageHandleStandardArgs)\nfind_package_handle_standard_args(FOO)\n"
INCLUDE = "include(FindPackageHandleStandardArgs)\n"
CALL = "find_package_handle_standard_args(FOO DEFAULT_MSG FOO_LIBRARY)\n"


CASES: Mapping[str, tuple[Example, ...]] = {
    "CM070": (
        Example("just fits", {"CMakeLists.txt": LONG.replace(" word)", ")")}),
        Example(
            "a string that cannot be broken",
            {"CMakeLists.txt": f'set(TEXT\n  "{"x" * 150}"\n)\n'},
        ),
        Example(
            "too long",
            {"CMakeLists.txt": LONG},
            Report("CMakeLists.txt:1:141", "145 characters: ament_lint_cmake allows 140"),
        ),
        Example(
            "a message can be broken",
            {"cmake/say.cmake": f'message(\n  "{"x" * 150}"\n)\n'},
            Report("cmake/say.cmake:2:141", "154 characters: ament_lint_cmake allows 140"),
        ),
    ),
    "CM071": (
        Example("none", {"CMakeLists.txt": "if(A AND (B OR C))\nendif()\n"}),
        Example(
            "after if",
            {"CMakeLists.txt": "if (A)\nendif()\n"},
            Report(
                "CMakeLists.txt:1:3",
                "space between `if` and `(`",
                fix="Remove the space",
            ),
            fixed={"CMakeLists.txt": "if(A)\nendif()\n"},
        ),
    ),
    "CM072": (
        Example(
            "the same on both sides, or on a line of its own",
            {"CMakeLists.txt": "if(A)\n  set( B 1 )\n  set(\n    C 1\n  )\nendif()\n"},
        ),
        Example(
            "one side only",
            {"CMakeLists.txt": "if(A)\n  set( B 1)\nendif()\nset(C 1 )\n"},
            Report(
                "CMakeLists.txt:2:6",
                'spaces after the "(" of set and before the ")" in line 2 differ',
                fix="Use equal spaces",
            ),
            Report(
                "CMakeLists.txt:4:4",
                'spaces after the "(" of set and before the ")" in line 4 differ',
                fix="Use equal spaces",
            ),
            fixed={"CMakeLists.txt": "if(A)\n  set(B 1)\nendif()\nset(C 1)\n"},
        ),
        Example(
            "indented like nothing else",
            {"CMakeLists.txt": "set(\n  B\n  1\n    )\n"},
            Report(
                "CMakeLists.txt:1:4",
                'spaces after the "(" of set and before the ")" in line 4 differ',
                fix="Use equal spaces",
            ),
            fixed={"CMakeLists.txt": "set(\n  B\n  1\n)\n"},
        ),
        Example(
            "the first parenthesis is in a string: mend it by hand",
            {"CMakeLists.txt": 'message("so ) " )\n'},
            Report(
                "CMakeLists.txt:1:8",
                'spaces after the "(" of message and before the ")" in line 1 differ',
            ),
        ),
    ),
    "CM073": (
        Example("blanks", {"CMakeLists.txt": "if(A)\n  set(B 1)\nendif()\n"}),
        Example(
            "tabs",
            {"CMakeLists.txt": "if(A)\n\tset(B\t1)\nendif()\n"},
            Report(
                "CMakeLists.txt:2:1",
                "tab in the line: ament_lint_cmake requires spaces",
                fix="Replace the tab with spaces",
            ),
            fixed={"CMakeLists.txt": "if(A)\n  set(B 1)\nendif()\n"},
        ),
        Example(
            "in a string: write \\t",
            {"CMakeLists.txt": 'set(B "a\tb")\n'},
            Report("CMakeLists.txt:1:9", "tab in the line: ament_lint_cmake requires spaces"),
        ),
    ),
    "CM074": (
        Example("none", {"CMakeLists.txt": "project(talker)\n\n# A talker.\n"}),
        Example(
            "behind a command, a comment, and alone",
            {"CMakeLists.txt": "project(talker) \n  \n# A talker.\t\n"},
            Report(
                "CMakeLists.txt:1:16",
                "trailing whitespace",
                fix="Remove the trailing whitespace",
            ),
            Report(
                "CMakeLists.txt:2:1",
                "trailing whitespace",
                fix="Remove the trailing whitespace",
            ),
            Report(
                "CMakeLists.txt:3:12",
                "trailing whitespace",
                fix="Remove the trailing whitespace",
            ),
            fixed={"CMakeLists.txt": "project(talker)\n\n# A talker.\n"},
        ),
        Example(
            "in a string",
            {"cmake/text.cmake": 'set(TEXT "one \ntwo")\n'},
            Report("cmake/text.cmake:1:14", "trailing whitespace"),
        ),
    ),
    "CM075": (
        Example("two and four", {"CMakeLists.txt": "if(A)\n  set(\n    B\n    1)\nendif()\n"}),
        Example(
            "aligned with the word behind a parenthesis",
            {"CMakeLists.txt": "install(TARGETS a\n        DESTINATION lib)\nset(BEE a\n   b)\n"},
            Report(
                "CMakeLists.txt:4:1",
                "indented by 3 spaces: ament_lint_cmake requires multiples of two",
            ),
        ),
        Example(
            "switched off for the file",
            {"CMakeLists.txt": "# lint_cmake: -whitespace/indent\nif(A)\n   set(B 1)\nendif()\n"},
        ),
    ),
    "CM076": (
        Example("lower case", {"CMakeLists.txt": "project(talker)\nif(A)\nendif()\n"}),
        Example(
            "one in upper case",
            {"CMakeLists.txt": "project(talker)\nIF(A)\nendif()\n"},
            Report(
                "CMakeLists.txt:2:1",
                '"IF" in a file whose first command is in lower case',
                fix="Convert the commands to lower case",
            ),
            fixed={"CMakeLists.txt": "project(talker)\nif(A)\nendif()\n"},
        ),
        Example(
            "the first in upper case: the others are reported",
            {"CMakeLists.txt": "PROJECT(talker)\nif(A)\n"},
            Report(
                "CMakeLists.txt:2:1",
                '"if" in a file whose first command is in upper case',
                fix="Convert the commands to lower case",
            ),
            fixed={"CMakeLists.txt": "project(talker)\nif(A)\n"},
        ),
    ),
    "CM077": (
        Example("lower case", {"CMakeLists.txt": "include(FetchContent)\n"}),
        Example(
            "as the documentation of a module spells it",
            {"CMakeLists.txt": "FetchContent_Declare(json)\n"},
            Report(
                "CMakeLists.txt:1:1",
                '"FetchContent_Declare" mixes cases: write "fetchcontent_declare"',
                fix="Replace with fetchcontent_declare",
            ),
            fixed={"CMakeLists.txt": "fetchcontent_declare(json)\n"},
        ),
        Example(
            "looks like a command, is an argument",
            {"CMakeLists.txt": "set(WORDS\n  Word(s)\n)\n"},
            Report("CMakeLists.txt:2:3", '"Word" mixes cases: write "word"'),
        ),
    ),
    "CM078": (
        Example("empty", {"CMakeLists.txt": "if(TALKER)\nelse()\nendif()\n"}),
        Example(
            "repeated",
            {"CMakeLists.txt": "if(TALKER)\nelse(TALKER)\nendif(TALKER)\n"},
            Report(
                "CMakeLists.txt:2:1",
                "else() repeats what opens its block; CMake ignores the words",
                fix="Remove the argument",
            ),
            Report(
                "CMakeLists.txt:3:1",
                "endif() repeats what opens its block; CMake ignores the words",
                fix="Remove the argument",
            ),
            fixed={"CMakeLists.txt": "if(TALKER)\nelse()\nendif()\n"},
        ),
        Example(
            "two commands on one line",
            {"CMakeLists.txt": "if(TALKER)\nendif() set(LISTENER 1)\n"},
            Report(
                "CMakeLists.txt:2:1",
                "endif() repeats what opens its block; CMake ignores the words",
            ),
        ),
    ),
    "CM080": (
        Example("right", {"CMakeLists.txt": "project(talker)\n", "cmake/FindFOO.cmake": MODULE}),
        Example(
            "CMakelists.txt",
            {"CMakelists.txt": "project(talker)\n"},
            Report("CMakelists.txt:1:1", "CMake looks for CMakeLists.txt, spelled exactly so"),
        ),
        Example(
            "FindFoo.cmake",
            {"cmake/FindFoo.cmake": MODULE},
            Report(
                "cmake/FindFoo.cmake:1:1",
                "ament_lint_cmake requires upper case in names of find modules: FindFOO.cmake",
            ),
        ),
    ),
    "CM081": (
        Example("used", {"cmake/FindFOO.cmake": INCLUDE + CALL}),
        Example(
            "not included",
            {"cmake/FindFOO.cmake": CALL},
            Report(
                "cmake/FindFOO.cmake:1:1",
                "this find module never includes FindPackageHandleStandardArgs",
            ),
        ),
        Example(
            "not called",
            {"cmake/FindFOO.cmake": INCLUDE + "set(FOO_FOUND TRUE)\n"},
            Report(
                "cmake/FindFOO.cmake:1:1",
                "this find module never calls find_package_handle_standard_args",
            ),
        ),
    ),
    "CM082": (
        Example(
            "the file's name",
            {"cmake/FindFOO.cmake": INCLUDE + "find_package_handle_standard_args(FOO FOO_LIB)\n"},
        ),
        Example(
            "another name",
            {"cmake/FindFOO.cmake": INCLUDE + "find_package_handle_standard_args(BAR BAR_LIB)\n"},
            Report("cmake/FindFOO.cmake:2:1", "BAR is passed in FindFOO.cmake: expected FOO"),
        ),
    ),
    "CM083": (
        Example("closed", {"cmake/talker.cmake": "set(TALKER\n  1\n)\n"}),
        Example(
            "open",
            {"cmake/talker.cmake": "set(TALKER\n  1\n"},
            Report("cmake/talker.cmake:1:1", 'no ")" follows the "(" of set'),
        ),
        Example(
            "hidden from the linter",
            {"cmake/talker.cmake": 'set(COLOUR "#fff")\n'},
            Report("cmake/talker.cmake:1:1", 'no ")" follows the "(" of set'),
        ),
    ),
    "CM084": (
        Example("known", {"CMakeLists.txt": "# lint_cmake: -linelength, +whitespace/tabs\n"}),
        Example(
            "no sign",
            {"CMakeLists.txt": "# lint_cmake: linelength\n"},
            Report(
                "CMakeLists.txt:1:1",
                "'linelength' is not a filter with - or +: ament_lint_cmake crashes on it",
            ),
        ),
        Example(
            "misspelt",
            {"CMakeLists.txt": "project(talker)\n# lint_cmake: -linelenght\n"},
            Report(
                "CMakeLists.txt:2:1",
                "'-linelenght' is not a filter with - or +: ament_lint_cmake crashes on it",
            ),
        ),
    ),
}
