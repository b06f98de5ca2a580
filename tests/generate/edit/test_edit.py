"""Edits that add a part to a package: inserted lines, and that all others stay."""

from __future__ import annotations

from collections.abc import Mapping
from textwrap import dedent, indent

import pytest

from scaffold.errors import ConflictError, InputError
from scaffold.generate.edit import changelog, cmake, launch, manifest, readme, setup_cfg, setup_py
from scaffold.generate.edit.addition import Addition, ByHand, Compiled, Outcome, Program
from scaffold.generate.edit.edit import edit
from scaffold.generate.edit.layout import Layout, layout_of
from scaffold.model.package import Package
from scaffold.source import ParseError, Source

SCRIPT = Program("scripts/talker.py", "talker.py", "talker")
MODULE = Program("demo/talker.py", "talker", "demo.talker")


def source(path: str, text: str) -> Source:
    return Source(path, dedent(text))


def added(before: Source, after: Source) -> str:
    """Return the lines that an edit added; fail if any line was removed."""
    lines = after.text.splitlines(keepends=True)
    result: list[str] = []
    for line in before.text.splitlines(keepends=True):
        while lines and lines[0] != line:
            result.append(lines.pop(0))
        assert lines, f"{line!r} is gone or has moved"
        lines.pop(0)
    return "".join([*result, *lines])


# -- package.xml

MANIFEST = """\
    <?xml version="1.0"?>
    <package format="3">
      <name>demo</name>
      <license>MIT</license>
      <buildtool_depend>ament_cmake</buildtool_depend>

      <!-- what it talks with -->
      <depend>rclcpp</depend>  <!-- the library -->
      <exec_depend>tf2</exec_depend>

      <test_depend>ament_lint_auto</test_depend>
      <export>
        <build_type>ament_cmake</build_type>
      </export>
    </package>
    """


def add_dependencies(text: str, **kinds: list[str]) -> tuple[Source, Outcome]:
    before = source("package.xml", text)
    return before, manifest.add_to_manifest(before, Addition("demo", depends=kinds))


def test_dependencies_are_grouped_by_kind() -> None:
    before, after = add_dependencies(
        MANIFEST, exec=["std_msgs", "rclpy"], test=["ament_cmake_pytest"]
    )
    assert added(before, after.source) == (
        "  <exec_depend>rclpy</exec_depend>\n"
        "  <exec_depend>std_msgs</exec_depend>\n"
        "  <test_depend>ament_cmake_pytest</test_depend>\n"
    )
    at = after.source.lines
    assert at.index("  <exec_depend>rclpy</exec_depend>") == 8
    assert at.index("  <exec_depend>tf2</exec_depend>") == 10
    assert at.index("  <test_depend>ament_cmake_pytest</test_depend>") == 12


def test_first_exec_depend_follows_the_other_dependencies() -> None:
    text = MANIFEST.replace("      <exec_depend>tf2</exec_depend>\n", "")
    before, after = add_dependencies(text, exec=["rclpy"])
    assert added(before, after.source) == "  <exec_depend>rclpy</exec_depend>\n"
    assert after.source.lines[8] == "  <exec_depend>rclpy</exec_depend>"


@pytest.mark.parametrize(
    ("kind", "name"),
    [
        ("exec", "rclcpp"),  # a depend is there when the package runs
        ("exec", "tf2"),
        ("exec", "demo"),  # itself
        ("test", "tf2"),
        ("build", "rclcpp"),
        ("depend", "rclcpp"),
        ("buildtool", "ament_cmake"),
    ],
)
def test_dependency_covered_by_another_kind_is_not_declared(kind: str, name: str) -> None:
    before, after = add_dependencies(MANIFEST, **{kind: [name]})
    assert after.source.text == before.text


@pytest.mark.parametrize(
    ("kind", "declared", "expected"),
    [
        ("exec", "<build_depend>x</build_depend>", ["exec_depend"]),
        (
            "depend",
            "<exec_depend>x</exec_depend>",
            ["build_depend", "build_export_depend"],
        ),
        ("depend", "", ["depend"]),
        ("build_export", "<build_depend>x</build_depend>", ["build_export_depend"]),
        ("exec", '<exec_depend condition="$ROS_DISTRO == foxy">x</exec_depend>', ["exec_depend"]),
        ("exec", "<test_depend>x</test_depend>", ["exec_depend"]),
    ],
)
def test_missing_kind_of_dependency_is_declared(
    kind: str, declared: str, expected: list[str]
) -> None:
    text = f'<package format="3">\n  <name>demo</name>\n  {declared}\n</package>\n'
    before, after = add_dependencies(text, **{kind: ["x"]})
    lines = added(before, after.source).split()
    assert sorted(lines) == [f"<{tag}>x</{tag}>" for tag in expected]


def test_format_1_uses_run_depend() -> None:
    before, after = add_dependencies("<package>\n  <name>demo</name>\n</package>\n", exec=["rclpy"])
    assert added(before, after.source) == "  <run_depend>rclpy</run_depend>\n"


def test_member_of_group_is_added_once() -> None:
    before = source("package.xml", MANIFEST)
    addition = Addition("demo", groups=["rosidl_interface_packages"])
    after = manifest.add_to_manifest(before, addition).source
    assert added(before, after) == (
        "  <member_of_group>rosidl_interface_packages</member_of_group>\n"
    )
    assert manifest.add_to_manifest(after, addition).source.text == after.text


