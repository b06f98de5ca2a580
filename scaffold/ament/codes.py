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
        "A blank stands between a command and its ``(``",
        LINT_CMAKE,
        fix=SAFE,
        message=('a blank stands between "if" and its "("'),
        documentation="""\
**Why.** ``ament_lint_cmake`` fails under ``colcon test``.

**Fix.** Remove the blank.

**Source.** ament_lint_cmake, filter ``whitespace/extra``; ROS 2 code style, CMake.
""",
    ),
    AmentCode(
        "CM072",
        "parenthesis-space-mismatch",
        "The blanks behind ``(`` and before ``)`` of a command differ",
        LINT_CMAKE,
        fix=SAFE,
        message=('blanks behind the "(" of set and before the ")" in line 2 differ'),
        documentation="""\
**Why.** ``ament_lint_cmake`` fails under ``colcon test``. It compares with the first ``)``
that follows; one that begins a line may be indented like its command.

**Fix.** Remove the blanks.

**Source.** ament_lint_cmake, filter ``whitespace/mismatch``.
""",
    ),
    AmentCode(
        "CM073",
        "tab-in-cmake",
        "A line of a CMake file has a tab in it",
        LINT_CMAKE,
        fix=SAFE,
        message=("a tab: ament_lint_cmake wants blanks"),
        documentation="""\
**Why.** ``ament_lint_cmake`` fails under ``colcon test``.

**Fix.** Indent by two blanks per tab; between words one blank.

**Source.** ament_lint_cmake, filter ``whitespace/tabs``; ROS 2 code style, CMake.
""",
    ),
    AmentCode(
        "CM074",
        "trailing-space-in-cmake",
        "A line of a CMake file ends in blanks",
        LINT_CMAKE,
        fix=SAFE,
        message=("the line ends in blanks"),
        documentation="""\
**Why.** ``ament_lint_cmake`` fails under ``colcon test``.

**Fix.** Remove them; inside of a string that goes over several lines they count, and stay.

**Source.** ament_lint_cmake, filter ``whitespace/eol``.
""",
    ),
    AmentCode(
        "CM075",
        "odd-indentation",
        "A line of a CMake file begins with an odd number of blanks",
        LINT_CMAKE,
        message=("indented by 3 blanks: ament_lint_cmake wants steps of two"),
        documentation="""\
**Why.** ``ament_lint_cmake`` fails under ``colcon test``, in comments and strings as well.

**Fix.** Indent by two blanks per level. No automatic fix: the line may have to go to the left
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
        message=('"IF" stands in a file whose first command is in lower case'),
        documentation="""\
**Why.** ``ament_lint_cmake`` fails under ``colcon test``. What the first command is, it
demands of all others; the style guide wants lower case.

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
**Why.** ``ament_lint_cmake`` fails under ``colcon test``; the style guide wants lower case.

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
they go wrong unnoticed. The linter judges a line as a whole: a command with arguments behind
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
it. ``ament_lint_cmake`` fails under ``colcon test``, and it wants upper case.

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
a ``#`` begins a comment even inside of a string and hides the ``)`` behind it.

**Fix.** Close the command; break the line behind a string with a ``#``.

**Source.** ament_lint_cmake, filter ``syntax``.
""",
    ),
    AmentCode(
        "CM084",
        "lint-pragma-invalid",
        "A ``# lint_cmake:`` comment has a word that is no filter with ``-`` or ``+``",
        LINT_CMAKE,
        Severity.ERROR,
        message=("'linelength' is no filter with - or +: ament_lint_cmake crashes on it"),
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
        "a % format wants a mapping and gets none",
        severity=Severity.ERROR,
    ),
    AmentCode(
        "F503",
        "percent-format-expects-sequence",
        "a % format wants a sequence and gets none",
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
    AmentCode("I100", "import-order", "an import stands in the wrong place", fix=SAFE),
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
    code: str, at: Location, message: str, fix: Fix | None = None, severity: Severity | None = None
) -> Diagnostic:
    """Return a diagnostic of a code, with the name and severity that the table gives it."""
    row = CODES[code]
    return Diagnostic(code, row.name, severity or row.severity, at, message, fix)
