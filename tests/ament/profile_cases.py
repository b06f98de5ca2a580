"""Code with different findings on different distributions, with the codes of each.

`tests/nightly/test_style_profiles.py` compares the table with the linters themselves.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

H, J, K, L = "humble", "jazzy", "kilted", "lyrical"


class Case(NamedTuple):
    """A file, and the distributions whose linters report a code in it."""

    code: str
    text: str
    reported_for: Sequence[str]
    path: str = "module.py"


CASES = (
    Case("A001", "BaseExceptionGroup = 1\n", (J, K, L)),
    Case("A001", "PythonFinalizationError = 1\n", (L,)),
    Case("A001", "import os as id\n", (H, J, K)),
    Case("A004", "import os as id\n", (L,)),
    Case("A004", "from math import pow\n", (L,)),
    Case("A005", "X = 1\n", (L,), "logging.py"),
    Case("A005", "X = 1\n", (L,), "queue/__init__.py"),
    Case("A005", "X = 1\n", (), "setup.py"),
    Case("A005", "X = 1\n", (), "__main__.py"),
    Case("A006", "f(lambda id: 1)\n", (L,)),
    Case("B901", "try:\n    f()\nexcept:\n    pass\n", (H, K, L)),
    Case("B901", "try:\n    f()\nexcept:  # noqa: E722\n    pass\n", ()),
    Case("C406", "dict([[1, 2]])\n", (H,)),
    Case("C416", "{x: y for x, y in z}\n", (J, K, L)),
    Case("C417", "map(lambda x: x + 1, y)\n", (J, K, L)),
    Case("C418", "dict({})\n", (J, K, L)),
    Case("C419", "any([f(x) for x in y])\n", (J, K, L)),
    Case("C420", "{x: None for x in y}\n", (L,)),
    Case("C420", "{x: [] for x in y}\n", ()),
    Case("CNL100", "class A:\n    def f(self):\n        pass\n", (H, K, L)),
    Case("CNL100", "class A:\n\n    def f(self):\n        pass\n", ()),
    Case("CNL100", 'class A:\n    """Do."""\n\n    def f(self):\n        pass\n', ()),
    Case("D001", "self.assertEquals(1, 2)\n", (H, K, L)),
    Case("D001", "assertEquals(1, 2)\n", (K, L)),
    Case(
        "D401", 'class A:\n\n    @property\n    def f(self):\n        """Sets."""\n', (H, J, K, L)
    ),
    Case("D419", 'def f():\n    """"""\n', (J, K, L)),
    Case("E201", "print(f'{ x}')\n", (J, K, L)),
    Case("E204", "@ property\ndef f():\n    pass\n", (L,)),
    Case("E231", "x = [1,]\n", (H,)),
    Case("E231", "print(f'{a,b}')\n", (J, K, L)),
    Case("E275", "if(a):\n    pass\n", (J, K, L)),
    Case("E275", "from a import(b)\n", (H, J, K, L)),
    Case("E502", "x = [1,  # a\n     2, \\\n     3]\n", (L,)),
    Case("E721", "if type(a) == int:\n    pass\n", (J, K, L)),
    Case("E721", "if a == type(1):\n    pass\n", (H, J, K, L)),
    Case("E721", "if a is type(1):\n    pass\n", (H,)),
    Case("E721", "if x.type(a) == 1:\n    pass\n", (J, K)),
    Case("E741", "f(lambda l: 1)\n", (J, K, L)),
    Case("E741", "def f(a=l):\n    pass\n", (H,)),
    Case("F811", "a = 1\n\n\ndef a():\n    pass\n", (J, K, L)),
    Case(
        "F811",
        "match 1:\n    case 1:\n        import a\n    case 2:\n        import a\na\n",
        (H,),
    ),
    Case("F821", "def f(a: 'Foo'):\n    pass\n", (H, J, K, L)),
    Case("F824", "def f():\n    global x\n    print(x)\n", (L,)),
    Case("F824", "def f():\n    global x\n    x = 1\n", ()),
    Case("F842", "def f():\n    x: int\n", (J, K, L)),
    Case("I201", "import os\nimport tomllib\n", (H, J, K)),
    Case("I300", "import os\nif TYPE_CHECKING:\n    import yaml\n", (L,)),
    Case("I300", "import os\n\nif TYPE_CHECKING:\n    import yaml\n", ()),
    Case("I100", "import os\n\nif TYPE_CHECKING:\n    import yaml\n\n    import abc\n", (L,)),
)
"""One code of each text; the others in it are compared every night."""

BY_FILE: Mapping[str, str] = {
    f"case_{at:02}/{case.path}": case.text for at, case in enumerate(CASES)
}
"""All files, each in a directory of its own."""