def test_line_endings_and_encoding_are_kept() -> None:
    text = dedent(MANIFEST).replace("\n", "\r\n").replace("1.0", '1.0" encoding="latin-1')
    package = Package.of(
        {
            "package.xml": text.replace("library", "bibliothèque").encode("latin-1"),
            "CMakeLists.txt": "project(demo)\r\nfind_package(ament_cmake)\r\nament_package()\r\n",
        }
    )
    files = edit(package, Addition("demo", SCRIPT, depends={"exec": ["rclpy"]})).files
    assert "bibliothèque" in files["package.xml"].decode("latin-1")
    for data in files.values():
        assert data.count(b"\n") == data.count(b"\r\n") == len(data.splitlines())


# -- CMakeLists.txt

PLAIN = """\
    cmake_minimum_required(VERSION 3.8)
    project(demo)
    find_package(ament_cmake REQUIRED)

    # the end
    ament_package()
    """


def cmake_edit(text: str, addition: Addition, *, python: bool = False) -> Outcome:
    before = source("CMakeLists.txt", text)
    outcome = cmake.add_to_cmake(before, addition, python_package=python)
    again = cmake.add_to_cmake(outcome.source, addition, python_package=python)
    assert again.source.text == outcome.source.text
    assert again.by_hand == outcome.by_hand
    return outcome


def test_program_and_test_are_inserted_before_ament_package() -> None:
    outcome = cmake_edit(PLAIN, Addition("demo", SCRIPT, test="test/test_talker.py"))
    assert outcome.by_hand == ()
    assert outcome.source.text == dedent(
        """\
        cmake_minimum_required(VERSION 3.8)
        project(demo)
        find_package(ament_cmake REQUIRED)

        install(
          PROGRAMS
            scripts/talker.py
          DESTINATION lib/${PROJECT_NAME}
        )

        if(BUILD_TESTING)
          find_package(ament_cmake_pytest REQUIRED)
          ament_add_pytest_test(test_talker test/test_talker.py TIMEOUT 300)
        endif()

        # the end
        ament_package()
        """
    )


@pytest.mark.parametrize(
    ("install", "expected"),
    [
        (
            "install(PROGRAMS scripts/a.py DESTINATION lib/${PROJECT_NAME})",
            "install(PROGRAMS scripts/a.py scripts/talker.py DESTINATION lib/${PROJECT_NAME})",
        ),
        (
            (
                "install(\n  PROGRAMS\n    scripts/a.py  # first\n    tools/b.sh\n"
                "  DESTINATION lib/demo/\n)"
            ),
            (
                "install(\n  PROGRAMS\n    scripts/a.py  # first\n    scripts/talker.py\n"
                "    tools/b.sh\n  DESTINATION lib/demo/\n)"
            ),
        ),
        (
            (
                'install(PROGRAMS\n  "${CMAKE_CURRENT_SOURCE_DIR}/scripts/a.py"\n'
                "  DESTINATION lib/${PROJECT_NAME})"
            ),
            (
                'install(PROGRAMS\n  "${CMAKE_CURRENT_SOURCE_DIR}/scripts/a.py"\n'
                '  "${CMAKE_CURRENT_SOURCE_DIR}/scripts/talker.py"\n'
                "  DESTINATION lib/${PROJECT_NAME})"
            ),
        ),
        (
            (
                "set(programs scripts/a.py)\n"
                "install(PROGRAMS ${programs} DESTINATION lib/${PROJECT_NAME})"
            ),
            (
                "set(programs scripts/a.py)\n"
                "install(PROGRAMS ${programs} scripts/talker.py DESTINATION lib/${PROJECT_NAME})"
            ),
        ),
    ],
)
def test_program_is_added_to_matching_install(install: str, expected: str) -> None:
    text = dedent(PLAIN).replace("# the end\n", f"{install}\n# the end\n")
    outcome = cmake_edit(text, Addition("demo", SCRIPT))
    assert outcome.source.text == text.replace(install, expected)


def test_program_in_the_python_package_is_installed_like_the_others() -> None:
    text = PLAIN.replace(
        "# the end", "install(PROGRAMS ${PROJECT_NAME}/a.py DESTINATION lib/${PROJECT_NAME})"
    )
    outcome = cmake_edit(text, Addition("demo", MODULE))
    assert "PROGRAMS ${PROJECT_NAME}/a.py ${PROJECT_NAME}/talker.py DEST" in outcome.source.text


@pytest.mark.parametrize(
    "install",
    [
        "install(PROGRAMS scripts/talker.py DESTINATION lib/${PROJECT_NAME})",
        "install(PROGRAMS scripts/talker.py DESTINATION lib/demo RENAME talk)",
        "install(DIRECTORY scripts/ DESTINATION lib/demo USE_SOURCE_PERMISSIONS)",
        "file(GLOB found scripts/*.py)\ninstall(PROGRAMS ${found} DESTINATION lib/demo)",
    ],
)
def test_installed_program_is_not_added_again(install: str) -> None:
    text = dedent(PLAIN).replace("# the end", install)
    assert cmake_edit(text, Addition("demo", SCRIPT)).source.text == text


@pytest.mark.parametrize(
    "install",
    [
        "install(PROGRAMS scripts/a.py DESTINATION bin)",
        "install(PROGRAMS scripts/a.py DESTINATION lib/demo RENAME a)",
        "if(UNIX)\n  install(PROGRAMS scripts/a.py DESTINATION lib/demo)\nendif()",
        "foreach(f a.py b.py)\n  install(PROGRAMS ${f} DESTINATION lib/demo)\nendforeach()",
        "install(DIRECTORY scripts/ DESTINATION lib/demo)",
        "install(PROGRAMS scripts/a.py DESTINATION lib/demo OPTIONAL)",
    ],
)
def test_program_is_not_added_to_a_different_install(install: str) -> None:
    text = dedent(PLAIN).replace("# the end", install)
    outcome = cmake_edit(text, Addition("demo", SCRIPT))
    assert added(Source("CMakeLists.txt", text), outcome.source) == (
        "\ninstall(\n  PROGRAMS\n    scripts/talker.py\n  DESTINATION lib/${PROJECT_NAME}\n)\n\n"
    )


