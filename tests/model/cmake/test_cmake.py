"""CMakeLists.txt: tokens equal to those of CMake, locations, values and edits."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from hypothesis import HealthCheck, example, given, settings
from hypothesis import strategies as st

from scaffold.check import runner
from scaffold.check.rules.ament_rules import AMENT_RULES
from scaffold.edits import Edit
from scaffold.model.cmake import edit as cmake_edit
from scaffold.model.cmake.lists import CMakeLists, Command, Install
from scaffold.model.package import Package
from scaffold.source import ParseError, Source

TALKER = """\
# A talker.
cmake_minimum_required(VERSION 3.8)
project(talker)

find_package(ament_cmake REQUIRED)
find_package(rclpy REQUIRED)
find_package(std_msgs REQUIRED)

set(SCRIPTS scripts/a.py scripts/b.py)
install(
  PROGRAMS
    ${SCRIPTS}
    ${CMAKE_CURRENT_SOURCE_DIR}/${PROJECT_NAME}/talk.py  # the first one
  DESTINATION lib/${PROJECT_NAME}
)

install(DIRECTORY launch config DESTINATION share/${PROJECT_NAME})

# The linters.
if(BUILD_TESTING)
  find_package(ament_lint_auto REQUIRED)
  ament_lint_auto_find_test_dependencies()
endif()

