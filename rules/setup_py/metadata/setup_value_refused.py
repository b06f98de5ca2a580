"""SP062: setuptools accepts the values in setup.py, setup.cfg and pyproject.toml."""

from __future__ import annotations

import re
from collections.abc import Iterator

from scaffold.api import Diagnostic, Effect, Example, Package, Rule, ViewError
from scaffold.api.distributions import target
from scaffold.api.formats import toml
from scaffold.api.setup_py import is_requirement, is_specifier, is_version, requirements

_STRICT = 66
"""The first version of setuptools that only accepts versions as PEP 440 defines them."""
_ATTRIBUTE = re.compile(r"attr:\s*([\w.]+)\.(\w+)\s*")
_LINE = re.compile(r"line (\d+)")
_TABLE = re.compile(r"^\[project\]", re.MULTILINE)
_KEYS = ("name", "version")
_SETUP = "from setuptools import setup\n\nsetup(\n    name='talker',\n    {},\n)\n"
_CFG = "[metadata]\nname = talker\nversion = attr: talker.__version__\n"
_PROJECT = "[build-system]\nrequires = ['setuptools']\n\n[project]\n{}description = 'Talks.'\n"


class SetupValueRefused(Rule):
    """A value in setup.py, setup.cfg or pyproject.toml stops setuptools.

    **Why.** colcon runs setup.py, and setuptools stops: ``'python_requires' must be a string
    containing valid version specifiers``, ``use_2to3 is invalid``, ``InvalidVersion``, ``module
    'talker' has no attribute '__version__'``, ``` `project` must contain ['name'] properties```.

    **Fix.** Write versions as in PEP 440, requirements as in PEP 508, and define the attribute;
    delete ``use_2to3``. Without a name and a version, ``[project]`` is better left out.

    **Source.** setuptools documentation, "Keywords", "Configuring setuptools using pyproject.toml
    files", "Declarative configuration"; ``setuptools/dist.py``.
    """

    code = "SP062"
    name = "setup-value-refused"
    effect = Effect.STOPS_BUILD
    examples = (
        Example(
            "valid values",
            {
                "setup.py": _SETUP.format(
                    "version='1.0.0rc1',\n    python_requires='>=3.10, <4',\n"
                    "    install_requires=[\n        'numpy[all]>=1.2,!=1.3; os_name == \"nt\"',\n"
                    "        'talk @ https://example.com/talk.zip']"
                )
            },
        ),
        Example(
            "invalid values",
            {
                "setup.py": _SETUP.format(
                    "version='1.0-jazzy_2',\n    python_requires='3.10 or newer',\n"
                    "    install_requires=['setuptools', 'pyserial=3.5'],\n"
                    "    extras_require={'test': ['git+https://example.com/talk.git']},\n"
                    "    use_2to3=True"
                )
            },
            "5:13: '1.0-jazzy_2' is not a version of PEP 440: the build stops",
            "6:21: python_requires '3.10 or newer' is not a version specifier, such as '>=3.10': "
            "the build stops",
            "7:22: 'pyserial=3.5' in install_requires is not a requirement, such as "
            "'numpy>=1.26': the build stops",
            "8:20: 'git+https://example.com/talk.git' in extras_require is not a requirement, "
            "such as 'numpy>=1.26': the build stops",
            "9:14: setuptools 58 and later reject use_2to3: the build stops; delete it",
        ),
        Example(
            "a version that an old version of setuptools accepts",
            {"setup.py": _SETUP.format("version='1.0-jazzy_2'")},
            distro="humble",
        ),
        Example(
            "an attribute",
            {
                "setup.py": "from setuptools import setup\n\nsetup()\n",
                "setup.cfg": _CFG,
                "talker/__init__.py": "__version__ = '1.0.0'\n",
            },
        ),
        Example(
            "an attribute that does not exist",
            {
                "setup.py": "from setuptools import setup\n\nsetup()\n",
                "setup.cfg": _CFG,
                "talker/__init__.py": "",
            },
            "setup.cfg:3:11: talker/__init__.py does not define __version__: setuptools finds no "
            "version and the build stops",
        ),
        Example(
            "a project",
            {
                "setup.py": _SETUP.format("packages=['talker']"),
                "pyproject.toml": _PROJECT.format("name = 'talker'\ndynamic = ['version']\n"),
            },
        ),
        Example(
            "a project without a name",
            {
                "setup.py": _SETUP.format("packages=['talker']"),
                "pyproject.toml": _PROJECT.format("version = '1.0.0'\n"),
            },
            "pyproject.toml:4:1: [project] has no name: setuptools stops the build",
        ),
        Example(
            "an attribute of a module that does not exist",
            {
                "setup.py": "from setuptools import setup\n\nsetup()\n",
                "setup.cfg": _CFG.replace("talker.__", "talker.about.__"),
            },
            "setup.cfg:3:11: no module talker.about: setuptools finds no version and the build "
            "stops",
        ),
        Example(
            "a pyproject.toml that is not valid TOML",
            {"setup.py": "", "pyproject.toml": "[tool.ruff]\nselect = ['E'\n[tool.black]\n"},
            "pyproject.toml:3:1: invalid TOML (Unclosed array): setuptools stops the build",
        ),
    )

    def check(self, package: Package) -> Iterator[Diagnostic]:
        if not package.has("setup.py"):
            return
        yield from self._check_keywords(package)
        if package.has("setup.cfg"):
            yield from self._check_attribute(package)
        if package.has("pyproject.toml"):
            yield from self._check_project(package)

    def _check_keywords(self, package: Package) -> Iterator[Diagnostic]:
        setup = package.setup_py
        is_strict = int(target().fact("setuptools").partition(".")[0]) >= _STRICT
        for word in setup.keywords.values():
            value = word.value
            if word.name == "use_2to3" and value is True:
                message = "setuptools 58 and later reject use_2to3: the build stops; delete it"
                yield self.report(word, message)
            elif word.name == "version" and isinstance(value, str) and is_strict:
                if not is_version(value):
                    message = f"{value!r} is not a version of PEP 440: the build stops"
                    yield self.report(word, message)
            elif word.name == "python_requires" and isinstance(value, str):
                if not is_specifier(value):
                    message = (
                        f"python_requires {value!r} is not a version specifier, such as '>=3.10': "
                        f"the build stops"
                    )
                    yield self.report(word, message)
            elif word.name in {"install_requires", "setup_requires", "extras_require"}:
                for item in requirements(value):
                    if not is_requirement(item):
                        message = (
                            f"{item!r} in {word.name} is not a requirement, such as "
                            f"'numpy>=1.26': the build stops"
                        )
                        yield self.report(word, message)

    def _check_attribute(self, package: Package) -> Iterator[Diagnostic]:
        """Check that the attribute with the version exists."""
        option = package.setup_cfg.option("metadata", "version")
        match = _ATTRIBUTE.fullmatch(option.value) if option is not None else None
        if option is None or match is None or "package_dir" in package.source("setup.cfg").text:
            return
        base = match[1].replace(".", "/")
        paths = [path for path in (f"{base}/__init__.py", f"{base}.py") if package.has(path)]
        try:
            is_defined = package.module(paths[0]).defines(match[2]) if paths else False
        except ViewError:
            return
        if is_defined is False and not package.has(f"{base}/{match[2]}.py"):
            where = f"{paths[0]} does not define {match[2]}" if paths else f"no module {match[1]}"
            yield self.report(option, f"{where}: setuptools finds no version and the build stops")

    def _check_project(self, package: Package) -> Iterator[Diagnostic]:
        """Check that pyproject.toml is valid TOML and gives the project a name and a version."""
        source = package.source("pyproject.toml")
        table = _TABLE.search(source.text)
        try:
            project = toml.loads(source.text).get("project")
        except toml.TOMLDecodeError as error:
            reason, line = str(error).partition(" (at")[0], _LINE.search(str(error))
            at = source.line_location(min(int(line[1]), len(source.lines)) if line else 1)
            yield self.report(at, f"invalid TOML ({reason}): setuptools stops the build")
            return
        except (ValueError, RecursionError):
            return
        if table is None or not isinstance(project, dict):
            return
        for key in _KEYS:
            if key not in project and key not in project.get("dynamic", ()):
                at = source.location(*table.span())
                yield self.report(at, f"[project] has no {key}: setuptools stops the build")