def test_test_is_inserted_after_the_others() -> None:
    text = PLAIN.replace(
        "# the end",
        "if(BUILD_TESTING)\n"
        "      find_package(ament_cmake_pytest REQUIRED)\n"
        "      ament_add_pytest_test(test_a test/test_a.py)  # first\n"
        "      find_package(ament_lint_auto REQUIRED)\n"
        "    endif()",
    )
    before = source("CMakeLists.txt", text)
    outcome = cmake_edit(text, Addition("demo", test="test/test_b.py"))
    line = "  ament_add_pytest_test(test_b test/test_b.py TIMEOUT 300)"
    assert added(before, outcome.source) == f"{line}\n"
    assert outcome.source.lines[7] == line


def test_long_test_line_is_wrapped() -> None:
    name = "x" * 22
    outcome = cmake_edit(dedent(PLAIN), Addition("demo", test=f"test/{name}_test.py"))
    assert (
        f"  ament_add_pytest_test({name}_test test/{name}_test.py TIMEOUT 300)\n"
    ) in outcome.source.text
    outcome = cmake_edit(dedent(PLAIN), Addition("demo", test=f"test/{name}x_test.py"))
    assert (
        f"  ament_add_pytest_test({name}x_test test/{name}x_test.py\n    TIMEOUT 300)\n"
    ) in outcome.source.text


@pytest.mark.parametrize(
    "call",
    [
        "ament_add_pytest_test(any test/test_b.py TIMEOUT 9)",
        "ament_add_ros_isolated_pytest_test(any test/test_b.py)",
        "ament_add_pytest_test(all test)",
    ],
)
def test_existing_test_is_not_added_again(call: str) -> None:
    text = dedent(PLAIN).replace("# the end", f"if(BUILD_TESTING)\n  {call}\nendif()")
    assert cmake_edit(text, Addition("demo", test="test/test_b.py")).source.text == text


def test_ament_auto_finds_dependencies_of_tests() -> None:
    text = dedent(PLAIN).replace(
        "# the end", "if(BUILD_TESTING)\n  ament_auto_find_test_dependencies()\nendif()"
    )
    outcome = cmake_edit(text, Addition("demo", test="test/test_b.py"))
    assert added(Source("CMakeLists.txt", text), outcome.source) == (
        "  ament_add_pytest_test(test_b test/test_b.py TIMEOUT 300)\n"
    )


def test_ament_cmake_python_is_found_with_the_python_package() -> None:
    outcome = cmake_edit(PLAIN, Addition("demo", MODULE), python=True)
    assert added(source("CMakeLists.txt", PLAIN), outcome.source) == (
        "find_package(ament_cmake_python REQUIRED)\n"
        "ament_python_install_package(${PROJECT_NAME})\n\n"
        "install(\n  PROGRAMS\n    demo/talker.py\n  DESTINATION lib/${PROJECT_NAME}\n)\n\n"
    )


@pytest.mark.parametrize(
    ("before", "after"),
    [
        (
            "install(DIRECTORY launch DESTINATION share/${PROJECT_NAME})\nament_package()\n",
            "install(DIRECTORY launch config DESTINATION share/${PROJECT_NAME})\nament_package()\n",
        ),
        (
            "ament_auto_package(INSTALL_TO_SHARE\n  launch\n)\n",
            "ament_auto_package(INSTALL_TO_SHARE\n  launch\n  config\n)\n",
        ),
        (
            "ament_package()\n",
            (
                "install(\n  DIRECTORY\n    config\n  DESTINATION share/${PROJECT_NAME}\n)\n\n"
                "ament_package()\n"
            ),
        ),
        (
            "install(DIRECTORY config/ DESTINATION share/demo/settings)\nament_package()\n",
            "install(DIRECTORY config/ DESTINATION share/demo/settings)\nament_package()\n",
        ),
    ],
)
def test_directory_is_installed_to_share(before: str, after: str) -> None:
    head = "project(demo)\n\n"
    outcome = cmake_edit(head + before, Addition("demo", directories=["config"]))
    assert outcome.source.text == head + after


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("project(other)\nament_package()\n", "the name of the project is not known to be 'demo'"),
        ("project(demo)\nif(X)\n  ament_package()\nendif()\n", "no ament_package() at the top"),
        (
            "project(${NAME})\nament_package()\n",
            "the name of the project is not known to be 'demo'",
        ),
    ],
)
def test_unsafe_edits_are_left_to_the_user(text: str, reason: str) -> None:
    outcome = cmake_edit(text, Addition("demo", SCRIPT, test="test/test_talker.py"))
    assert outcome.source.text == text
    assert [step.line for step in outcome.by_hand] == [
        "install(PROGRAMS scripts/talker.py DESTINATION lib/${PROJECT_NAME})",
        (
            "find_package(ament_cmake_pytest REQUIRED) and "
            "ament_add_pytest_test(test_talker test/test_talker.py TIMEOUT 300) "
            "inside if(BUILD_TESTING)"
        ),
    ]
    assert all(reason in step.reason and step.is_needed for step in outcome.by_hand)


def test_install_reached_only_by_tests_is_left_to_the_user() -> None:
    early = "if(NOT BUILD_TESTING)\n  ament_package()\n  return()\nendif()\n"
    text = f"project(demo)\nfind_package(ament_cmake REQUIRED)\n{early}ament_package()\n"
    outcome = cmake_edit(text, Addition("demo", SCRIPT, test="test/test_talker.py"))
    assert "(test_talker test/test_talker.py TIMEOUT 300)" in outcome.source.text
    assert [step.reason for step in outcome.by_hand] == [
        "the end of the file is not always reached"
    ]