ament_package()
"""


def read(text: str, path: str = "CMakeLists.txt") -> CMakeLists:
    return CMakeLists.parse(Source(path, text))


def only_command(text: str) -> Command:
    (command,) = read(text).commands
    return command


def apply(text: str, edits: tuple[Edit, ...] | None) -> str:
    assert edits is not None
    for edit in sorted(edits, key=lambda edit: edit.start, reverse=True):
        text = text[: edit.start] + edit.text + text[edit.end :]
    return text


def joined(lists: CMakeLists) -> str:
    return "".join(lists.text(token) for token in lists.tokens)


# -- CMake itself

CMAKE = shutil.which(
    "cmake", path=os.pathsep.join([os.environ["PATH"], str(Path(sys.executable).parent)])
)
with_cmake = pytest.mark.skipif(CMAKE is None, reason="cmake, the oracle, is not installed")


def run_cmake(path: Path, *options: str) -> subprocess.CompletedProcess[str]:
    assert CMAKE is not None
    return subprocess.run(
        [CMAKE, *options, "-P", str(path)],
        check=False,
        capture_output=True,
        encoding="utf-8",
        errors="replace",
        cwd=path.parent,
    )


def as_cmake_reads(lists: CMakeLists, tmp_path: Path) -> list[tuple[int, list[str]]]:
    """Return line and arguments of every command, from CMake's own trace.

    Every command is renamed to a macro that does nothing.
    """
    text = lists.source.text.removeprefix("\ufeff")
    shift = len(lists.source.text) - len(text)
    for command in reversed(lists.commands):
        start = command.start - shift
        text = text[:start] + "probe" + text[start + len(command.name) :]
    script, trace = tmp_path / "script.cmake", tmp_path / "trace.json"
    script.write_bytes(b"macro(probe)\nendmacro()\n" + text.encode())
    run_cmake(script, "--trace", "--trace-format=json-v1", f"--trace-redirect={trace}")
    entries = [json.loads(line) for line in trace.read_text("utf-8").splitlines()]
    return [(entry["line"] - 2, entry["args"]) for entry in entries if entry.get("cmd") == "probe"]


def cmake_accepts(text: str, tmp_path: Path) -> bool:
    script = tmp_path / "verdict.cmake"
    script.write_bytes(b"return()\n" + text.encode())
    return run_cmake(script).returncode == 0


SYNTAX = [
    "set(A b)",
    "SET ( A\n\tb\n)\n",
    "set()",
    'set(A "b c" "" "d\\"e" "f\\\\")',
    'set(A "b\\\n  c\n d")',
    'set(A "\\n\\;\\t${B} # no comment")',
    "set(A [[b]] [==[c ]] ]=] d]==] [[\ne\n]] [=[[[f]]]=])",
    "set(A b # c )\n d)",
    "set(A #[[ b\n) ]] c)",
    "set(A #[==[ b ]] ]==]\n c)",
    "#[[ a\n b ]]\nset(A b)",
    "#[ no bracket\nset(A b)",
    "# [[ nor this\nset(A b)",
    "set(A b;c d\\;e \\( \\) \\# f\\ g)",
    'set(A -DB="c d" e"f"g -DH=" i=[j ")',
    "set(A $(MAKE) -x$(B)c $(not one) $(D)$(E))",
    "set(A \\$(B))",
    "if((A AND (B)) OR NOT(C))\nendif()",
    "set(A $<IF:$<CONFIG:D>,b,c> ${${B}} $ENV{C} @D@)",
    "set(A [ b[c [d [=e x[[y ]] = == =[ [=)",
    "set(A b#c\n)",
    'set(A "b"c "d""e")',
    "set(A b)#c\nset(D e) # f",
    "foo_bar(A)\n_b1(C)\n",
    "\n\n  set(A b)\n\tset(C d)\r\nset(E\r\n  f)\r\n",
    'set(A "b\r\nc" [[\r\nd\r\ne]])',
    'set(é 😀 "ü")',
    "set(A b)",
    TALKER,
]


@with_cmake
@pytest.mark.parametrize("text", SYNTAX, ids=range(len(SYNTAX)))
def test_arguments_equal_those_of_cmake(text: str, tmp_path: Path) -> None:
    lists = read(text)
    assert not lists.errors
    mine = [
        (command.location.line, [argument.text for argument in command.arguments])
        for command in lists.commands
    ]
    assert mine == as_cmake_reads(lists, tmp_path)


def test_byte_order_mark() -> None:
    lists = read("\ufeffset(A b)")
    assert not lists.errors
    assert (lists.commands[0].start, joined(lists)) == (1, "\ufeffset(A b)")


PIECES = (
    ("set(", "if(", "endif()", "else()", "foreach(", "endforeach()", "message(", "foo(", "("),
    (")", ")\n", "\n", " ", "\t", "\r\n", '"', '"b c"', "[[", "]]", "[=[", "]=]", "#", "#[["),
    ("a", "B1", "\\", "\\;", "\\\n", "$", "$(", "$(X)", "${A}", "=", "[", "]", ";", "é", "-D"),
)
TEXTS = st.lists(st.sampled_from([*PIECES[0], *PIECES[1], *PIECES[2]]), max_size=20).map("".join)


@with_cmake
@settings(max_examples=60, suppress_health_check=list(HealthCheck))
@given(TEXTS)
@example("set(A b)#[[c]]set(D e)")
@example("set(A [[b]]c)")
@example("set(A [[b]](c))")
@example("set(A b[[c]])")
@example("set\n(A)")
@example("set(A \\\nb)")
def test_syntax_errors_equal_those_of_cmake(tmp_path: Path, text: str) -> None:
    assert (not read(text).errors) is cmake_accepts(text, tmp_path)


@given(st.one_of(TEXTS, st.text(max_size=40)))
@example("foo(" * 2000)
@example("if(\n" * 2000)
@example('"a\n' * 2001)
@example("\0")
def test_tokens_cover_the_whole_text(text: str) -> None:
    lists = read(text)
    assert joined(lists) == text
    ends = [0]
    for command in lists.commands:
        assert ends[-1] <= command.start < command.end <= len(text)
        ends.append(command.end)
        for argument in command.arguments:
            assert command.open_end <= argument.start < argument.end <= command.close_start
            assert lists.source.text[argument.start : argument.end] == argument.raw
    assert lists.installs is not None
    assert lists.found_packages is not None


# -- arguments and commands


@pytest.mark.parametrize(
    ("raw", "text", "value"),
    [
        ("a\\;b", "a\\;b", "a\\;b"),
        ("a\\ b\\(", "a\\ b\\(", "a b("),
        ('"a\\tb\\"\\\\"', 'a\\tb\\"\\\\', 'a\tb"\\'),
        ('"a\\\n b"', "a b", "a b"),
        ('"a\\\\\nb"', "a\\\\\nb", "a\\\nb"),
        ("[[a\\n${b}]]", "a\\n${b}", "a\\n${b}"),
        ("[=[\n]]\n]=]", "]]\n", "]]\n"),
        ("[=[\r\na]=]", "a", "a"),
        ('"a\r\nb"', "a\nb", "a\nb"),
        ("${a}", "${a}", "${a}"),
        ('-D"a b"', '-D"a b"', '-D"a b"'),
    ],
)
def test_raw_text_and_value_of_an_argument(raw: str, text: str, value: str) -> None:
    (argument,) = only_command(f"set({raw})").arguments
    assert (argument.raw, argument.text, argument.value) == (raw, text, value)
    assert argument.quoted is raw.startswith('"')
    assert argument.bracket is raw.startswith("[")


def test_locations_of_commands_and_arguments() -> None:
    install = read(TALKER).find("install")[0]
    assert install.location[1:] == (10, 1, 15, 2)
    assert install.name_location[1:] == (10, 1, 10, 8)
    assert install.arguments[2].location[1:] == (13, 5, 13, 56)
    assert TALKER[install.start : install.open_end] == "install("
    assert TALKER[install.close_start : install.end] == ")"


def test_command_names_are_case_insensitive() -> None:
    command = only_command("Find_Package (rclpy)")
    assert (command.name, command.written_name) == ("find_package", "Find_Package")


def test_find_returns_commands_in_file_order() -> None:
    lists = read(TALKER)
    assert [command.location.line for command in lists.find("install", "project")] == [3, 10, 17]
    assert lists.find("macro") == []


def test_keyword_sections_of_a_command() -> None:
    command = only_command("install(PROGRAMS a b DESTINATION c PROGRAMS d OPTIONAL)")
    keywords = {"PROGRAMS", "DESTINATION", "OPTIONAL"}
    sections = {
        name: [argument.value for argument in arguments]
        for name, arguments in command.sections(keywords).items()
    }
    assert sections == {
        "": [],
        "PROGRAMS": ["a", "b", "d"],
        "DESTINATION": ["c"],
        "OPTIONAL": [],
    }
    assert [item.value for item in command.keyword("DESTINATION", keywords)] == ["c"]
    assert command.keyword("RENAME", keywords) == []
    assert command.has("OPTIONAL")


def test_comment_tokens() -> None:
    lists = read("#a\nset(b #c\n)#[[d\n]]")
    assert [lists.text(token) for token in lists.comments] == ["#a", "#c", "#[[d\n]]"]


def test_blocks_around_a_command() -> None:
    lists = read("if(a)\nforeach(b c)\nd()\nendforeach()\nelse()\ne()\nendif()\nf()")
    seen = [
        (
            command.name,
            command.depth,
            [block.name for block in command.blocks],
            command.branch.name if command.branch else None,
        )
        for command in lists.commands
    ]
    assert seen == [
        ("if", 0, [], None),
        ("foreach", 1, ["if"], "if"),
        ("d", 2, ["if", "foreach"], "foreach"),
        ("endforeach", 1, ["if"], "if"),
        ("else", 0, [], None),
        ("e", 1, ["if"], "else"),
        ("endif", 0, [], None),
        ("f", 0, [], None),
    ]


# -- errors


@pytest.mark.parametrize(
    ("text", "errors"),
    [
        ("set(A b", ['1:1 ")" expected: set( is not closed']),
        ("a()\nset(A b\nfind_package(x)\nset(C d)", ['2:1 ")" expected: set( is not closed']),
        ("set(A b))", ['1:9 no "(" belongs to this ")"']),
        ("set A b\nset(C d)", ['1:1 "(" expected after set']),
        ("set(A b) set(C d)", ["1:10 a new line expected before this command"]),
        ('"A"\nset(B c)', ["1:1 the name of a command expected"]),
        ('set(A "b)\n', ['1:7 a second " expected: this string is not closed']),
        (
            'set(A "b)\nset(C d)\nset(E "f")\n',
            ['1:7 a second " expected: this string is not closed'],
        ),
        ("set(A [=[b]])", ['1:7 "]=]" expected: this bracket argument is not closed']),
        ("#[[ a\nset(B c)", ['1:1 "]]" expected: this bracket comment is not closed']),
        ("set(A [[b]]c)", ["1:12 a space expected before this argument"]),
        ("set(A \\\n b)", [r'1:7 "\" at the end of a line is only allowed inside a string']),
        ("set(A \0\0b)", ["1:7 the character U+0000 is not allowed here"]),
        ("endif()", ["1:1 if() expected before endif()"]),
        ("if(a)\nset(b c)", ["1:1 endif() expected: this block is not closed"]),
        (
            "if(a)\nforeach(b c)\nendif()",
            ["2:1 endforeach() expected before the endif() of line 3"],
        ),
        ("if(a)\nelse()\nelse()\nendif()", ["3:1 else() was the last branch of this if()"]),
        ("foreach(a b)\nelse()\nendforeach()", ["2:1 if() expected before else()"]),
    ],
)
def test_syntax_errors(text: str, errors: list[str]) -> None:
    lists = read(text)
    assert [f"{at.line}:{at.column} {message}" for at, message in lists.errors] == errors
    with pytest.raises(ParseError) as caught:
        lists.require()
    assert (caught.value.location, caught.value.message) == lists.errors[0]


def test_commands_after_an_error_are_parsed() -> None:
    lists = read('set(A b\nfind_package(x)\nset("C\n  d)\ninstall(FILES "e" DESTINATION f)\n')
    assert [command.name for command in lists.commands] == [
        "set",
        "find_package",
        "set",
        "install",
    ]
    assert lists.commands[0].closed is False
    assert lists.commands[1].values == ["x"]


def test_valid_file_raises_nothing() -> None:
    read(TALKER).require()


# -- values


def expanded(text: str, path: str = "CMakeLists.txt") -> list[str] | None:
    """Return what the arguments of use() become."""
    lists = read(text, path)
    (use,) = lists.find("use")
    return lists.expand_list(use.arguments, use)


@pytest.mark.parametrize(
    ("text", "values"),
    [
        ("project(p)\nuse(lib/${PROJECT_NAME})", ["lib/p"]),
        ("set(N p)\nproject(${N}_x)\nuse(${CMAKE_PROJECT_NAME})", ["p_x"]),
        ("use(${CMAKE_CURRENT_SOURCE_DIR}/a ${PROJECT_SOURCE_DIR})", ["a", "."]),
        ("project(p)\nuse(${p_SOURCE_DIR}/a)", ["a"]),
        ('set(A b c)\nuse(${A} "${A}" d${A})', ["b", "c", "b;c", "db", "c"]),
        ("set(A b)\nset(C ${A}c)\nset(A)\nuse(${C}${A})", ["bc"]),
        ("set(A b)\nuse(${A})\nset(A c)", ["b"]),
        ("set(A b)\nlist(APPEND A c d)\nuse(${A})", ["b", "c", "d"]),
        ("list(APPEND A c)\nuse(${A})", ["c"]),
        ("set(A B)\nset(B c)\nuse(${${A}})", ["c"]),
        ('use(a\\;b "c\\td" [[${e}]])', ["a;b", "c\td", "${e}"]),
        ("use(\\${A})", ["${A}"]),
        ("set(A b)\nunset(A)\nuse(x${A})", ["x"]),
        ("include(GNUInstallDirs)\nuse(${CMAKE_INSTALL_BINDIR})", ["bin"]),
        ("if(x)\nset(A b)\nuse(${A})\nendif()", ["b"]),
        ("set(A b)\nif(x)\nset(A c)\nelse()\nuse(${A})\nendif()", ["b"]),
        ("set(A b)\nfunction(f)\nset(A c)\nendfunction()\nuse(${A})", ["b"]),
        ("set(A b)\nadd_library(A)\nuse(${A})", ["b"]),
        ("use(${A})", None),
        ("use(${CMAKE_CURRENT_BINARY_DIR}/a)", None),
        ("use($ENV{A})", None),
        ("use($<TARGET_FILE:a>)", None),
        ("use(${A)", None),
        ("use(${A})\nset(A b)", None),
        ("set(A b CACHE STRING c)\nuse(${A})", None),
        ("if(x)\nset(A b)\nendif()\nuse(${A})", None),
        ("set(A b)\nif(x)\nset(A c)\nendif()\nuse(${A})", None),
        ("set(A b)\nmacro(f)\nset(A c)\nendmacro()\nuse(${A})", None),
        ("set(A b)\nfunction(f)\nset(A c PARENT_SCOPE)\nendfunction()\nuse(${A})", None),
        ("set(A b)\nfile(GLOB A *.py)\nuse(${A})", None),
        ("file(GLOB A *.py)\nlist(APPEND A b)\nuse(${A})", None),
        ("set(A b)\nmy_macro(A)\nuse(${A})", None),
        ("set(A b)\nfunction(f A)\nuse(${A})\nendfunction()", None),
        ("set(A b)\nforeach(A c d)\nuse(${A})\nendforeach()", None),
        ("foreach(x a b)\nset(A ${x})\nendforeach()\nuse(${A})", None),
    ],
)
def test_expand_variables(text: str, values: list[str] | None) -> None:
    assert expanded(text) == values


def test_expand_in_a_subdirectory() -> None:
    text = "use(${CMAKE_CURRENT_SOURCE_DIR}/a)"
    assert expanded(text, "sub/CMakeLists.txt") == ["sub/a"]


def test_exponentially_growing_values_are_unknown() -> None:
    doubling = "set(A ab)\n" + "set(A ${A}${A})\n" * 200
    assert expanded(f"{doubling}use(${{A}})") is None


def test_project_name() -> None:
    lists = read(TALKER)
    assert lists.project_name == "talker"
    assert lists.project_name_location is not None
    assert lists.project_name_location[1:] == (3, 9, 3, 15)
    assert read("set(A b)").project_name is None
    assert read("project(${X})").project_name is None


# -- testing


@pytest.mark.parametrize(
    ("text", "guarded"),
    [
        ("use()", False),
        ("if(BUILD_TESTING)\nuse()\nendif()", True),
        ("if(BUILD_TESTING AND UNIX)\nif(x)\nuse()\nendif()\nendif()", True),
        ("if(${BUILD_TESTING})\nuse()\nendif()", True),
        ("if(NOT BUILD_TESTING)\nuse()\nendif()", False),
        ("if(BUILD_TESTING)\nelse()\nuse()\nendif()", False),
        ("if(NOT BUILD_TESTING)\nelse()\nuse()\nendif()", True),
        ("if(x)\nelseif(BUILD_TESTING)\nuse()\nendif()", True),
        ("if(NOT BUILD_TESTING)\nreturn()\nendif()\nuse()", True),
        ("use()\nif(NOT BUILD_TESTING)\nreturn()\nendif()", False),
        ("if(BUILD_TESTING)\nendif()\nuse()", False),
    ],
)
def test_command_guarded_by_build_testing(text: str, guarded: bool) -> None:
    lists = read(text)
    assert lists.guarded_by_testing(lists.find("use")[0]) is guarded


# -- packages


def test_packages_found_by_find_package() -> None:
    result = read(TALKER).found_packages
    assert [(item.name, item.required, item.in_testing) for item in result] == [
        ("ament_cmake", True, False),
        ("rclpy", True, False),
        ("std_msgs", True, False),
        ("ament_lint_auto", True, True),
    ]
    assert result[1].location[1:] == (6, 14, 6, 19)


@pytest.mark.parametrize(
    "loop",
    [
        "foreach(d a b)",
        "foreach(d IN ITEMS a b)",
        "set(L a b)\nforeach(d ${L})",
        "set(L a b)\nforeach(d IN LISTS L)",
        "set(L a)\nforeach(d IN LISTS L ITEMS b)",
    ],
)
def test_packages_found_in_a_loop(loop: str) -> None:
    lists = read(f"{loop}\nfind_package(${{d}} QUIET)\nendforeach()")
    assert [(item.name, item.required) for item in lists.found_packages] == [
        ("a", False),
        ("b", False),
    ]
    assert lists.finds("b")


@pytest.mark.parametrize("loop", ["foreach(d ${L})", "foreach(d RANGE 3)", "while(d)"])
def test_packages_found_in_a_loop_over_an_unknown_list(loop: str) -> None:
    end = loop.partition("(")[0]
    assert read(f"{loop}\nfind_package(${{d}})\nend{end}()").found_packages == []


def test_packages_found_by_one_command() -> None:
    assert read("ament_auto_find_build_dependencies()").finds_automatically
    assert read("autoware_package()").finds_automatically
    assert read("ament_auto_find_test_dependencies()").finds_tests_automatically
    assert not read(TALKER).finds_automatically


# -- installation


def install_items(install: Install) -> list[tuple[str | None, str | None]]:
    return [(item.value, item.path) for item in install.items]


def test_installed_files_and_directories() -> None:
    programs, directories = read(TALKER).installs
    assert (programs.kind, programs.destination) == ("PROGRAMS", "lib/talker")
    assert install_items(programs) == [
        ("scripts/a.py", "scripts/a.py"),
        ("scripts/b.py", "scripts/b.py"),
        ("talker/talk.py", "talker/talk.py"),
    ]
    assert programs.items[0].location[1:] == (12, 5, 12, 15)
    assert programs.destination_argument is not None
    assert programs.destination_argument.location[1:] == (14, 15, 14, 34)
    assert (directories.kind, directories.destination) == ("DIRECTORY", "share/talker")
    assert install_items(directories) == [("launch", "launch"), ("config", "config")]


def install(text: str, path: str = "CMakeLists.txt") -> Install:
    (item,) = read(f"project(p)\n{text}", path).installs
    return item


def test_install_targets() -> None:
    result = install(
        "install(TARGETS a b EXPORT e ARCHIVE DESTINATION lib LIBRARY DESTINATION lib "
        "RUNTIME DESTINATION lib/${PROJECT_NAME} INCLUDES DESTINATION include)"
    )
    assert [item.value for item in result.items] == ["a", "b"]
    assert [item.path for item in result.items] == [None, None]
    assert result.destinations == {
        "ARCHIVE": "lib",
        "LIBRARY": "lib",
        "RUNTIME": "lib/p",
        "INCLUDES": "include",
    }


def test_install_with_rename_and_patterns() -> None:
    result = install("install(PROGRAMS a.py DESTINATION lib/p RENAME b)")
    assert (result.rename, result.patterns) == ("b", [])
    result = install(
        'install(DIRECTORY d/ DESTINATION s FILES_MATCHING PATTERN "*.py" PATTERN x EXCLUDE)'
    )
    assert (result.patterns, result.excludes) == (["*.py"], ["x"])
    assert install_items(result) == [("d/", "d")]


def test_install_of_unknown_values() -> None:
    result = install("install(FILES ${A} ${CMAKE_CURRENT_BINARY_DIR}/b c DESTINATION ${D})")
    assert install_items(result) == [(None, None), (None, None), ("c", "c")]
    assert result.destination is None
    assert result.destination_argument is not None


def test_install_paths() -> None:
    result = install(
        "install(FILES x ./y ../z ${CMAKE_SOURCE_DIR}/v /w DESTINATION ${CMAKE_INSTALL_PREFIX}/a)",
        "sub/CMakeLists.txt",
    )
    assert [item.path for item in result.items] == ["sub/x", "sub/y", "z", "sub/v", "/w"]
    assert result.destination == "a"


def test_install_in_a_loop() -> None:
    lists = read(
        "project(p)\nforeach(d launch config)\n"
        "install(DIRECTORY ${d}/ DESTINATION share/${PROJECT_NAME}/${d})\nendforeach()"
    )
    assert [(install_items(item), item.destination) for item in lists.installs] == [
        ([("launch/", "launch")], "share/p/launch"),
        ([("config/", "config")], "share/p/config"),
    ]


@pytest.mark.parametrize("name", ["ament_auto_package", "autoware_ament_auto_package"])
def test_directories_of_ament_auto_package(name: str) -> None:
    result = install(f"{name}(INSTALL_TO_SHARE launch config)")
    assert (result.kind, result.destination) == ("DIRECTORY", "share/p")
    assert install_items(result) == [("launch", "launch"), ("config", "config")]
    assert read(f"project(p)\n{name}()").installs == []


# -- edits


@pytest.mark.parametrize(
    ("name", "line"),
    [("geometry_msgs", 6), ("sensor_msgs", 7), ("tf2", 8)],
)
@pytest.mark.parametrize("newline", ["\n", "\r\n"])
def test_insert_find_package(name: str, line: int, newline: str) -> None:
    before = TALKER.replace("\n", newline)
    after = apply(before, cmake_edit.insert_find_package(read(before), name)).split(newline)
    assert after.pop(line - 1) == f"find_package({name} REQUIRED)"
    assert after == before.split(newline)


@pytest.mark.parametrize(
    ("before", "after"),
    [
        ("project(a) # b\n", "project(a) # b\n\nfind_package(m REQUIRED)\n"),
        ("FIND_PACKAGE (z)\n", "FIND_PACKAGE (m REQUIRED)\nFIND_PACKAGE (z)\n"),
        (
            "find_package(z)\nfind_package(b)\n",
            "find_package(z)\nfind_package(b)\nfind_package(m REQUIRED)\n",
        ),
        (
            "set(L\n  a\n  b)\nforeach(d ${L})\nfind_package(${d})\nendforeach()\n",
            "set(L\n  a\n  b\n  m)\nforeach(d ${L})\nfind_package(${d})\nendforeach()\n",
        ),
        ("ament_auto_find_build_dependencies()\n", "ament_auto_find_build_dependencies()\n"),
        ("find_package(m)\n", "find_package(m)\n"),
    ],
)
def test_place_of_inserted_find_package(before: str, after: str) -> None:
    assert apply(before, cmake_edit.insert_find_package(read(before), "m")) == after


def test_insert_find_package_for_tests() -> None:
    after = apply(TALKER, cmake_edit.insert_find_package(read(TALKER), "m", testing=True))
    added = "  find_package(ament_lint_auto REQUIRED)\n  find_package(m REQUIRED)\n"
    assert after == TALKER.replace("  find_package(ament_lint_auto REQUIRED)\n", added)
    bare = "project(p)\n\nament_package()\n"
    after = apply(bare, cmake_edit.insert_find_package(read(bare), "m", testing=True))
    block = "if(BUILD_TESTING)\n  find_package(m REQUIRED)\nendif()\n\n"
    assert after == f"project(p)\n\n{block}ament_package()\n"


def test_install_program() -> None:
    after = apply(TALKER, cmake_edit.install_program(read(TALKER), "scripts/c.py"))
    last = "/talk.py  # the first one\n"
    assert after == TALKER.replace(last, f"{last}    scripts/c.py\n")
    assert cmake_edit.install_program(read(after), "scripts/c.py") == ()


def test_install_directory() -> None:
    after = apply(TALKER, cmake_edit.install_directory(read(TALKER), "params"))
    assert after == TALKER.replace("launch config ", "launch config params ")


def test_new_install_is_inserted_above_the_comment() -> None:
    before = "project(p)\n# The end.\nament_package()\n"
    after = (
        "project(p)\n\ninstall(\n  PROGRAMS\n    a.py\n  DESTINATION lib/${PROJECT_NAME}\n)\n\n"
        "# The end.\nament_package()\n"
    )
    assert apply(before, cmake_edit.install_program(read(before), "a.py")) == after


def test_insert_in_build_testing_block() -> None:
    after = apply(TALKER, cmake_edit.insert_in_testing(read(TALKER), ["a()", "b()"]))
    assert after == TALKER.replace("endif()\n", "  a()\n  b()\nendif()\n")


def test_change_and_remove_arguments() -> None:
    lists = read(TALKER)
    project, launch = lists.find("project")[0], lists.find("install")[1].arguments[1]
    renamed = cmake_edit.replace_argument(lists, project.arguments[0], "x y")
    assert apply(TALKER, renamed) == TALKER.replace("project(talker)", 'project("x y")')
    without = TALKER.replace("DIRECTORY launch config", "DIRECTORY config")
    assert apply(TALKER, cmake_edit.remove_argument(lists, launch)) == without
    scripts = lists.find("install")[0].arguments[1]
    without = TALKER.replace("    ${SCRIPTS}\n", "")
    assert apply(TALKER, cmake_edit.remove_argument(lists, scripts)) == without


@pytest.mark.parametrize(
    ("value", "written"),
    [("a/b.py", "a/b.py"), ("${A}/b", "${A}/b"), ("a b", '"a b"'), ('a"\\', '"a\\"\\\\"')],
)
def test_quote_argument(value: str, written: str) -> None:
    assert cmake_edit.quote(value) == written


def test_broken_files_are_not_edited() -> None:
    lists = read(TALKER + "set(")
    assert cmake_edit.insert_find_package(lists, "m") is None
    assert cmake_edit.install_program(lists, "m") is None
    assert cmake_edit.insert_before_end(lists, ["m()"]) is None
    assert cmake_edit.insert_in_testing(lists, ["m()"]) is None
    assert cmake_edit.remove_argument(lists, lists.commands[0].arguments[0]) is None


def test_missing_parenthesis_is_reported_once() -> None:
    rules = [rule() for rule in AMENT_RULES if rule.code == "CM083"]

    def said(text: str) -> list[str]:
        package = Package.of({"CMakeLists.txt": text})
        return [finding.code for finding in runner.check(package, rules)]

    assert said("project(talker)\nament_package(\n") == ["SC001"]
    assert said('set(COLOUR "#fff")\n') == ["CM083"]
