"""Values in functions, loops and included files, which are equal to those of CMake."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
from pathlib import Path

import pytest

from scaffold.model.package import Package

CMAKE = shutil.which("cmake")
FILES = {
    "nodes/talk.py": "",
    "nodes/listen.py": "",
    "nodes/deep/think.py": "",
    "tools/rake.v1.py": "",
    "cmake/macros.cmake": "macro(scripts)\n  install(PROGRAMS ${ARGN} DESTINATION ${where})\n"
    "endmacro()\ninclude(${CMAKE_CURRENT_LIST_DIR}/more.cmake)\n",
    "cmake/more.cmake": "set(more ${CMAKE_CURRENT_LIST_DIR}/more.cmake)\n",
}
HEAD = "set(PROJECT_NAME p)\nset(PROJECT_SOURCE_DIR ${CMAKE_CURRENT_LIST_DIR})\n"
PRINTS = "macro(install)\n  message(STATUS ${ARGV})\nendmacro()\n"

TEXTS = {
    "a macro": "macro(scripts)\n  install(PROGRAMS ${ARGN} DESTINATION lib/${PROJECT_NAME})\n"
    "endmacro()\nscripts(a.py b.py)\nset(names c d)\nscripts(${names})\nscripts(${names} e)\n",
    "parameters": "function(script name where)\n  set(path nodes/${name}.py)\n"
    "  install(PROGRAMS ${path} ${ARGN} DESTINATION ${where}/${ARGC})\nendfunction()\n"
    "script(a lib)\nscript(b lib c d)\n",
    "set between the definition and the call": "set(where lib/a)\nmacro(script name)\n"
    "  install(PROGRAMS ${name} DESTINATION ${where})\nendmacro()\nset(where lib/b)\n"
    "script(a.py)\n",
    "calls in loops and in functions": "function(one name)\n"
    "  install(PROGRAMS ${name}.py DESTINATION lib/${group})\nendfunction()\n"
    "function(all group)\n  foreach(name ${ARGN})\n    one(${name})\n  endforeach()\n"
    "endfunction()\nall(g a b)\nall(h c)\n",
    "set in a loop": "foreach(name a b)\n  set(path nodes/${name}.py)\n"
    "  install(PROGRAMS ${path} DESTINATION lib/${PROJECT_NAME})\nendforeach()\n",
    "a pattern": "file(GLOB nodes nodes/*.py)\ninstall(PROGRAMS ${nodes} DESTINATION lib)\n",
    "relative": "file(GLOB nodes RELATIVE ${CMAKE_CURRENT_SOURCE_DIR}\n"
    '  "${PROJECT_SOURCE_DIR}/nodes/*.py" tools/*)\ninstall(PROGRAMS ${nodes} DESTINATION lib)\n',
    "recursive": "file(GLOB_RECURSE nodes nodes/*.py)\n"
    "install(PROGRAMS ${nodes} DESTINATION lib)\n",
    "parts of paths": "file(GLOB tools tools/*.py)\nforeach(tool ${tools})\n"
    "  get_filename_component(name ${tool} NAME_WE)\n"
    "  install(PROGRAMS ${tool} DESTINATION lib RENAME ${name})\nendforeach()\n",
    "texts": "foreach(path nodes/talk.py nodes/Listen.py)\n"
    '  string(REPLACE "nodes/" "" name ${path})\n'
    '  string(REGEX REPLACE "\\\\.py$" "" name "${name}")\n  string(TOLOWER "${name}" lower)\n'
    "  string(TOUPPER ${name} upper)\n  string(CONCAT both ${lower} _ ${upper})\n"
    "  install(PROGRAMS ${path} DESTINATION lib RENAME ${both})\nendforeach()\n"
    'string(STRIP "  a " a)\nstring(REGEX REPLACE "_.*$" "" b "x_y_z")\n'
    "install(PROGRAMS ${a} ${b} DESTINATION lib)\n",
    "changed lists": "set(all b.py a.py c.txt a.py)\n"
    'list(FILTER all INCLUDE REGEX "\\\\.py$")\ninstall(PROGRAMS ${all} DESTINATION lib)\n'
    "list(REMOVE_DUPLICATES all)\nlist(SORT all)\ninstall(PROGRAMS ${all} DESTINATION lib)\n"
    "list(REVERSE all)\ninstall(PROGRAMS ${all} DESTINATION lib)\n"
    "list(REMOVE_ITEM all a.py d.py)\ninstall(PROGRAMS ${all} DESTINATION lib)\n"
    'file(GLOB_RECURSE nodes nodes/*.py)\nlist(FILTER nodes EXCLUDE REGEX "/deep/")\n'
    "install(PROGRAMS ${nodes} DESTINATION lib)\n",
    "an included file": "include(cmake/macros.cmake)\nset(where lib/p)\nscripts(nodes/talk.py)\n"
    "install(FILES ${more} DESTINATION share)\n",
}


@pytest.mark.skipif(CMAKE is None, reason="cmake is not installed")
@pytest.mark.parametrize("text", TEXTS.values(), ids=TEXTS)
def test_installs_equal_those_of_cmake(text: str, tmp_path: Path) -> None:
    for path, content in FILES.items():
        (tmp_path / path).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / path).write_text(content)
    (tmp_path / "CMakeLists.txt").write_text(HEAD + PRINTS + text)
    command = [str(CMAKE), "-P", "CMakeLists.txt"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=True)
    printed = [line.removeprefix("-- ") for line in done.stdout.splitlines()]
    assert installed(HEAD + text) == [
        re.sub(re.escape(f"{os.path.realpath(tmp_path)}/"), "", line) for line in printed
    ]


def installed(text: str) -> list[str]:
    """Return the arguments of ``install`` in each turn, in one piece as ``message`` prints them."""
    package = Package.of({**FILES, "CMakeLists.txt": text})
    return [
        "".join(
            [
                install.kind,
                *(str(item.value) for item in install.items),
                f"DESTINATION{install.destination}",
                f"RENAME{install.rename}" if install.rename else "",
            ]
        )
        for install in package.cmake.installs
    ]


UNKNOWN = {
    "an unknown argument before": "scripts(${unknown} a.py)\n",
    "a macro that calls itself": "function(again name)\n  again(${name}1)\n  scripts(${name})\n"
    "endfunction()\nagain(a)\n",
    "a macro that is defined twice": "macro(scripts)\nendmacro()\nscripts(a.py)\n",
    "not called": "",
}


@pytest.mark.parametrize("text", UNKNOWN.values(), ids=UNKNOWN)
def test_unknown_arguments_of_calls(text: str) -> None:
    lists = "macro(scripts)\n  install(PROGRAMS ${ARGN} DESTINATION lib/p)\nendmacro()\n"
    package = Package.of({"CMakeLists.txt": lists + text})
    (first, *_) = package.cmake.installs
    assert [item.value for item in first.items] == [None]


def test_work_is_bounded() -> None:
    calls = "".join(
        f"function(f{number} x)\n  f{number + 1}(${{x}})\n  f{number + 1}(${{x}}1)\n"
        "  install(FILES ${x} DESTINATION share)\nendfunction()\n"
        for number in range(100)
    )
    doubled = "".join(f"set(a{number + 1} ${{a{number}}}${{a{number}}})\n" for number in range(100))
    body = f"function(g a0)\n{doubled}install(FILES ${{a100}} DESTINATION share)\nendfunction()\n"
    package = Package.of({"CMakeLists.txt": f'{calls}{body}f0(1)\ng("")\n'})
    assert len(package.cmake.installs) < 20_000