def test_broken_file_is_rejected() -> None:
    with pytest.raises(ParseError) as error:
        cmake_edit("project(demo)\nfind_package(x\nament_package()\n", Addition("demo", SCRIPT))
    assert error.value.location.line == 2


# -- interfaces and C++ programs

INTERFACES = """\
    project(demo)
    find_package(ament_cmake REQUIRED)
    find_package(rosidl_default_generators REQUIRED)

    rosidl_generate_interfaces(${PROJECT_NAME}
      "msg/A.msg"
      "srv/B.srv"
      DEPENDENCIES std_msgs
    )
    ament_export_dependencies(rosidl_default_runtime)
    ament_package()
    """


def test_interface_is_grouped_by_kind() -> None:
    addition = Addition("demo", interfaces=["msg/C.msg"], interface_depends=["geometry_msgs"])
    outcome = cmake_edit(INTERFACES, addition)
    assert outcome.source.text == dedent(INTERFACES).replace(
        '"msg/A.msg"\n', '"msg/A.msg"\n  "msg/C.msg"\n'
    ).replace("DEPENDENCIES std_msgs", "DEPENDENCIES std_msgs geometry_msgs").replace(
        "find_package(rosidl", "find_package(geometry_msgs REQUIRED)\nfind_package(rosidl"
    )


def test_interface_is_added_to_the_list_variable() -> None:
    text = (
        "project(demo)\nset(files\n  msg/A.msg\n)\n"
        "rosidl_generate_interfaces(${PROJECT_NAME} ${files})\n"
        "find_package(rosidl_default_generators REQUIRED)\n"
        "ament_export_dependencies(rosidl_default_runtime)\nament_package()\n"
    )
    outcome = cmake_edit(text, Addition("demo", interfaces=["msg/C.msg"]))
    assert outcome.source.text == text.replace("msg/A.msg\n", "msg/A.msg\n  msg/C.msg\n")


def test_value_is_added_to_empty_keyword() -> None:
    text = dedent(INTERFACES).replace(" std_msgs", "")
    addition = Addition("demo", interfaces=["msg/A.msg", "msg/C.msg"], interface_depends=["x"])
    outcome = cmake_edit(text, addition)
    assert outcome.source.lines[9:12] == ["  DEPENDENCIES", "  x", ")"]


def test_interfaces_generated_only_for_tests_are_left_to_the_user() -> None:
    text = "project(demo)\nif(NOT BUILD_TESTING)\n  return()\nendif()\nament_package()\n"
    outcome = cmake_edit(text, Addition("demo", interfaces=["msg/C.msg"]))
    assert outcome.source.text == text
    assert [step.reason for step in outcome.by_hand] == [
        "the end of the file is not always reached"
    ]


def test_first_interface_adds_rosidl_commands() -> None:
    text = "project(demo NONE)\nfind_package(ament_cmake REQUIRED)\n\nament_package()\n"
    addition = Addition("demo", interfaces=["srv/C.srv"], interface_depends=["std_msgs"])
    assert cmake_edit(text, addition).source.text == dedent(
        """\
        project(demo)
        find_package(ament_cmake REQUIRED)
        find_package(rosidl_default_generators REQUIRED)
        find_package(std_msgs REQUIRED)

        rosidl_generate_interfaces(${PROJECT_NAME}
          "srv/C.srv"
          DEPENDENCIES std_msgs
        )

        ament_export_dependencies(rosidl_default_runtime)

        ament_package()
        """
    )


@pytest.mark.parametrize(
    "line",
    [
        "add_library(demo a.cpp)",
        "ament_auto_add_library(demo a.cpp)",
        "ament_python_install_package(${PROJECT_NAME})",
    ],
)
def test_interfaces_are_rejected_where_the_target_name_is_taken(line: str) -> None:
    text = f"project(demo)\n{line}\nament_package()\n"
    with pytest.raises(InputError, match=r"CMakeLists.txt:2:1: .* such as demo_interfaces"):
        cmake_edit(text, Addition("demo", interfaces=["msg/C.msg"]))


def test_compiled_program_is_built_and_installed() -> None:
    text = PLAIN.replace("project(demo)", "project(demo LANGUAGES C)")
    outcome = cmake_edit(text, Addition("demo", compiled=Compiled("two", "src/two.cpp")))
    assert outcome.source.text == dedent(
        """\
        cmake_minimum_required(VERSION 3.8)
        project(demo LANGUAGES C CXX)
        find_package(ament_cmake REQUIRED)

        add_executable(two src/two.cpp)
        target_compile_features(two PRIVATE cxx_std_17)

        install(
          TARGETS
            two
          DESTINATION lib/${PROJECT_NAME}
        )

        if(BUILD_TESTING)
          ament_add_test(two_runs
            COMMAND $<TARGET_FILE:two> GENERATE_RESULT_FOR_RETURN_CODE_ZERO)
        endif()

        # the end
        ament_package()
        """
    )


@pytest.mark.parametrize("line", ["add_executable(two a.cpp)", "ament_auto_add_library(two b.cpp)"])
def test_existing_target_is_not_added_again(line: str) -> None:
    text = f"project(demo)\n{line}\nament_package()\n"
    with pytest.raises(ConflictError, match=r"CMakeLists.txt:2:1: .*defines a target 'two'"):
        cmake_edit(text, Addition("demo", compiled=Compiled("two", "src/two.cpp")))


def test_compiled_program_is_defined_before_its_install() -> None:
    text = (
        "project(demo)\nadd_executable(one src/one.cpp)\nament_target_dependencies(one m)\n"
        "install(TARGETS one DESTINATION lib/${PROJECT_NAME})\nament_package()\n"
    )
    outcome = cmake_edit(text, Addition("demo", compiled=Compiled("two", "src/two.cpp")))
    assert outcome.source.lines[3:6] == [
        "add_executable(two src/two.cpp)",
        "target_compile_features(two PRIVATE cxx_std_17)",
        "install(TARGETS one two DESTINATION lib/${PROJECT_NAME})",
    ]


