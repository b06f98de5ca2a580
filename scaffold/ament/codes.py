"""All codes for what ament's linters report on Jazzy: names, severities, fixes, documentation.

Those of ament_flake8 and ament_pep257 are the codes that people know from flake8 and pydocstyle;
what the ini file of the one and the convention ``ament`` of the other leave out is not here. The
other linters of ament have no codes of their own.
"""

from __future__ import annotations

from collections.abc import Mapping

from scaffold.ament.finding import FLAKE8, PEP257
from scaffold.diagnostic import Diagnostic, Severity
from scaffold.edits import Fix, Safety
from scaffold.record import NamedTuple
from scaffold.source import Location

BOTH = FLAKE8 | PEP257
LINT_CMAKE, XMLLINT, COPYRIGHT = 4, 8, 16
LINTERS: Mapping[int, str] = {
    FLAKE8: "ament_flake8",
    PEP257: "ament_pep257",
    LINT_CMAKE: "ament_lint_cmake",
    XMLLINT: "ament_xmllint",
    COPYRIGHT: "ament_copyright",
}
"""Who reports a code on Jazzy; the values of several are added up."""
SAFE, UNSAFE = Safety.SAFE, Safety.UNSAFE


class AmentCode(NamedTuple):
    """A code for one thing that a linter of ament reports."""

    code: str
    name: str
    summary: str
    """One line, what is wrong; the message of a style finding that has none of its own."""
    linters: int = FLAKE8
    """Who reports it; see `LINTERS`."""
    severity: Severity = Severity.WARNING
    """ERROR where the code fails when it is imported or run, or the package cannot be built."""
    fix: Safety | None = None
    """How the fix is applied, where the place is plain enough for one."""
    message: str = ""
    """What users read, for example; a test has the case that it belongs to."""
    documentation: str = ""
    """**Why.**, **Fix.** and **Source.**, where there is more to say than the summary."""
    other_severities: Mapping[Severity, str] | None = None
    """Severities that a diagnostic may have instead, each with the condition for it."""


