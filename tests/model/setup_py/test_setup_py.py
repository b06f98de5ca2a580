"""setup.py as data, and edits of it."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from scaffold.edits import Edit
from scaffold.model.python.evaluation.literals import string_pieces
from scaffold.model.python.evaluation.values import UNKNOWN, Glob
from scaffold.model.python.module import PythonModule
from scaffold.model.setup_py.edit import (
    add_console_script,
    add_data_files,
    add_import,
    package_expression,
)
from scaffold.model.setup_py.keywords import FindPackages
from scaffold.model.setup_py.setup_py import SetupPy
from scaffold.source import Location, NewerSyntaxError, ParseError, Source

SETUP = """\
from glob import glob
import os

from setuptools import find_packages, setup

package_name = 'demo'

setup(
    name=package_name,
    version='0.1.0',
    packages=find_packages(exclude=['test']),
    data_files=[
        ('share/ament_index/resource_index/packages',
            ['resource/' + package_name]),
        ('share/' + package_name, ['package.xml']),
        (os.path.join('share', package_name, 'launch'), glob('launch/*.launch.py')),
    ],
    install_requires=['setuptools'],
    maintainer='Jane Doe',
    maintainer_email='jane@example.org',
    description='Say hello.',
    license='Apache-2.0',
    extras_require={'test': ['pytest']},
    entry_points={
        'console_scripts': [
            'talker = demo.talker:main',
            'listener=demo.listener:Listener.main',
        ],
    },
)
"""


def view(text: str) -> SetupPy:
    return SetupPy(PythonModule.parse(Source("setup.py", text)))


def call(keywords: str) -> SetupPy:
    """Return the view of a setup() with some keywords."""
    return view(f"from setuptools import setup\npackage_name = 'demo'\nsetup({keywords})\n")


def place(at: Location) -> tuple[int, int, int, int]:
    return at.line, at.column, at.end_line, at.end_column


# -- the call


def test_keywords_of_setup() -> None:
    setup = view(SETUP)
    assert place(setup.location) == (8, 1, 8, 6)
    assert (setup.name, setup.version) == ("demo", "0.1.0")
    assert (setup.maintainer, setup.maintainer_email) == ("Jane Doe", "jane@example.org")
    assert (setup.description, setup.license) == ("Say hello.", "Apache-2.0")
    version = setup.keyword("version")
    assert version is not None
    assert place(version.location) == (10, 13, 10, 20)
    extras = setup.keyword("extras_require")
    assert extras is not None
    assert extras.value == {"test": ["pytest"]}
    assert setup.keyword("tests_require") is None
    assert not setup.has_unknown_keywords


@pytest.mark.parametrize(
    "text",
    [
        "import setuptools\nsetuptools.setup(name='a')\n",
        "from setuptools import setup as run\nrun(name='a')\n",
        "from distutils.core import setup\nsetup(name='a')\n",
        (
            "try:\n    from setuptools import setup\n"
            "except ImportError:\n    from distutils.core import setup\nsetup(name='a')\n"
        ),
        "from setuptools import setup\nif __name__ == '__main__':\n    setup(name='a')\n",
    ],
)
def test_ways_to_call_setup(text: str) -> None:
    assert view(text).name == "a"


@pytest.mark.parametrize(
    "text",
    [
        "",
        "def setup(**k): pass\nsetup(name='a')\n",
        "import setuptools\nsetuptools.find(name='a')\n",
    ],
)
def test_file_without_call_of_setup(text: str) -> None:
    setup = view(text)
    assert setup.call is None
    assert setup.name is None
    assert setup.location == Location.start_of("setup.py")
    assert not setup.data_files
    assert not setup.entry_points


def test_known_keyword_dictionary() -> None:
    setup = view(
        "from setuptools import setup\noptions = {'name': 'a', 'version': v()}\nsetup(**options)\n"
    )
    assert setup.name == "a"
    assert setup.version is UNKNOWN
    assert not setup.has_unknown_keywords
    name = setup.keyword("name")
    assert name is not None
    assert place(name.location) == (2, 20, 2, 23)


def test_unknown_keyword_dictionary() -> None:
    setup = call("version='1', **generated()")
    assert setup.version == "1"
    assert setup.name is UNKNOWN
    assert setup.has_unknown_keywords
    assert not setup.data_files_complete
    assert not setup.entry_points_complete
    assert setup.packages is UNKNOWN


# -- packages


@pytest.mark.parametrize(
    ("keywords", "expected"),
    [
        ("packages=[package_name, package_name + '.text']", ["demo", "demo.text"]),
        ("packages=names()", UNKNOWN),
        ("packages=[package_name] + more", UNKNOWN),
        ("name='a'", None),
    ],
)
def test_packages(keywords: str, expected: object) -> None:
    assert call(keywords).packages == expected


def test_find_packages() -> None:
    at = Location("setup.py", 11, 14, 11, 45)
    assert view(SETUP).packages == FindPackages(
        ".", ("test",), ("*",), namespace=False, location=at
    )


def test_find_packages_with_more_arguments() -> None:
    setup = view(
        "import setuptools\npackages = setuptools.find_namespace_packages('src', include=names())\n"
        "setuptools.setup(packages=packages)\n"
    )
    at = Location("setup.py", 2, 12, 2, 70)
    assert setup.packages == FindPackages("src", (), UNKNOWN, namespace=True, location=at)


# -- data_files


def test_data_files() -> None:
    setup = view(SETUP)
    assert [(entry.destination, entry.sources) for entry in setup.data_files] == [
        ("share/ament_index/resource_index/packages", ("resource/demo",)),
        ("share/demo", ("package.xml",)),
        ("share/demo/launch", (Glob("launch/*.launch.py"),)),
    ]
    assert setup.data_files_complete
    assert [place(entry.location) for entry in setup.data_files] == [
        (13, 9, 14, 42),
        (15, 9, 15, 51),
        (16, 9, 16, 84),
    ]
    first = setup.data_files[0]
    assert place(first.destination_location) == (13, 10, 13, 53)
    assert [place(at) for at in first.source_locations] == [(14, 14, 14, 40)]


@pytest.mark.parametrize(
    ("text", "expected", "complete"),
    [
        ("files = []\nfiles.append(('share/a', ['b']))", [("share/a", ("b",))], True),
        ("files = [('share/a', ['b'])] + extra()", [("share/a", ("b",))], False),
        ("files = [('share/a', ['b']), *extra]", [("share/a", ("b",))], False),
        ("files = [('share/a', ['b', c])]", [("share/a", ("b", UNKNOWN))], False),
        ("files = [(where, ['b'])]", [(UNKNOWN, ("b",))], False),
        ("files = [('share/a', ('b', 'c'))]", [("share/a", ("b", "c"))], True),
        ("files = [['share/a', ['b']]]", [("share/a", ("b",))], True),
        (
            "files = [('share/' + d, [d + '/x']) for d in ['a', 'b']]",
            [("share/a", ("a/x",)), ("share/b", ("b/x",))],
            True,
        ),
        (
            "files = []\nfor root in walk():\n    files.append(('share/a', ['b']))",
            [("share/a", ("b",))],
            False,
        ),
        (
            "from glob import glob\nfiles = [('share/a', ['b'] + glob('c/*'))]",
            [("share/a", ("b", Glob("c/*")))],
            True,
        ),
        ("files = generate()", [], False),
    ],
)
def test_common_spellings_of_data_files(
    text: str, expected: list[object], *, complete: bool
) -> None:
    setup = view(f"from setuptools import setup\n{text}\nsetup(data_files=files)\n")
    assert [(entry.destination, entry.sources) for entry in setup.data_files] == expected
    assert setup.data_files_complete is complete


def test_data_files_added_in_a_loop_are_conditional() -> None:
    setup = view(
        "from setuptools import setup\nfiles = [('share/a', ['b'])]\n"
        "for root in walk():\n    files.append((root, ['c']))\nsetup(data_files=files)\n"
    )
    assert [entry.conditional for entry in setup.data_files] == [False, True]


@pytest.mark.parametrize(
    ("entry", "problem"),
    [
        ("('share/a', 'b')", "the files are a string, not a list"),
        ("'share/a'", "not a pair of a directory and a list of files"),
        ("('share/a', ['b'], 'c')", "not a pair of a directory and a list of files"),
    ],
)
def test_malformed_data_files(entry: str, problem: str) -> None:
    setup = call(f"data_files=[{entry}]")
    assert [item.malformed for item in setup.data_files] == [problem]


# -- entry points


def test_entry_points() -> None:
    setup = view(SETUP)
    assert [
        (point.group, point.name, point.module, point.function, point.malformed, point.joined)
        for point in setup.entry_points
    ] == [
        ("console_scripts", "talker", "demo.talker", "main", None, ()),
        ("console_scripts", "listener", "demo.listener", "Listener.main", None, ()),
    ]
    assert [place(point.location) for point in setup.console_scripts] == [
        (26, 13, 26, 40),
        (27, 13, 27, 51),
    ]
    assert setup.entry_points_complete


def test_missing_comma() -> None:
    text = SETUP.replace("talker:main',", "talker:main'")
    (point,) = view(text).entry_points
    assert point.malformed == "two entries run together"
    assert point.text == "talker = demo.talker:mainlistener=demo.listener:Listener.main"
    assert (point.name, point.module, point.function) == ("", "", "")
    assert [place(at) for at in point.joined] == [(26, 13, 26, 40), (27, 13, 27, 51)]


def test_entry_concatenated_from_two_strings() -> None:
    (point,) = call(
        "entry_points={'console_scripts': ['a = demo.'  # why\n 'b:main']}"
    ).entry_points
    assert (point.name, point.module, point.function) == ("a", "demo.b", "main")
    assert point.malformed is None
    assert [place(at) for at in point.joined] == [(3, 41, 3, 52), (4, 2, 4, 10)]


@pytest.mark.parametrize(
    ("entry", "problem"),
    [
        ("talker", "not of the form name = module:function"),
        ("talker demo.talker:main", "not of the form name = module:function"),
        ("talker = demo.talker", "no function is named: name = module:function"),
        ("talker = demo.talker:", "no function is named: name = module:function"),
        ("talker = demo/talker.py:main", "module or function is not a Python name"),
        ("talker = demo.talker.main()", "no function is named: name = module:function"),
        ("talker = demo.talker:main()", "module or function is not a Python name"),
        ("talker = demo.4-talker:main", "module or function is not a Python name"),
        ("talker = demo.talker:4main", "module or function is not a Python name"),
        ("talker = a:b:c", "two entries run together"),
        ("= demo.talker:main", "not of the form name = module:function"),
    ],
)
def test_malformed_entry_points(entry: str, problem: str) -> None:
    (point,) = call(f"entry_points={{'console_scripts': ['{entry}']}}").entry_points
    assert point.malformed == problem
    assert point.text == entry


def test_other_entry_point_groups_need_no_function() -> None:
    (point,) = call("entry_points={'ros2cli.command': ['a = demo.b [extra]']}").entry_points
    assert (point.group, point.module, point.function) == ("ros2cli.command", "demo.b", "")
    assert point.malformed is None


def test_entry_points_as_text() -> None:
    setup = view(
        "from setuptools import setup\nsetup(entry_points='''\n[console_scripts]\n"
        "# a comment\na = demo.a:main\n\n[other]\nb = demo.b:main\n''')\n"
    )
    assert [(point.group, point.name, place(point.location)) for point in setup.entry_points] == [
        ("console_scripts", "a", (5, 1, 5, 16)),
        ("other", "b", (8, 1, 8, 16)),
    ]


def test_entry_points_as_text_of_a_group() -> None:
    setup = call("entry_points={'console_scripts': 'a = demo.a:main\\nb = demo.b:main'}")
    assert [(point.name, point.module) for point in setup.console_scripts] == [
        ("a", "demo.a"),
        ("b", "demo.b"),
    ]


def test_entry_points_by_name_and_in_tuples() -> None:
    setup = view(
        "from setuptools import setup\npoints = {'console_scripts': [('a = b:c', 'd = e:f'),],}\n"
        "setup(entry_points=points)\n"
    )
    assert [point.name for point in setup.console_scripts] == ["a", "d"]
    assert setup.entry_points_complete


@pytest.mark.parametrize(
    "keywords",
    [
        "entry_points=points()",
        "entry_points={'console_scripts': ['a = b:c', *more]}",
        "entry_points={'console_scripts': ['a = b:c', f(x)]}",
        "entry_points={group(): ['a = b:c']}",
    ],
)
def test_unknown_entry_points(keywords: str) -> None:
    assert not call(keywords).entry_points_complete


def test_parts_of_a_concatenated_string() -> None:
    module = PythonModule.parse(Source("a.py", "x = ('a\\'' r\"b\"  # 'no'\n  '''c\n''')\n"))
    setup = SetupPy(module)
    node = module.tree.body[0]
    value = getattr(node, "value", None)
    assert value is not None
    pieces = [module.source.text[start:end] for start, end in string_pieces(setup.module, value)]
    assert pieces == ["'a\\''", 'r"b"', "'''c\n'''"]


# -- edits


def apply_edits(text: str, edit: Edit | None) -> str:
    assert edit is not None
    assert edit.path == "setup.py"
    return text[: edit.start] + edit.text + text[edit.end :]


def with_script(text: str) -> str:
    return apply_edits(text, add_console_script(view(text), "new", "demo.new:main"))


def with_files(text: str) -> str:
    return apply_edits(text, add_data_files(view(text), "'share/new'", "['new.txt']"))


def test_add_to_a_list_with_one_item_per_line() -> None:
    assert with_script(SETUP) == SETUP.replace(
        "Listener.main',\n", "Listener.main',\n            'new = demo.new:main',\n"
    )
    assert with_files(SETUP) == SETUP.replace(
        "glob('launch/*.launch.py')),\n",
        "glob('launch/*.launch.py')),\n        ('share/new', ['new.txt']),\n",
    )


HEAD = "from setuptools import setup\n"


@pytest.mark.parametrize(
    ("before", "after"),
    [
        pytest.param(
            "setup(entry_points={'console_scripts': ['a = b:c']})\n",
            "setup(entry_points={'console_scripts': ['a = b:c', 'new = demo.new:main']})\n",
            id="one line",
        ),
        pytest.param(
            "setup(entry_points={'console_scripts': ['a = b:c', ]})\n",
            "setup(entry_points={'console_scripts': ['a = b:c', 'new = demo.new:main' ]})\n",
            id="one line with a trailing comma",
        ),
        pytest.param(
            'setup(entry_points={"console_scripts": [\n    "a = b:c"\n]})\n',
            'setup(entry_points={"console_scripts": [\n    "a = b:c",\n'
            '    "new = demo.new:main",\n]})\n',
            id="no trailing comma, double quotes",
        ),
        pytest.param(
            "setup(entry_points={'console_scripts': [\n    'a = b:c'  # why\n]})\n",
            "setup(entry_points={'console_scripts': [\n    'a = b:c',  # why\n"
            "    'new = demo.new:main',\n]})\n",
            id="a comment behind the last",
        ),
        pytest.param(
            "setup(entry_points={'console_scripts': [\n    'a = b:c',\n    # 'x = y:z',\n]})\n",
            "setup(entry_points={'console_scripts': [\n    'a = b:c',\n"
            "    'new = demo.new:main',\n    # 'x = y:z',\n]})\n",
            id="a comment below the last",
        ),
        pytest.param(
            "setup(entry_points={'console_scripts': ['a = b:c',\n"
            "                                        'd = e:f']})\n",
            "setup(entry_points={'console_scripts': ['a = b:c',\n"
            "                                        'd = e:f',\n"
            "                                        'new = demo.new:main']})\n",
            id="aligned",
        ),
        pytest.param(
            "setup(entry_points={'console_scripts': []})\n",
            "setup(entry_points={'console_scripts': [\n    'new = demo.new:main',\n]})\n",
            id="empty list",
        ),
        pytest.param(
            "setup(\n    entry_points={\n        'console_scripts': [\n            # none yet\n"
            "        ],\n    },\n)\n",
            "setup(\n    entry_points={\n        'console_scripts': [\n            # none yet\n"
            "            'new = demo.new:main',\n        ],\n    },\n)\n",
            id="a comment in an empty list",
        ),
        pytest.param(
            "setup(\n    entry_points={\n        'x': [],\n    },\n)\n",
            "setup(\n    entry_points={\n        'x': [],\n        'console_scripts': [\n"
            "            'new = demo.new:main',\n        ],\n    },\n)\n",
            id="no console scripts",
        ),
        pytest.param(
            "setup(\n    name='demo',\n)\n",
            "setup(\n    name='demo',\n    entry_points={\n        'console_scripts': [\n"
            "            'new = demo.new:main',\n        ],\n    },\n)\n",
            id="no entry points",
        ),
        pytest.param(
            "scripts = ['a = b:c'] + more\nsetup(entry_points={'console_scripts': ['d = e:f']})\n",
            "scripts = ['a = b:c'] + more\n"
            "setup(entry_points={'console_scripts': ['d = e:f', 'new = demo.new:main']})\n",
            id="another list",
        ),
        pytest.param(
            "scripts = [\n    'a = b:c',\n]\nsetup(entry_points={'console_scripts': scripts})\n",
            "scripts = [\n    'a = b:c',\n    'new = demo.new:main',\n]\n"
            "setup(entry_points={'console_scripts': scripts})\n",
            id="by name",
        ),
        pytest.param(
            "setup(entry_points={'console_scripts': [('a = '\n    'b:c')\n]})\n",
            "setup(entry_points={'console_scripts': [('a = '\n    'b:c'),\n"
            "    'new = demo.new:main',\n]})\n",
            id="parentheses",
        ),
    ],
)
@pytest.mark.parametrize("newline", ["\n", "\r\n"])
def test_add_console_script(before: str, after: str, newline: str) -> None:
    before, after = ((HEAD + text).replace("\n", newline) for text in (before, after))
    assert with_script(before) == after
    assert add_console_script(view(after), "new", "demo.new:main") is None


def test_long_entry_is_split_into_two_strings() -> None:
    before = view(
        f"{HEAD}setup(\n    entry_points={{\n        'console_scripts': [],\n    }},\n)\n"
    )
    name, target = "n" * 48, f"demo.{'n' * 48}:main"
    edit = add_console_script(before, name, target)
    assert edit is not None
    text = before.module.source.text
    after = view(text[: edit.start] + edit.text + text[edit.end :])
    assert f"\n            '{name} = '\n            '{target}',\n" in after.module.source.text
    assert [(point.name, str(point.module)) for point in after.console_scripts] == [
        (name, target.partition(":")[0])
    ]


def test_long_line_is_wrapped() -> None:
    before = (
        HEAD + "setup(entry_points={'console_scripts': ['a = b:c', 'd = e:f', 'g = hhhhhh:i']})\n"
    )
    assert with_script(before) == before.replace(
        "hhhhhh:i'", "hhhhhh:i',\n" + " " * 40 + "'new = demo.new:main'"
    )


@pytest.mark.parametrize(
    "keywords",
    [
        "entry_points=points()",
        "entry_points={'console_scripts': scripts()}",
        "entry_points={**others}",
        "entry_points='[console_scripts]\\na = b:c'",
        "**options()",
    ],
)
def test_script_is_not_added_where_unsafe(keywords: str) -> None:
    assert add_console_script(call(keywords), "new", "demo.new:main") is None


def test_existing_script_is_not_added_again() -> None:
    assert add_console_script(view(SETUP), "talker", "demo.other:main") is None


def test_add_data_files_without_any() -> None:
    before = HEAD + "setup(\n    name='demo'\n)\n"
    assert with_files(before) == before.replace(
        "name='demo'\n",
        "name='demo',\n    data_files=[\n        ('share/new', ['new.txt']),\n    ],\n",
    )


def test_data_files_are_not_added_where_unsafe() -> None:
    for keywords in ("data_files=files()", "**options()"):
        assert add_data_files(call(keywords), "'a'", "['b']") is None
    assert add_data_files(view("x = 1\n"), "'a'", "['b']") is None


def test_package_expression() -> None:
    assert package_expression(view(SETUP), "demo") == "package_name"
    assert package_expression(view(SETUP), "other") is None


@pytest.mark.parametrize(
    ("before", "statement", "after"),
    [
        (
            "from setuptools import setup\n",
            "import os",
            "import os\n\nfrom setuptools import setup\n",
        ),
        (
            "import os\n\nfrom setuptools import setup\n",
            "from glob import glob",
            "from glob import glob\nimport os\n\nfrom setuptools import setup\n",
        ),
        (
            "from glob import glob\n\nfrom setuptools import setup\n",
            "import os",
            "from glob import glob\nimport os\n\nfrom setuptools import setup\n",
        ),
        ('"""Doc."""\nx = 1\n', "import os", '"""Doc."""\nimport os\n\nx = 1\n'),
    ],
)
def test_add_import(before: str, statement: str, after: str) -> None:
    module = PythonModule.parse(Source("setup.py", before))
    assert apply_edits(before, add_import(module, statement)) == after
    assert add_import(PythonModule.parse(Source("setup.py", after)), statement) is None


# -- anything


ENTRIES = st.lists(
    st.sampled_from(
        ["'a = b:c'", '"d = e:f"', "'x'  # why\n", "f'{package_name}'", "('g = '\n'h:i')", "*more"]
    ),
    max_size=4,
)
CLOSINGS = st.sampled_from(["]", ",]", "\n    ]", ",\n    ]", ",  # end\n    ]", " ]"])


@given(
    entries=ENTRIES,
    glue=st.sampled_from([", ", ",\n        ", "  ,\n"]),
    closing=CLOSINGS,
    newline=st.sampled_from(["\n", "\r\n"]),
)
def test_added_script_is_the_only_change(
    entries: list[str], glue: str, closing: str, newline: str
) -> None:
    scripts = glue.join(entry.replace("# why\n", "") for entry in entries)
    if not entries:
        closing = closing.replace(",", "")
    points = f"{{'console_scripts': [{scripts}{closing}}}"
    text = f"{HEAD}package_name = 'demo'\nsetup(entry_points={points})\n".replace("\n", newline)
    before = view(text)
    edit = add_console_script(before, "new", "demo.new:main")
    if edit is None:
        assert not before.entry_points_complete
        return
    after = view(apply_edits(text, edit))
    *kept, added = [point.text for point in after.entry_points]
    assert kept == [point.text for point in before.entry_points]
    assert added in {"new = demo.new:main", "new=demo.new:main"}
    assert ("\r" in after.module.source.text) == (newline == "\r\n")


KEYWORDS = st.lists(
    st.sampled_from(
        [
            "name=x",
            "version='1'",
            "packages=[y]",
            "packages=find_packages(*z)",
            "**d",
            "*a",
            "data_files=[('a', b), c, 'd']",
            "data_files=[(x for x in y)]",
            "data_files=1",
            "'p'",
            "entry_points={'a': b, **c, 1: ['d']}",
            "entry_points='[a'",
            "entry_points=[['a=b']]",
            "entry_points={'console_scripts': 'a = b'}",
            "entry_points={'console_scripts': [1]}",
        ]
    ),
    max_size=5,
    unique_by=lambda word: word.partition("=")[0],
)


@given(KEYWORDS)
def test_any_call_of_setup_never_raises(keywords: list[str]) -> None:
    text = f"from setuptools import setup, find_packages\nsetup({', '.join(keywords)})\n"
    try:
        setup = view(text)
    except (ParseError, NewerSyntaxError):
        return
    assert setup.packages != []
    assert all(point.location.line == 2 for point in setup.entry_points)
    assert all(entry.location.line == 2 for entry in setup.data_files)
    for edit in (
        add_console_script(setup, "new", "demo.new:main"),
        add_data_files(setup, "'a'", "['b']"),
    ):
        if edit is not None:
            assert view(apply_edits(text, edit)).call is not None