# -- setup.py and setup.cfg

SETUP = """\
    from setuptools import find_packages, setup

    package_name = 'demo'

    setup(
        name=package_name,
        packages=find_packages(exclude=['test']),
        data_files=[
            ('share/' + package_name, ['package.xml']),
        ],
        tests_require=['pytest'],
        entry_points={
            'console_scripts': [
                'a = demo.a:main',  # first
            ],
        },
    )
    """


def setup_edit(text: str, addition: Addition, *, extra: bool = False) -> Outcome:
    before = source("setup.py", text)
    outcome = setup_py.add_to_setup(before, addition, extra=extra)
    again = setup_py.add_to_setup(outcome.source, addition, extra=extra)
    assert again.source.text == outcome.source.text
    return outcome


def test_entry_point_is_added_to_the_others() -> None:
    outcome = setup_edit(SETUP, Addition("demo", MODULE))
    assert added(source("setup.py", SETUP), outcome.source) == (
        "            'talker = demo.talker:main',\n"
    )


@pytest.mark.parametrize(
    ("points", "expected"),
    [
        ("['a=demo.a:main']", "['a=demo.a:main', 'talker=demo.talker:main']"),
        ('["a = demo.a:main"]', '["a = demo.a:main", "talker = demo.talker:main"]'),
    ],
)
def test_entry_point_is_formatted_like_the_others(points: str, expected: str) -> None:
    text = f"import setuptools\npoints = {points}\n"
    text += "setuptools.setup(entry_points={'console_scripts': points})\n"
    outcome = setup_edit(text, Addition("demo", MODULE))
    assert expected in outcome.source.text


def test_entry_point_is_added_to_a_multiline_string() -> None:
    text = '''\
        from setuptools import setup
        setup(packages=['demo'], entry_points="""
            [console_scripts]
            a = demo.a:main
            [other]
            b = demo.b:C
        """)
        '''
    outcome = setup_edit(text, Addition("demo", MODULE))
    assert added(source("setup.py", text), outcome.source) == "    talker = demo.talker:main\n"
    assert outcome.source.lines[4] == "    talker = demo.talker:main"


@pytest.mark.parametrize(
    ("packages", "expected"),
    [
        ("['other']", "['other', package_name]"),
        ("[]", "[package_name]"),
        ("[package_name]", "[package_name]"),
    ],
)
def test_python_package_of_module_is_installed(packages: str, expected: str) -> None:
    text = (
        "from setuptools import setup\n\npackage_name = 'demo'\n"
        "setup(packages={}, entry_points={{'console_scripts': []}})\n"
    )
    outcome = setup_edit(text.format(packages), Addition("demo", MODULE))
    assert outcome.by_hand == ()
    assert f"packages={expected}," in outcome.source.text


def test_unknown_packages_are_left_to_the_user() -> None:
    text = "from setuptools import setup\nfrom x import y\nsetup(packages=y())\n"
    outcome = setup_edit(text, Addition("demo", MODULE))
    assert outcome.by_hand == (
        ByHand(
            "setup.py", "packages=['demo'],", "it is not clear whether packages= includes 'demo'"
        ),
    )


def test_unknown_entry_points_are_left_to_the_user() -> None:
    text = "from setuptools import setup\nfrom x import y\nsetup(packages=['demo'], **y)\n"
    outcome = setup_edit(text, Addition("demo", MODULE))
    assert outcome.source.text == text
    assert [step.line for step in outcome.by_hand] == ["'talker = demo.talker:main',"]


@pytest.mark.parametrize(
    ("head", "lines"),
    [
        ("", ("from glob import glob\n\n        ('share/' + package_name + '/config', "
             "glob('config/*')),\n")),
        ("import glob\n\n", ("        ('share/' + package_name + '/config', "
                            "glob.glob('config/*')),\n")),
        ("from glob import glob\n\n", ("        ('share/' + package_name + '/config', "
                                      "glob('config/*')),\n")),
    ],
)  # fmt: skip
def test_directory_is_added_to_data_files(head: str, lines: str) -> None:
    text = head + dedent(SETUP)
    outcome = setup_edit(text, Addition("demo", directories=["config"]))
    assert added(Source("setup.py", text), outcome.source) == lines


LAUNCH_DATA = '\n        (f"share/{name}/launch", ["launch/demo.launch.py"]'


@pytest.mark.parametrize(
    ("entry", "expected"),
    [
        ('glob("launch/*_launch.py")', 'glob("launch/*_launch.py")),' + LAUNCH_DATA),
        ('["launch/a.launch.py"]', '["launch/a.launch.py", "launch/demo.launch.py"]'),
        ('glob("launch/*")', 'glob("launch/*")'),
        ("found()", "found()"),
    ],
)
def test_file_is_added_to_data_files_of_its_directory(entry: str, expected: str) -> None:
    text = (
        "from glob import glob\n\nfrom setuptools import setup\n\n"
        f'name = "demo"\n\nsetup(\n    name=name,\n    version="1",\n    data_files=[\n'
        f'        (f"share/{{name}}/launch", {entry}),\n    ],\n)\n'
    )
    addition = Addition("demo", directories=["launch"], shared=["launch/demo.launch.py"])
    outcome = setup_edit(text, addition)
    assert outcome.source.text == text.replace(entry, expected)
    assert setup_edit(outcome.source.text, addition).source.text == outcome.source.text