_TABLE = (
    AmentCode("A001", "shadowed-builtin", "a variable hides a builtin"),
    AmentCode("A002", "shadowed-builtin-argument", "an argument hides a builtin"),
    AmentCode("A003", "shadowed-builtin-attribute", "a class attribute hides a builtin"),
    AmentCode(
        "C400",
        "generator-to-list",
        "a generator inside list() instead of a list comprehension",
        fix=UNSAFE,
    ),
    AmentCode(
        "C401",
        "generator-to-set",
        "a generator inside set() instead of a set comprehension",
        fix=UNSAFE,
    ),
    AmentCode(
        "C402",
        "generator-to-dict",
        "a generator inside dict() instead of a dict comprehension",
        fix=UNSAFE,
    ),
    AmentCode(
        "C403",
        "list-comprehension-to-set",
        "a list comprehension inside set() instead of a set comprehension",
        fix=UNSAFE,
    ),
    AmentCode(
        "C404",
        "list-comprehension-to-dict",
        "a list comprehension inside dict() instead of a dict comprehension",
        fix=UNSAFE,
    ),
    AmentCode(
        "C405",
        "literal-to-set",
        "a list or tuple inside set() instead of a set literal",
        fix=UNSAFE,
    ),
    AmentCode(
        "C406",
        "literal-to-dict",
        "a list or tuple inside dict() instead of a dict literal",
        fix=UNSAFE,
    ),
    AmentCode(
        "C408",
        "call-instead-of-literal",
        "dict(), list() or tuple() instead of a literal",
        fix=UNSAFE,
    ),
    AmentCode(
        "C409",
        "literal-inside-tuple",
        "a literal or comprehension inside tuple() that is not needed",
        fix=UNSAFE,
    ),
    AmentCode(
        "C410", "literal-inside-list", "a literal inside list() that is not needed", fix=UNSAFE
    ),
    AmentCode(
        "C411", "list-around-comprehension", "list() around a list comprehension", fix=UNSAFE
    ),
    AmentCode("C413", "call-around-sorted", "list() or reversed() around sorted()", fix=SAFE),
    AmentCode(
        "C414",
        "double-cast",
        "nested calls such as list(sorted()) inside set() or sorted()",
        fix=UNSAFE,
    ),
    AmentCode(
        "C415",
        "subscript-reversal",
        "a reversed slice inside reversed(), set() or sorted()",
    ),
    AmentCode("C416", "copying-comprehension", "a comprehension that only copies", fix=UNSAFE),
    AmentCode(
        "C417", "map-with-lambda", "map() with a lambda instead of a comprehension", fix=UNSAFE
    ),
    AmentCode(
        "C418", "dict-around-dict", "dict() around a dict literal or comprehension", fix=UNSAFE
    ),
    AmentCode(
        "C419", "comprehension-in-any-all", "a list comprehension inside any() or all()", fix=UNSAFE
    ),
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
        fix=SAFE,
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
        fix=SAFE,
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
        fix=SAFE,
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
        fix=SAFE,
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
        fix=SAFE,
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
        fix=SAFE,
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
        fix=SAFE,
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
        "``CMakeLists.txt`` is spelt otherwise, or a find module is not in upper case",
        LINT_CMAKE,
        message=("CMake looks for CMakeLists.txt, spelt exactly so"),
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
        message=("BAR is handed over in FindFOO.cmake: expected FOO"),
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
    AmentCode(
        "D200",
        "spread-one-liner",
        "a one-line docstring is spread over several lines",
        BOTH,
        fix=SAFE,
    ),
    AmentCode(
        "D201",
        "blank-before-docstring",
        "blank lines before the docstring of a function",
        BOTH,
        fix=SAFE,
    ),
    AmentCode(
        "D202",
        "blank-after-docstring",
        "blank lines after the docstring of a function",
        BOTH,
        fix=SAFE,
    ),
    AmentCode(
        "D204",
        "class-docstring-not-separated",
        "no single blank line after the docstring of a class",
        BOTH,
        fix=SAFE,
    ),
    AmentCode(
        "D205",
        "summary-not-separated",
        "no single blank line after the summary line of a docstring",
        BOTH,
        fix=SAFE,
    ),
    AmentCode("D206", "docstring-indented-with-tabs", "a docstring is indented with tabs", BOTH),
    AmentCode(
        "D207",
        "under-indented-docstring",
        "a docstring is indented less than its quotes",
        BOTH,
        fix=SAFE,
    ),
    AmentCode(
        "D208",
        "over-indented-docstring",
        "a docstring is indented more than its quotes",
        BOTH,
        fix=SAFE,
    ),
    AmentCode(
        "D209",
        "closing-quotes-not-alone",
        "the closing quotes of a multi-line docstring are not on their own line",
        BOTH,
        fix=SAFE,
    ),
    AmentCode(
        "D210",
        "whitespace-around-docstring",
        "whitespace between the quotes and the text of a docstring",
        BOTH,
        fix=SAFE,
    ),
    AmentCode(
        "D211",
        "blank-before-class-docstring",
        "blank lines before the docstring of a class",
        BOTH,
        fix=SAFE,
    ),
    AmentCode(
        "D213",
        "summary-on-first-line",
        "the summary of a multi-line docstring does not start on the second line",
        PEP257,
        fix=SAFE,
    ),
    AmentCode(
        "D214",
        "over-indented-section",
        "a docstring section is indented more than the docstring",
        PEP257,
    ),
    AmentCode(
        "D215",
        "over-indented-section-underline",
        "the dashes of a docstring section are indented too far",
        PEP257,
        fix=SAFE,
    ),
    AmentCode(
        "D300", "docstring-quotes", "a docstring is not in triple double quotes", BOTH, fix=SAFE
    ),
    AmentCode(
        "D301", "backslash-in-docstring", "a docstring with backslashes is not raw", BOTH, fix=SAFE
    ),
    AmentCode(
        "D400",
        "summary-without-period",
        "the first line of a docstring does not end with a period",
        BOTH,
        fix=SAFE,
    ),
    AmentCode(
        "D401",
        "summary-not-imperative",
        "the first line of a docstring is not a command",
        BOTH,
        fix=UNSAFE,
    ),
    AmentCode(
        "D402",
        "signature-in-docstring",
        "the first line of a docstring is the function's signature",
        BOTH,
    ),
    AmentCode(
        "D403",
        "summary-not-capitalized",
        "the first word of a docstring is not capitalized",
        BOTH,
        fix=SAFE,
    ),
    AmentCode(
        "D405",
        "section-name-case",
        "the name of a docstring section is not capitalized",
        PEP257,
        fix=SAFE,
    ),
    AmentCode(
        "D406",
        "section-name-suffix",
        "something follows the name of a docstring section",
        PEP257,
        fix=SAFE,
    ),
    AmentCode(
        "D407",
        "section-without-underline",
        "no dashes below the name of a docstring section",
        PEP257,
        fix=SAFE,
    ),
    AmentCode(
        "D408",
        "section-underline-position",
        "the dashes of a docstring section are not right below its name",
        PEP257,
        fix=SAFE,
    ),
    AmentCode(
        "D409",
        "section-underline-length",
        "the dashes of a docstring section are not as long as its name",
        PEP257,
        fix=SAFE,
    ),
    AmentCode(
        "D410", "section-not-separated", "no blank line after a docstring section", PEP257, fix=SAFE
    ),
    AmentCode(
        "D411",
        "section-without-blank-before",
        "no blank line before a docstring section",
        PEP257,
        fix=SAFE,
    ),
    AmentCode(
        "D412",
        "blank-after-section-name",
        "blank lines between the name of a docstring section and its content",
        BOTH,
        fix=SAFE,
    ),
    AmentCode(
        "D413",
        "last-section-not-separated",
        "no blank line after the last docstring section",
        PEP257,
        fix=SAFE,
    ),
    AmentCode("D414", "empty-section", "a docstring section without content", BOTH),
    AmentCode(
        "D415",
        "summary-without-punctuation",
        "the first line of a docstring does not end with . ? or !",
        PEP257,
        fix=SAFE,
    ),
    AmentCode(
        "D416",
        "section-name-without-colon",
        "the name of a docstring section does not end with a colon",
        PEP257,
        fix=SAFE,
    ),
    AmentCode(
        "D417",
        "undocumented-argument",
        "a docstring does not describe all arguments",
        PEP257,
    ),
    AmentCode("D418", "docstring-on-overload", "an @overload has a docstring", PEP257),
    AmentCode("D419", "empty-docstring", "a docstring without text", BOTH),
    AmentCode("E101", "mixed-indentation", "the indentation mixes tabs and spaces"),
    AmentCode(
        "E111",
        "indentation-not-multiple-of-four",
        "the indentation is not a multiple of four",
    ),
    AmentCode("E112", "missing-indented-block", "an indented block is missing"),
    AmentCode("E113", "unexpected-indentation", "unexpected indentation"),
    AmentCode(
        "E114",
        "comment-indentation-not-multiple-of-four",
        "the indentation of a comment is not a multiple of four",
    ),
    AmentCode("E115", "comment-not-indented", "a comment is not indented like its block"),
    AmentCode("E116", "comment-over-indented", "a comment is indented without a block"),
    AmentCode("E117", "over-indented", "a block is indented too far"),
    AmentCode("E122", "continuation-not-indented", "a continuation line is not indented"),
    AmentCode(
        "E124",
        "closing-bracket-not-aligned",
        "a closing bracket does not match the visual indentation",
    ),
    AmentCode(
        "E125",
        "continuation-like-next-line",
        "a continuation line is indented like the block that follows",
    ),
    AmentCode("E127", "continuation-over-indented", "a continuation line is indented too far"),
    AmentCode(
        "E128",
        "continuation-under-indented",
        "a continuation line is not indented far enough",
    ),
    AmentCode(
        "E129",
        "visual-indent-like-next-line",
        "a visually indented line is indented like the block that follows",
    ),
    AmentCode(
        "E131",
        "continuation-unaligned",
        "a continuation line is not aligned with the ones above it",
    ),
    AmentCode("E201", "whitespace-after-bracket", "whitespace after an opening bracket", fix=SAFE),
    AmentCode("E202", "whitespace-before-bracket", "whitespace before a closing bracket", fix=SAFE),
    AmentCode(
        "E203",
        "whitespace-before-punctuation",
        "whitespace before a comma, semicolon or colon",
        fix=SAFE,
    ),
    AmentCode(
        "E211",
        "whitespace-before-arguments",
        "whitespace before the bracket of a call or an index",
        fix=SAFE,
    ),
    AmentCode("E221", "spaces-before-operator", "several spaces before an operator", fix=SAFE),
    AmentCode("E222", "spaces-after-operator", "several spaces after an operator", fix=SAFE),
    AmentCode("E223", "tab-before-operator", "a tab before an operator", fix=SAFE),
    AmentCode("E224", "tab-after-operator", "a tab after an operator", fix=SAFE),
    AmentCode(
        "E225",
        "missing-whitespace-around-operator",
        "whitespace is missing around an operator",
        fix=SAFE,
    ),
    AmentCode(
        "E227",
        "missing-whitespace-around-bitwise-operator",
        "whitespace is missing around a bitwise or shift operator",
        fix=SAFE,
    ),
    AmentCode(
        "E228", "missing-whitespace-around-modulo", "whitespace is missing around %", fix=SAFE
    ),
    AmentCode(
        "E231",
        "missing-whitespace-after-punctuation",
        "whitespace is missing after a comma, semicolon or colon",
        fix=SAFE,
    ),
    AmentCode(
        "E251",
        "whitespace-around-keyword-equals",
        "whitespace around = of a keyword argument",
        fix=SAFE,
    ),
    AmentCode(
        "E252",
        "missing-whitespace-around-default-equals",
        "whitespace is missing around = of an annotated argument",
        fix=SAFE,
    ),
    AmentCode(
        "E261", "comment-too-close", "fewer than two spaces before an inline comment", fix=SAFE
    ),
    AmentCode(
        "E262", "inline-comment-start", "an inline comment does not start with '# '", fix=SAFE
    ),
    AmentCode("E265", "block-comment-start", "a block comment does not start with '# '", fix=SAFE),
    AmentCode("E266", "block-comment-hashes", "a block comment starts with several #", fix=SAFE),
    AmentCode("E271", "spaces-after-keyword", "several spaces after a keyword", fix=SAFE),
    AmentCode("E272", "spaces-before-keyword", "several spaces before a keyword", fix=SAFE),
    AmentCode("E273", "tab-after-keyword", "a tab after a keyword", fix=SAFE),
    AmentCode("E274", "tab-before-keyword", "a tab before a keyword", fix=SAFE),
    AmentCode(
        "E275",
        "missing-whitespace-after-keyword",
        "whitespace is missing after a keyword",
        fix=SAFE,
    ),
    AmentCode("E301", "missing-blank-line", "no blank line before a method", fix=SAFE),
    AmentCode(
        "E302", "missing-blank-lines", "no two blank lines before a class or function", fix=SAFE
    ),
    AmentCode("E303", "too-many-blank-lines", "too many blank lines", fix=SAFE),
    AmentCode("E304", "blank-line-after-decorator", "a blank line after a decorator", fix=SAFE),
    AmentCode(
        "E305",
        "missing-blank-lines-after-definition",
        "no two blank lines after a class or function",
        fix=SAFE,
    ),
    AmentCode(
        "E306",
        "missing-blank-line-before-nested-definition",
        "no blank line before a nested definition",
        fix=SAFE,
    ),
    AmentCode("E401", "several-imports-on-one-line", "several imports on one line", fix=SAFE),
    AmentCode("E402", "late-import", "an import below other code of the module"),
    AmentCode("E501", "line-too-long", "the line has more than 99 characters"),
    AmentCode("E502", "redundant-backslash", "a backslash between brackets", fix=SAFE),
    AmentCode(
        "E701", "statement-after-colon", "a statement follows the colon on the same line", fix=SAFE
    ),
    AmentCode("E702", "several-statements-on-one-line", "several statements on one line", fix=SAFE),
    AmentCode("E703", "trailing-semicolon", "the statement ends with a semicolon", fix=SAFE),
    AmentCode("E711", "comparison-to-none", "comparison to None with == or !=", fix=UNSAFE),
    AmentCode(
        "E712", "comparison-to-bool", "comparison to True or False with == or !=", fix=UNSAFE
    ),
    AmentCode("E713", "negated-membership-test", "'not x in y' instead of 'x not in y'", fix=SAFE),
    AmentCode("E714", "negated-identity-test", "'not x is y' instead of 'x is not y'", fix=SAFE),
    AmentCode("E721", "type-comparison", "types compared with == or !="),
    AmentCode(
        "E722",
        "bare-except",
        "bare 'except:' catches SystemExit and KeyboardInterrupt, too",
    ),
    AmentCode("E731", "assigned-lambda", "a lambda is assigned to a name", fix=UNSAFE),
    AmentCode("E741", "ambiguous-variable-name", "a variable is called l, O or I"),
    AmentCode("E742", "ambiguous-class-name", "a class is called l, O or I"),
    AmentCode("E743", "ambiguous-function-name", "a function is called l, O or I"),
    AmentCode(
        "E902",
        "unreadable-source",
        "the file cannot be read as Python",
        BOTH,
        Severity.ERROR,
    ),
    AmentCode("E999", "syntax-error", "the file is not Python", BOTH, Severity.ERROR),
    AmentCode("F401", "unused-import", "an import is not used", fix=SAFE),
    AmentCode("F402", "import-shadowed-by-loop", "a loop variable replaces an import"),
    AmentCode("F403", "star-import", "a star import hides what is defined"),
    AmentCode(
        "F404",
        "late-future-import",
        "a __future__ import below other code",
        severity=Severity.ERROR,
    ),
    AmentCode("F405", "name-from-star-import", "a name may come from a star import"),
    AmentCode(
        "F406",
        "nested-star-import",
        "a star import inside a class or function",
        severity=Severity.ERROR,
    ),
    AmentCode(
        "F407",
        "unknown-future-feature",
        "an unknown feature is imported from __future__",
        severity=Severity.ERROR,
    ),
    AmentCode(
        "F501",
        "percent-format-invalid",
        "a % format that is not valid",
        severity=Severity.ERROR,
    ),
    AmentCode(
        "F502",
        "percent-format-expects-mapping",
        "a % format needs a mapping and gets none",
        severity=Severity.ERROR,
    ),
    AmentCode(
        "F503",
        "percent-format-expects-sequence",
        "a % format needs a sequence and gets none",
        severity=Severity.ERROR,
    ),
    AmentCode(
        "F504",
        "percent-format-unused-argument",
        "a named argument of a % format is not used",
        fix=SAFE,
    ),
    AmentCode(
        "F505",
        "percent-format-missing-argument",
        "a named argument of a % format is missing",
        severity=Severity.ERROR,
    ),
    AmentCode(
        "F506",
        "percent-format-mixed",
        "a % format mixes positions and names",
        severity=Severity.ERROR,
    ),
    AmentCode(
        "F507",
        "percent-format-count",
        "a % format gets the wrong number of values",
        severity=Severity.ERROR,
    ),
    AmentCode(
        "F508",
        "percent-format-star",
        "a % format with * and a mapping",
        severity=Severity.ERROR,
    ),
    AmentCode(
        "F509",
        "percent-format-character",
        "a % format with an unknown character",
        severity=Severity.ERROR,
    ),
    AmentCode(
        "F521",
        "format-invalid",
        "a format string that is not valid",
        severity=Severity.ERROR,
    ),
    AmentCode(
        "F522",
        "format-unused-named-argument",
        "a named argument of .format() is not used",
        fix=SAFE,
    ),
    AmentCode("F523", "format-unused-argument", "an argument of .format() is not used", fix=SAFE),
    AmentCode(
        "F524",
        "format-missing-argument",
        "an argument of .format() is missing",
        severity=Severity.ERROR,
    ),
    AmentCode(
        "F525",
        "format-mixed-numbering",
        ".format() mixes automatic and manual numbers",
        severity=Severity.ERROR,
    ),
    AmentCode("F541", "f-string-without-placeholder", "an f-string without placeholders", fix=SAFE),
    AmentCode(
        "F601",
        "repeated-key-literal",
        "a literal key of a dict is repeated with other values",
    ),
    AmentCode(
        "F602",
        "repeated-key-variable",
        "a variable key of a dict is repeated with other values",
    ),
    AmentCode(
        "F621",
        "too-many-values-before-star",
        "too many targets before a starred one",
        severity=Severity.ERROR,
    ),
    AmentCode(
        "F622",
        "two-starred-targets",
        "two starred targets in one assignment",
        severity=Severity.ERROR,
    ),
    AmentCode("F631", "assert-on-tuple", "assert on a tuple, which is always true"),
    AmentCode("F632", "is-with-literal", "'is' with a literal instead of '=='", fix=SAFE),
    AmentCode("F633", "print-shift", ">> with print", severity=Severity.ERROR),
    AmentCode("F634", "if-on-tuple", "if on a tuple, which is always true"),
    AmentCode("F701", "break-outside-loop", "break outside a loop", severity=Severity.ERROR),
    AmentCode("F702", "continue-outside-loop", "continue outside a loop", severity=Severity.ERROR),
    AmentCode(
        "F704",
        "yield-outside-function",
        "yield or await outside a function",
        severity=Severity.ERROR,
    ),
    AmentCode(
        "F706",
        "return-outside-function",
        "return outside a function",
        severity=Severity.ERROR,
    ),
    AmentCode(
        "F707",
        "default-except-not-last",
        "a bare except that is not the last one",
        severity=Severity.ERROR,
    ),
    AmentCode("F722", "annotation-syntax", "an annotation in quotes that is not Python"),
    AmentCode("F811", "redefinition", "a name is defined again without being used", fix=SAFE),
    AmentCode("F821", "undefined-name", "a name is not defined", severity=Severity.ERROR),
    AmentCode(
        "F822",
        "undefined-export",
        "a name in __all__ is not defined",
        severity=Severity.ERROR,
    ),
    AmentCode(
        "F823",
        "unbound-local",
        "a local variable is used before its assignment",
        severity=Severity.ERROR,
    ),
    AmentCode("F841", "unused-variable", "a local variable is not used", fix=SAFE),
    AmentCode("F842", "unused-annotation", "a local variable is annotated and not used"),
    AmentCode(
        "F901",
        "raise-not-implemented",
        "raise NotImplemented instead of NotImplementedError",
        severity=Severity.ERROR,
        fix=SAFE,
    ),
    AmentCode("I100", "import-order", "an import is in the wrong place", fix=SAFE),
    AmentCode("I101", "imported-names-order", "imported names are not sorted", fix=SAFE),
    AmentCode(
        "I201", "import-groups-not-separated", "no blank line between groups of imports", fix=SAFE
    ),
    AmentCode(
        "I666",
        "mixed-import-groups",
        "one import statement for modules of different groups",
    ),
    AmentCode(
        "LY020",
        "copyright-notice-missing",
        "A source file has no copyright notice at its start",
        COPYRIGHT,
        Severity.ERROR,
        other_severities={Severity.INFO: "no test of the package runs ament_copyright on the file"},
        message=("no copyright notice in the first comment of this file: ament_copyright fails"),
        documentation="""\
**Why.** ``ament_copyright`` fails under ``colcon test``. Where the package does not run it,
or skips it as ``ros2 pkg create`` writes it, this is one piece of advice for the package.

**Fix.** Begin each C, C++, CMake and Python file with a line such as
``# Copyright 2026 Example Robotics`` and the header of the licence. No automatic fix: the
tool does not know who holds the copyright.

**Source.** ``ament_copyright/main.py``; ROS 2 developer guide, "Licensing".
""",
    ),
    AmentCode(
        "LY021",
        "licence-header-unknown",
        "The text after the copyright notice of a source file is not a known license header",
        COPYRIGHT,
        Severity.ERROR,
        other_severities={Severity.INFO: "no test of the package runs ament_copyright on the file"},
        message=(
            '"Use of this source code …" begins the header of no licence that '
            "is known: ament_copyright fails"
        ),
        documentation="""\
**Why.** ``ament_copyright`` fails under ``colcon test``: it compares word for word, and knows
no ``SPDX-License-Identifier`` lines. Where the package does not run it, this is one piece of
advice for the package.

**Fix.** Use the header of the licence as it was published; ``ament_copyright --list-licenses``
shows which are known.

**Source.** ``ament_copyright/parser.py``; ament/ament_lint#462.
""",
    ),
    AmentCode(
        "LY022",
        "repository-file-missing",
        "A package that is a repository of its own lacks a known LICENSE or CONTRIBUTING.md",
        COPYRIGHT,
        Severity.ERROR,
        other_severities={Severity.INFO: "no test of the package runs ament_copyright"},
        message=("the repository has no CONTRIBUTING.md: ament_copyright fails"),
        documentation="""\
**Why.** ``ament_copyright`` asks for both in the directory that has ``.git`` or ``.hg``, with
the text it knows, and fails under ``colcon test``. A package inside of a repository is not
asked.

**Fix.** ``ament_copyright --add-missing "NAME" LICENCE`` writes both.

**Source.** ``ament_copyright/main.py`` and ``crawler.py``.
""",
    ),
    AmentCode(
        "PX050",
        "xml-not-well-formed",
        "An XML file other than package.xml cannot be read",
        XMLLINT,
        Severity.ERROR,
        message=("</node> expected, <node> opened at line 2 is not closed"),
        documentation="""\
**Why.** Whoever loads it (launch, a plugin loader, robot_state_publisher) stops there, and
``ament_xmllint`` fails under ``colcon test``. For package.xml itself SC001 says so.

**Fix.** Mend the markup at the place shown; a reader stops at the first mistake.

**Source.** ``ament_xmllint/main.py``; libxml2's limits on depth and length of text.
""",
    ),
    AmentCode(
        "PX051",
        "xml-schema-not-met",
        "An XML file other than package.xml does not fit the schema that it names",
        XMLLINT,
        message=(
            "does not fit a.xsd: Element 'nod': This element is not expected. Expected is ( node )"
        ),
        documentation="""\
**Why.** ``ament_xmllint`` validates every file that names a schema, and fails under
``colcon test``; also when the schema is not there.

**Fix.** Correct the file, or the place of the schema. For schemas that are
not looked at, see PX052.

**Source.** ``ament_xmllint/main.py``.
""",
    ),
    AmentCode(
        "PX052",
        "xml-schema-unchecked",
        "Whether an XML file fits the schema that it names is not checked",
        XMLLINT,
        Severity.INFO,
        message=("names the schema 'a.xsd', which is not looked at: it names other files"),
        documentation="""\
**Why.** ``ament_xmllint`` validates the file under ``colcon test``, so it may fail there
although nothing is reported here. A check neither fetches anything nor lets a schema open
further files, and it ends a schema that takes more than some seconds.

**Fix.** None is needed; run ``ament_xmllint`` to know. A schema that is one file of the
package is checked.

**Source.** ``ament_xmllint/main.py``.
""",
    ),
    AmentCode(
        "PX060",
        "element-misplaced",
        "An element of package.xml is where the schema does not allow it",
        XMLLINT,
        fix=SAFE,
        message=("<author> must come after <license> in line 7 and before <depend> in line 8"),
        documentation="""\
**Why.** ``ament_xmllint`` fails under ``colcon test``, with a message that names the element
after the wrong one.

**Fix.** Put the elements in the order name, version, description, maintainer, license, url,
author, dependencies, group_depend, member_of_group, export. Comments go with the element that
they stand in front of; where there are any, the author should look at the result.

**Source.** The schemas ``package_format1.xsd`` to ``package_format3.xsd``; REP-149.
""",
    ),
    AmentCode(
        "PX061",
        "element-unknown",
        "package.xml has an element that its format does not know",
        XMLLINT,
        Severity.ERROR,
        fix=UNSAFE,
        message=("<run_depend> is of format 1: in format 3 it is <exec_depend>"),
        documentation="""\
**Why.** colcon refuses the manifest: the package is not built, or only as something else.

**Fix.** Use the element of this format: ``<exec_depend>`` instead of ``<run_depend>`` since
format 2, or declare the later format.

**Source.** REP-127, REP-140, REP-149; ``catkin_pkg/package.py``.
""",
    ),
    AmentCode(
        "PX062",
        "element-missing",
        "package.xml lacks a name, version, description, maintainer or license",
        XMLLINT,
        Severity.ERROR,
        message=("no <license>: every manifest has one, after <maintainer>"),
        documentation="""\
**Why.** colcon refuses the manifest: the package is not built, or only as something else.

**Fix.** Add the element. No automatic fix: the author has to say what is in it.

**Source.** REP-149, "Required tags"; ``catkin_pkg/package.py``.
""",
    ),
    AmentCode(
        "PX063",
        "element-repeated",
        "package.xml has a second name, version, description or export",
        XMLLINT,
        Severity.ERROR,
        fix=SAFE,
        message=("a second <name>: the first is in line 2"),
        documentation="""\
**Why.** colcon refuses the manifest: the package is not built, or only as something else.

**Fix.** Keep one; put everything that is exported into one ``<export>``.

**Source.** REP-149; ``catkin_pkg/package.py``.
""",
    ),
    AmentCode(
        "PX064",
        "attribute-unknown",
        "An element of package.xml has an attribute that its format does not know",
        XMLLINT,
        Severity.ERROR,
        message=("<version compatibility> is in REP-149, but ament_xmllint's schema refuses it"),
        documentation="""\
**Why.** colcon refuses the manifest, or ``ament_xmllint`` fails under ``colcon test``.

**Fix.** Correct the name or remove the attribute.

**Source.** REP-127, REP-140, REP-149 and their schemas. ``<version compatibility>`` is in
REP-149 but not in the schema of format 3, so the linter refuses it.
""",
    ),
    AmentCode(
        "PX065",
        "format-differs",
        "``format`` is not 1, 2 or 3, or the ``<?xml-model?>`` line names another one",
        XMLLINT,
        Severity.ERROR,
        fix=SAFE,
        message=("names the schema of format 2, but <package> has 3"),
        documentation="""\
**Why.** colcon reads ``format`` and refuses one it does not know; ``ament_xmllint`` reads the
schema and fails under ``colcon test`` when the two differ. Without ``format`` it is 1.

**Fix.** Write the same number in both; 3 is the format of ROS 2.

**Source.** REP-149; ``catkin_pkg/package.py``; ``ament_xmllint/main.py``.
""",
    ),
    AmentCode(
        "PX066",
        "text-between-elements",
        "Text between the elements of package.xml, or directly in ``<export>``",
        XMLLINT,
        message=("text between the elements: only comments are allowed"),
        documentation="""\
**Why.** ``ament_xmllint`` fails under ``colcon test``; everybody else ignores the text, which
is mostly the rest of an element or of a comment.

**Fix.** Remove the text, or make a comment of it.

**Source.** The schemas ``package_format1.xsd`` to ``package_format3.xsd``.
""",
    ),
    AmentCode(
        "PX067",
        "name-malformed",
        "The name of the package has characters that a name may not have",
        XMLLINT,
        Severity.ERROR,
        other_severities={
            Severity.WARNING: "only dashes are wrong, and the package has no messages"
        },
        message=("the name 'Talker-two' has - in it: only a to z, 0 to 9 and _ are allowed"),
        documentation="""\
**Why.** ``ament_xmllint`` fails under ``colcon test``. Names with a capital cannot be released,
and interfaces of such a package cannot be generated. A dash alone is a warning: packages of
such a name have been released.

**Fix.** Use lower-case letters, digits and single underscores between them, a letter first.
No automatic fix: the name is in other files, too.

**Source.** REP-144; REP-149, ``<name>``; the schemas.
""",
    ),
    AmentCode(
        "PX068",
        "version-malformed",
        "The version of the package is not three numbers with dots between them",
        XMLLINT,
        Severity.ERROR,
        message=("the version '0.1' is not MAJOR.MINOR.PATCH"),
        documentation="""\
**Why.** colcon refuses the manifest: the package is not built, or only as something else. A
number with a leading zero fails in ``ament_xmllint`` only.

**Fix.** Write ``MAJOR.MINOR.PATCH`` such as ``0.1.0``.

**Source.** REP-149, ``<version>``; ``catkin_pkg/package.py``.
""",
    ),
    AmentCode(
        "PX069",
        "url-type-unknown",
        "``<url type>`` is none of website, bugtracker and repository",
        XMLLINT,
        message=("the url type 'homepage' is not known, only website, bugtracker, repository"),
        documentation="""\
**Why.** ``ament_xmllint`` fails under ``colcon test``, and the index of packages shows no
link.

**Fix.** Use one of the three; without ``type`` it is a website.

**Source.** REP-149, ``<url>``; the schemas.
""",
    ),
    AmentCode(
        "PX070",
        "dependency-version-malformed",
        "``version_gte`` or alike of a dependency is not one to three numbers",
        XMLLINT,
        message=('version_gte="1.x" is not one to three numbers'),
        documentation="""\
**Why.** ``ament_xmllint`` fails under ``colcon test``, and bloom writes a wrong dependency
into the release.

**Fix.** Write ``1``, ``1.2`` or ``1.2.3``.

**Source.** REP-149, "Dependency tags"; the schemas.
""",
    ),
    AmentCode(
        "PX071",
        "condition-misplaced",
        "A ``condition`` is where its format has none, or has characters that are not allowed",
        XMLLINT,
        Severity.ERROR,
        message=("conditions need format 3, but this manifest has format 2"),
        documentation="""\
**Why.** colcon refuses the manifest, or ``ament_xmllint`` fails under ``colcon test``.

**Fix.** Declare format 3; only dependencies and groups have conditions. Those of groups take
no quotes in the schema: write the bare word.

**Source.** REP-149, "Conditions"; ``package_format3.xsd``.
""",
    ),
    AmentCode(
        "PX072",
        "email-missing",
        "A ``<maintainer>`` has no e-mail address",
        XMLLINT,
        Severity.ERROR,
        message=("the maintainer 'A' has no email"),
        documentation="""\
**Why.** colcon refuses the manifest: the package is not built, or only as something else.

**Fix.** Add ``email="..."``. No automatic fix: the tool does not know the address.

**Source.** REP-149, ``<maintainer>``; ``catkin_pkg/package.py``.
""",
    ),
    AmentCode(
        "PX073",
        "email-malformed",
        "The email address of a maintainer or author is not an address",
        XMLLINT,
        Severity.ERROR,
        message=("'a at b.org' is not an email address"),
        documentation="""\
**Why.** colcon refuses the manifest: the package is not built, or only as something else.

**Fix.** Write ``name@domain.org``; letters of ASCII, digits and ``-_%+`` only.

**Source.** REP-149; ``catkin_pkg/package.py``; the schemas.
""",
    ),
    AmentCode(
        "PX074",
        "element-nested",
        "An element is inside one that holds only text",
        XMLLINT,
        Severity.ERROR,
        message=("<url> is inside <license>, which holds text only"),
        documentation="""\
**Why.** colcon refuses the manifest: the package is not built, or only as something else.

**Fix.** Close the outer element first; only ``<description>`` and ``<export>`` hold others.

**Source.** REP-149; ``catkin_pkg/package.py``; the schemas.
""",
    ),
    AmentCode(
        "PX075",
        "url-malformed",
        "The text of a ``<url>`` is not a URL",
        XMLLINT,
        message=("'http://a.org:port/b' is not a URL"),
        documentation="""\
**Why.** ``ament_xmllint`` fails under ``colcon test``, and the link leads nowhere.

**Fix.** Correct the URL: a port is a number, ``%`` begins two hexadecimal digits.

**Source.** REP-149, ``<url>``; the schemas, type ``anyURI``.
""",
    ),
    AmentCode(
        "Q000",
        "string-quotes",
        "double quotes around a string that single quotes would do for",
        fix=SAFE,
    ),
    AmentCode(
        "Q001", "multiline-string-quotes", "single quotes around a multi-line string", fix=SAFE
    ),
    AmentCode("Q002", "single-quoted-docstring", "single quotes around a docstring", fix=SAFE),
    AmentCode(
        "Q003",
        "avoidable-escape",
        "escaped quotes that other quotes around the string would save",
        fix=SAFE,
    ),
    AmentCode("W191", "tab-indentation", "the indentation contains tabs"),
    AmentCode("W291", "trailing-whitespace", "trailing whitespace", fix=SAFE),
    AmentCode("W292", "no-newline-at-end", "no newline at the end of the file", fix=SAFE),
    AmentCode("W293", "whitespace-on-blank-line", "whitespace on a blank line", fix=SAFE),
    AmentCode("W391", "blank-line-at-end", "blank line at the end of the file", fix=SAFE),
    AmentCode("W605", "invalid-escape", "an escape sequence that does not exist", fix=SAFE),
)

CODES: Mapping[str, AmentCode] = {row.code: row for row in _TABLE}
"""By code, in alphabetical order."""
STYLE: Mapping[str, AmentCode] = {code: row for code, row in CODES.items() if row.linters & BOTH}
"""Those about Python style and docstrings."""


def diagnostic(
    code: str,
    at: Location,
    message: str,
    fix: Fix | None = None,
    severity: Severity | None = None,
    cause: str = "",
) -> Diagnostic:
    """Return a diagnostic of a code, with the name and severity that the table gives it."""
    row = CODES[code]
    return Diagnostic(code, row.name, severity or row.severity, at, message, fix, cause)
