"""The codes for what ament_lint_cmake reports."""

from __future__ import annotations

from scaffold.ament.codes.code import LINT_CMAKE, AmentCode
from scaffold.diagnostic import Severity
from scaffold.edits import Safety

ROWS = (
    AmentCode(
        "CM070",
        "line-too-long",
        "A line of a CMake file has more than 140 characters",
        LINT_CMAKE,
        message=("145 characters: ament_lint_cmake allows 140"),
        documentation="""\
**Why.** ``ament_lint_cmake`` fails under ``colcon test``. A line that begins with a string is
let pass, as it cannot be broken, unless it belongs to ``message()``, which takes several.

**Fix.** Break the line; an argument per line reads best in a long list.

**Source.** ament_lint_cmake, filter ``linelength``.
""",
    ),
    AmentCode(
        "CM071",
        "space-before-parenthesis",
        "Space between a command and its ``(``",
        LINT_CMAKE,
        fix=Safety.SAFE,
        message=("space between `if` and `(`"),
        documentation="""\
**Why.** ``ament_lint_cmake`` fails under ``colcon test``.

**Fix.** Remove the space.

**Source.** ament_lint_cmake, filter ``whitespace/extra``; ROS 2 code style, CMake.
""",
    ),
    AmentCode(
        "CM072",
        "parenthesis-space-mismatch",
        "The spaces after ``(`` and before ``)`` of a command differ",
        LINT_CMAKE,
        fix=Safety.SAFE,
        message=('spaces after the "(" of set and before the ")" in line 2 differ'),
        documentation="""\
**Why.** ``ament_lint_cmake`` fails under ``colcon test``. It compares with the first ``)``
that follows; one that begins a line may be indented like its command.

**Fix.** Remove the spaces.

**Source.** ament_lint_cmake, filter ``whitespace/mismatch``.
""",
    ),
    AmentCode(
        "CM073",
        "tab-in-cmake",
        "A line of a CMake file has a tab in it",
        LINT_CMAKE,
        fix=Safety.SAFE,
        message=("tab in the line: ament_lint_cmake requires spaces"),
        documentation="""\
**Why.** ``ament_lint_cmake`` fails under ``colcon test``.

**Fix.** Indent by two spaces per tab; between words one space.

**Source.** ament_lint_cmake, filter ``whitespace/tabs``; ROS 2 code style, CMake.
""",
    ),
    AmentCode(
        "CM074",
        "trailing-space-in-cmake",
        "A line of a CMake file has trailing whitespace",
        LINT_CMAKE,
        fix=Safety.SAFE,
        message=("trailing whitespace"),
        documentation="""\
**Why.** ``ament_lint_cmake`` fails under ``colcon test``.

**Fix.** Remove them; inside of a string that goes over several lines they count, and stay.

**Source.** ament_lint_cmake, filter ``whitespace/eol``.
""",
    ),
    AmentCode(
        "CM075",
        "odd-indentation",
        "A line of a CMake file is indented by an odd number of spaces",
        LINT_CMAKE,
        message=("indented by 3 spaces: ament_lint_cmake requires multiples of two"),
        documentation="""\
**Why.** ``ament_lint_cmake`` fails under ``colcon test``, in comments and strings as well.

**Fix.** Indent by two spaces per level. No automatic fix: the line may have to go to the left
or to the right.

**Source.** ament_lint_cmake, filter ``whitespace/indent``; ROS 2 code style, CMake.
""",
    ),
    AmentCode(
        "CM076",
        "command-case-mixed",
        "Commands in upper case and in lower case are mixed in one file",
        LINT_CMAKE,
        fix=Safety.SAFE,
        message=('"IF" in a file whose first command is in lower case'),
        documentation="""\
**Why.** ``ament_lint_cmake`` fails under ``colcon test``. What the first command is, it
demands of all others; the style guide asks for lower case.

**Fix.** Write the commands in lower case.

**Source.** ament_lint_cmake, filter ``readability/mixedcase``; ROS 2 code style, CMake.
""",
    ),
    AmentCode(
        "CM077",
        "command-case-wonky",
        "A command has capitals and small letters in one word",
        LINT_CMAKE,
        fix=Safety.SAFE,
        message=('"FetchContent_Declare" mixes cases: write "fetchcontent_declare"'),
        documentation="""\
**Why.** ``ament_lint_cmake`` fails under ``colcon test``; the style guide asks for lower case.

**Fix.** Write it in lower case: CMake does not tell the cases apart.

**Source.** ament_lint_cmake, filter ``readability/wonkycase``; ROS 2 code style, CMake.
""",
    ),
    AmentCode(
        "CM078",
        "repeated-condition",
        "``else()``, ``endif()`` or alike repeats what opened the block",
        LINT_CMAKE,
        fix=Safety.SAFE,
        message=("else() repeats what opens its block; CMake ignores the words"),
        documentation="""\
**Why.** ``ament_lint_cmake`` fails under ``colcon test``. CMake ignores the words there, so
they go wrong unnoticed. The linter judges a line as a whole: a command with arguments after
``endif()`` on the same line is reported as well.

**Fix.** Leave the parentheses empty; put another command on a line of its own.

**Source.** ament_lint_cmake, filter ``readability/logic``; ROS 2 code style, CMake.
""",
    ),
    AmentCode(
        "CM080",
        "cmake-file-name",
        "``CMakeLists.txt`` is spelled differently, or a find module is not in upper case",
        LINT_CMAKE,
        message=("CMake looks for CMakeLists.txt, spelled exactly so"),
        documentation="""\
**Why.** CMake does not find a ``CMakelists.txt``: the package does not build. For
``FindFoo.cmake`` it is only ``ament_lint_cmake`` that fails, under ``colcon test``.

**Fix.** Rename the file; a find module that other packages search as ``Foo`` keeps its name
and gets the line ``# lint_cmake: -convention/filename``.

**Source.** ament_lint_cmake, filter ``convention/filename``.
""",
    ),
    AmentCode(
        "CM081",
        "find-module-handler-missing",
        "A find module does not use ``find_package_handle_standard_args()``",
        LINT_CMAKE,
        message=("this find module never includes FindPackageHandleStandardArgs"),
        documentation="""\
**Why.** ``REQUIRED`` and ``QUIET`` of ``find_package()`` have no effect without it, and
``ament_lint_cmake`` fails under ``colcon test``.

**Fix.** ``include(FindPackageHandleStandardArgs)`` and call the function.

**Source.** ament_lint_cmake, filter ``package/consistency``.
""",
    ),
    AmentCode(
        "CM082",
        "find-module-handler-misnamed",
        "``find_package_handle_standard_args()`` gets another name than that of the find module",
        LINT_CMAKE,
        message=("BAR is passed in FindFOO.cmake: expected FOO"),
        documentation="""\
**Why.** ``find_package()`` looks at ``<file name>_FOUND``; another variable does not reach
it. ``ament_lint_cmake`` fails under ``colcon test``, and it requires upper case.

**Fix.** Give the name of the file, in upper case.

**Source.** ament_lint_cmake, filter ``package/stdargs``.
""",
    ),
    AmentCode(
        "CM083",
        "command-unclosed",
        "No ``)`` follows a command up to the end of the file",
        LINT_CMAKE,
        message=('no ")" follows the "(" of set'),
        documentation="""\
**Why.** CMake stops there; ``ament_lint_cmake`` fails under ``colcon test``. To the linter
a ``#`` begins a comment even inside of a string and hides the ``)`` after it.

**Fix.** Close the command; break the line after a string with a ``#``.

**Source.** ament_lint_cmake, filter ``syntax``.
""",
    ),
    AmentCode(
        "CM084",
        "lint-pragma-invalid",
        "A ``# lint_cmake:`` comment has a word that is no filter with ``-`` or ``+``",
        LINT_CMAKE,
        Severity.ERROR,
        message=("'linelength' is not a filter with - or +: ament_lint_cmake crashes on it"),
        documentation="""\
**Why.** ``ament_lint_cmake`` ends in a traceback on it; no file of the package is checked,
and ``colcon test`` reports an error.

**Fix.** Write ``-`` or ``+`` and the name of a filter, separated by single commas.

**Source.** ament_lint_cmake, ``SetFilters``.
""",
    ),
)