def test_pytest_is_declared_if_missing() -> None:
    addition = Addition("demo", test="test/test_a.py")
    assert setup_edit(SETUP, addition, extra=True).source.text == dedent(SETUP)
    text = SETUP.replace("        tests_require=['pytest'],\n", "")
    outcome = setup_edit(text, addition, extra=True)
    assert added(source("setup.py", text), outcome.source) == (
        "    extras_require={'test': ['pytest']},\n"
    )


def test_script_directories_of_setup_cfg_stay_consistent() -> None:
    before = source(
        "setup.cfg",
        """\
        [options.entry_points]
        console_scripts =
            a=demo.a:main
        [develop]
        script_dir=$base/lib/demo
        """,
    )
    outcome = setup_cfg.add_to_setup_cfg(before, Addition("demo", MODULE))
    assert added(before, outcome.source) == "    talker=demo.talker:main\n"
    again = setup_cfg.add_to_setup_cfg(outcome.source, Addition("demo", MODULE))
    assert again.source.text == outcome.source.text


def test_first_executable_is_installed_for_ros2_run() -> None:
    outcome = setup_cfg.add_directories(
        Source("setup.cfg", ""), Addition("demo", MODULE), has_others=False
    )
    assert outcome.source.text == (
        "[develop]\nscript_dir=$base/lib/demo\n[install]\ninstall_scripts=$base/lib/demo\n"
    )


def test_executables_in_bin_are_not_moved() -> None:
    outcome = setup_cfg.add_directories(
        Source("setup.cfg", ""), Addition("demo", MODULE), has_others=True
    )
    assert outcome.source.text == ""
    assert [step.line for step in outcome.by_hand] == [
        "[develop] script_dir=$base/lib/demo",
        "[install] install_scripts=$base/lib/demo",
    ]


def test_wrong_script_directory_is_left_to_the_user() -> None:
    text = "[develop]\nscript_dir=$base/lib/demo/\n[install]\ninstall-scripts=$base/lib/old\n"
    outcome = setup_cfg.add_directories(
        Source("setup.cfg", text), Addition("demo", MODULE), has_others=True
    )
    assert outcome.source.text == text
    assert outcome.by_hand == (
        ByHand(
            "setup.cfg",
            "[install] install_scripts=$base/lib/demo",
            "it is $base/lib/old, where `ros2 run` does not find executables",
        ),
    )


# -- launch files

LAUNCH = """\
    from launch import LaunchDescription
    from launch_ros.actions import Node


    def generate_launch_description():
        return LaunchDescription([
            Node(package='demo', executable='a', output='screen'),
        ])
    """


def launch_edit(text: str, path: str = "launch/demo.launch.py") -> Outcome:
    outcome = launch.add_to_launch(source(path, text), Addition("demo", MODULE))
    again = launch.add_to_launch(outcome.source, Addition("demo", MODULE))
    assert again.source.text == outcome.source.text
    return outcome


def test_node_is_formatted_like_the_others_in_a_launch_file() -> None:
    outcome = launch_edit(LAUNCH)
    assert added(source("x", LAUNCH), outcome.source) == (
        "        Node(package='demo', executable='talker', output='screen'),\n"
    )


def test_settings_of_all_nodes_are_copied_in_a_launch_file() -> None:
    level = "arguments=['--ros-args', '--log-level', level]"
    shared = f"parameters=[{{'use_sim_time': clock}}], {level}"
    own = f"parameters=['a.yaml', {{'use_sim_time': clock}}, {{'gain': 2.0}}], {level}, name='a'"
    text = LAUNCH.replace("output='screen'", own)
    assert added(source("x", text), launch_edit(text).source) == (
        f"        Node(package='demo', executable='talker', {shared}),\n"
    )
    text = LAUNCH.replace("output='screen'", "parameters=['a.yaml'], arguments=['--fast']")
    assert added(source("x", text), launch_edit(text).source) == (
        "        Node(package='demo', executable='talker'),\n"
    )


def test_node_is_written_on_several_lines_like_the_others() -> None:
    text = LAUNCH.replace(
        "Node(package='demo', executable='a', output='screen'),",
        'Node(\n                package="demo",\n                executable="a",\n            )',
    )
    assert launch_edit(text).source.text.endswith(
        '            executable="a",\n        ),\n        Node(\n'
        '            package="demo",\n            executable="talker",\n        ),\n    ])\n'
    )


@pytest.mark.parametrize(
    ("before", "after"),
    [
        (
            """\
            a = Node(package='demo', executable='a')  # the first

            return LaunchDescription([other, a])
            """,
            """\
            a = Node(package='demo', executable='a')  # the first
            talker_node = Node(package='demo', executable='talker')

            return LaunchDescription([other, a, talker_node])
            """,
        ),
        (
            """\
            a = Node(
                package='demo',
                executable='a')

            return LaunchDescription([
                a
            ])
            """,
            """\
            a = Node(
                package='demo',
                executable='a')

            talker_node = Node(
                package='demo',
                executable='talker',
            )

            return LaunchDescription([
                a,
                talker_node,
            ])
            """,
        ),
        (
            """\
            found = LaunchDescription()
            a = Node(package="demo", executable="a", output='screen')
            found.add_action(a)
            # the end
            return found
            """,
            """\
            found = LaunchDescription()
            a = Node(package="demo", executable="a", output='screen')
            talker_node = Node(package="demo", executable="talker", output='screen')
            found.add_action(a)
            found.add_action(talker_node)
            # the end
            return found
            """,
        ),
        (
            """\
            found = LaunchDescription([other])
            found.add_action(Node(
                package='demo', executable='a'))
            return found
            """,
            """\
            found = LaunchDescription([other])
            found.add_action(Node(
                package='demo', executable='a'))
            found.add_action(Node(
                package='demo',
                executable='talker',
            ))
            return found
            """,
        ),
    ],
)
def test_node_is_inserted_next_to_the_others(before: str, after: str) -> None:
    head = dedent(LAUNCH).partition("    return")[0]
    outcome = launch_edit(head + indent(dedent(before), "    "))
    assert outcome.source.text == head + indent(dedent(after), "    ")
    assert outcome.by_hand == ()


@pytest.mark.parametrize(
    "body",
    [
        "a = talker_node = Node(package='demo', executable='a')\nreturn LaunchDescription([a])\n",
        "a = Node(package='demo', executable='a')\nreturn LaunchDescription(a)\n",
        "if x:\n    a = Node(package='demo', executable='a')\nreturn LaunchDescription([a])\n",
        "x = Node(package='demo', executable='a')\nx = LaunchDescription([x])\nreturn f(x)\n",
    ],
)
def test_complex_launch_file_is_left_to_the_user(body: str) -> None:
    text = dedent(LAUNCH).partition("    return")[0] + indent(body, "    ")
    outcome = launch_edit(text)
    assert outcome.source.text == text
    assert [step.line for step in outcome.by_hand] == ["Node(package='demo', executable='talker'),"]


def test_launch_file_for_other_packages_is_left_to_the_user() -> None:
    outcome = launch_edit(LAUNCH.replace("package='demo'", "package='other'"))
    assert [step.reason for step in outcome.by_hand] == ["it starts no node of demo that shows how"]
    assert "talker" not in outcome.source.text


def test_launch_file_without_a_list_is_left_to_the_user() -> None:
    text = LAUNCH.replace("return LaunchDescription([", "x = LaunchDescription([").replace(
        "])\n", "])\n        return x\n"
    )
    text = text.replace("Node(package='demo'", "n := Node(package='demo'")
    outcome = launch_edit(text)
    assert [step.line for step in outcome.by_hand] == ["Node(package='demo', executable='talker'),"]
    assert not outcome.by_hand[0].is_needed


@pytest.mark.parametrize(
    ("path", "text", "line"),
    [
        (
            "launch/a.launch.xml",
            '<launch><node pkg="demo" exec="a"/></launch>',
            '<node pkg="demo" exec="talker"/>',
        ),
        (
            "launch/a.launch.yaml",
            "launch:\n- node:\n    pkg: demo\n    exec: a\n",
            "- node: {pkg: demo, exec: talker}",
        ),
    ],
)
def test_xml_and_yaml_launch_files_are_left_to_the_user(path: str, text: str, line: str) -> None:
    assert [step.line for step in launch_edit(text, path).by_hand] == [line]
    assert [step.line for step in launch_edit(text.replace("demo", "other"), path).by_hand] == [
        line
    ]
    assert launch_edit(text.replace("exec", "talker"), path).by_hand == ()


# -- README.md and CHANGELOG.rst

PART = """\
# demo

## Run

```bash
ros2 run demo talker
```

## Topics

| Topic | Type |
| --- | --- |
| `/talk` | `String` |

## Parameters

| Node | Parameter |
| --- | --- |
| `talker` | `rate` |
"""


def test_rows_are_added_to_the_table_with_equal_columns() -> None:
    before = Source("README.md", "# x\n\n|Topic|Type|\n|---|:-:|\n| a | b |\nend\n")
    addition = Addition("demo", readme=PART)
    after = readme.add_to_readme(before, addition).source
    assert added(before, after) == "| `/talk` | `String` |\n"
    assert readme.add_to_readme(after, addition).source.text == after.text


def test_other_tables_and_code_blocks_are_unchanged() -> None:
    text = "| Topic | Name |\n|---|---|\n\n```\n| Topic | Type |\n|---|---|\n```\n## Run\n"
    before = Source("README.md", text)
    assert readme.add_to_readme(before, Addition("demo", readme=PART)).source.text == text


def generated_readme(run: str, tables: str = "") -> str:
    return (
        f"# demo\n\n## Prerequisites\n\n## Build\n\n## Run\n\n{run}\n\n{tables}"
        "## Test\n\n## Author\n\n## License\n"
    )


def test_readme_of_an_older_release_gets_row_and_heading() -> None:
    table = "## Topics\n\n| Topic | Type |\n| --- | --- |\n| `/a` | `B` |\n\n"
    before = Source("README.md", generated_readme("```bash\nros2 run demo a\n```", table))
    part = (
        "## Run\n\n### talker\n\n```bash\nros2 run demo talker\n```\n\n## Topics\n\n"
        "| Node | Topic | Type |\n| --- | --- | --- |\n| `talker` | `/talk` | `String` |\n"
    )
    after = readme.add_to_readme(before, Addition("demo", readme=part)).source
    assert added(before, after) == (
        "### talker\n\n```bash\nros2 run demo talker\n```\n\n| `/talk` | `String` |\n"
    )
    assert readme.add_to_readme(after, Addition("demo", readme=part)).source.text == after.text


@pytest.mark.parametrize("programs", ["", "### C++ programs\n\n"])
def test_program_is_added_to_the_table_of_programs(programs: str) -> None:
    table = "| Program | What it does |\n| --- | --- |\n| `{0}` | X |"
    text = programs + "```bash\nros2 run demo {0}\n```\n\n" + table
    before = Source("README.md", generated_readme(text.format("one")))
    part = "## Run\n\n### C++ programs\n\n" + text.removeprefix(programs).format("two") + "\n"
    after = readme.add_to_readme(before, Addition("demo", readme=part)).source
    assert added(before, after) == "```bash\nros2 run demo two\n```\n\n| `two` | X |\n"
    assert after.text.count("###") == programs.count("###")


def test_text_about_all_nodes_precedes_their_sections() -> None:
    before = Source(
        "README.md", generated_readme("### talker\n\n```bash\nros2 run demo talker\n```")
    )
    part = "## Run\n\nAll nodes:\n\n```bash\nros2 launch demo demo.launch.py\n```\n"
    after = readme.add_to_readme(before, Addition("demo", readme=part)).source
    assert "## Run\n\nAll nodes:\n\n```bash\nros2 launch demo demo.launch.py\n```\n\n### talk" in (
        after.text
    )
    assert readme.add_to_readme(after, Addition("demo", readme=part)).source.text == after.text


def test_sections_of_a_generated_readme_are_merged() -> None:
    before = Source(
        "README.md",
        "# demo\n\n## Prerequisites\n\n## Build\n\n## Run\n\n```bash\nros2 run demo a\n```\n\n"
        "## Topics\n\n| Topic | Type |\n| --- | --- |\n| `/a` | `B` |\n\n"
        "## Test\n\n## Author\n\n## License\n",
    )
    part = PART + "\n## Test\n\n## Author\n"
    after = readme.add_to_readme(before, Addition("demo", readme=part)).source
    assert added(before, after) == (
        "```bash\nros2 run demo talker\n```\n\n"
        "| `/talk` | `String` |\n"
        "## Parameters\n\n| Node | Parameter |\n| --- | --- |\n| `talker` | `rate` |\n\n"
    )
    assert readme.add_to_readme(after, Addition("demo", readme=part)).source.text == after.text


@pytest.mark.parametrize(
    ("entry", "is_added"),
    [("* Add the publisher node ``a``.", True), ("* Fixed everything (#1)", False)],
)
def test_changelog_entry_is_added_only_to_generated_changelogs(
    entry: str, is_added: object
) -> None:
    text = f"Changelog\n\nForthcoming\n-----------\n{entry}\n\n0.1.0\n-----\n* Start\n"
    before = Source("CHANGELOG.rst", text)
    addition = Addition("demo", changes=["* Add the publisher node ``b``."])
    after = changelog.add_to_changelog(before, addition).source
    assert added(before, after) == ("* Add the publisher node ``b``.\n" if is_added else "")
    assert changelog.add_to_changelog(after, addition).source.text == after.text


# -- where things go

XML = "<package format='3'><name>demo</name><export><build_type>{}</build_type></export></package>"


def package(build_type: str, files: Mapping[str, str]) -> Package:
    return Package.of({"package.xml": XML.format(build_type), **files})


@pytest.mark.parametrize(
    ("text", "files", "expected"),
    [
        ("", (), Layout("scripts", "", "test")),
        ("", ("tests/x.cpp",), Layout("scripts", "", "tests")),
        ("install(PROGRAMS bin/a.py DESTINATION lib/demo)", ("bin/a.py",),
         Layout("bin", "", "test")),
        ("install(PROGRAMS bin/a DESTINATION lib/demo)", ("bin/a",),
         Layout("scripts", "", "test")),
        ("install(PROGRAMS test/a.py tools/b.py DESTINATION lib/demo)", ("test/a.py", "tools/b.py"),
         Layout("tools", "", "test")),
        ("install(PROGRAMS x/a.py scripts/b.py DESTINATION lib/demo)", ("x/a.py", "scripts/b.py"),
         Layout("scripts", "", "test")),
        ("install(PROGRAMS demo/a.py DESTINATION lib/demo)", ("demo/a.py",),
         Layout("demo", "demo", "test")),
        ("ament_python_install_package(${PROJECT_NAME})", ("demo/__init__.py",),
         Layout("demo", "demo", "test")),
        ("ament_python_install_package(demo PACKAGE_DIR src/demo)", ("src/demo/__init__.py",),
         Layout("src/demo", "demo", "test")),
        ("", ("demo/__init__.py",), Layout("demo", "demo", "test", installs_python=True)),
        ("rosidl_generate_interfaces(demo msg/A.msg)", ("demo/__init__.py", "msg/A.msg"),
         Layout("scripts", "", "test")),
    ],
)  # fmt: skip
def test_cmake_packages_keep_their_layout(
    text: str, files: tuple[str, ...], expected: Layout
) -> None:
    lists = f"project(demo)\n{text}\nament_package()\n"
    result = package("ament_cmake", {"CMakeLists.txt": lists, **dict.fromkeys(files, "")})
    assert layout_of(result) == expected


@pytest.mark.parametrize(
    ("arguments", "files", "expected"),
    [
        ("packages=['demo']", ("demo/__init__.py",), Layout("demo", "demo", "test")),
        ("packages=[]", (), Layout("demo", "demo", "test", ("demo/__init__.py",))),
        ("entry_points={'console_scripts': ['a = demo.nodes.a:main']}", ("demo/nodes/__init__.py",),
         Layout("demo/nodes", "demo.nodes", "test")),
        ("entry_points={'console_scripts': ['a = demo.x.a:main', 'b = demo.y.b:main']}",
         ("demo/__init__.py",), Layout("demo", "demo", "test")),
        ("packages=find_packages('src'), package_dir={'': 'src'}", ("src/demo/__init__.py",),
         Layout("src/demo", "demo", "test")),
        ("packages=['demo'], package_dir={'demo': 'python'}", ("python/__init__.py",),
         Layout("python", "demo", "test")),
    ],
)  # fmt: skip
def test_python_packages_keep_their_layout(
    arguments: str, files: tuple[str, ...], expected: Layout
) -> None:
    text = f"from setuptools import find_packages, setup\nsetup({arguments})\n"
    result = package("ament_python", {"setup.py": text, **dict.fromkeys(files, "")})
    assert layout_of(result) == expected


def test_other_build_types_are_rejected() -> None:
    with pytest.raises(InputError, match="demo: the build type cmake is not supported"):
        layout_of(package("cmake", {}))
