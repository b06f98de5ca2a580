"""Evaluation of setup.py next to its files: data_files are those that setuptools gets."""

from __future__ import annotations

import os
import sys
import types
from pathlib import Path

import pytest

from scaffold.model.package import Package
from scaffold.model.python.evaluation.values import Glob
from scaffold.model.setup_py.globs import matches

FILES = (
    *("launch/a.launch.py", "launch/b.launch.py", "config/a.yaml", "config/arm/b.yaml"),
    *("models/box/mesh.stl", "models/box/tmp/old.stl", "models/README.md", "resource/demo"),
)
HEAD = """\
from glob import glob
from itertools import chain
import os
from pathlib import Path

from setuptools import setup

package_name = 'demo'
"""
SHARE = "os.path.join('share', package_name, {})"

SETUPS = (
    # a function that walks, with an entry for each file
    f"""
def tree(top, destination):
    found = []
    for root, _, files in os.walk(top):
        for file in files:
            where = os.path.join(destination, os.path.relpath(root, top))
            found.append((where, [os.path.join(root, file)]))
    return found

setup(data_files=[('share/demo', ['package.xml']), *tree('./models', {SHARE.format("'models'")})])
""",
    # a function that changes the list it is given
    f"""
data_files = [('share/demo', ['package.xml'])]

def package_files(data_files, directories):
    paths = {{}}
    for directory in directories:
        for (path, names, files) in os.walk(directory):
            for file in files:
                where = {SHARE.format("path")}
                if where in paths.keys():
                    paths[where].append(os.path.join(path, file))
                else:
                    paths[where] = [os.path.join(path, file)]
    for key in paths.keys():
        data_files.append((key, paths[key]))
    return data_files

setup(data_files=package_files(data_files, ['models/', 'config/', 'absent/']))
""",
    # a change without a result, below conditions
    f"""
data_files = [('share/demo', ['package.xml'])]

def add(data_files, top):
    for directory, _, names in os.walk(top):
        if names:
            relative = os.path.relpath(directory, top)
            target = {SHARE.format("top")} if relative == '.' else os.path.join('share', relative)
            data_files.append((target, [os.path.join(directory, name) for name in names]))

if os.path.isdir('models'):
    add(data_files, 'models')
if os.path.exists('worlds'):
    add(data_files, 'worlds')
setup(data_files=data_files)
""",
    # directories that are left out while walking
    """
entries = []
for root, dirs, files in os.walk('models', topdown=True):
    dirs[:] = [name for name in dirs if name != 'tmp']
    entries += [(f'share/demo/{root}', [f'{root}/{name}' for name in files])]
setup(data_files=entries)
""",
    # pathlib, comprehensions
    """
def files(directory):
    return [str(path) for path in sorted(Path(directory).iterdir()) if path.is_file()]

setup(data_files=[
    *[(str(Path('share') / package_name / path.parent), [path.as_posix()])
      for path in Path('config').rglob('*.yaml')],
    ('share/demo/launch', files('launch')),
    *((f'share/demo/{d}', [f'{d}/{f}' for f in os.listdir(d) if os.path.isfile(os.path.join(d, f))])
      for d in ('launch', 'config')),
])
""",
    # globs
    """
paths = [f for f in glob('models/**', recursive=True) if os.path.isfile(f)]
setup(data_files=[(os.path.join('share', package_name, os.path.dirname(f)), [f]) for f in paths]
      + list(chain(*[[('share/demo/launch', glob(p))] for p in ('launch/a*', 'launch/b*')])))
""",
    # directories found with glob
    """
found = []
for directory in glob('models/') + glob('models/*/'):
    found.append((os.path.join('share', package_name, directory), glob(f'{directory}/*.*')))
setup(data_files=found)
""",
    # a generator, in a function around the call
    """
def entries():
    for name in ('launch', 'config'):
        yield f'share/{package_name}/{name}', glob(name + '/*.*')


def main():
    data_files = [('share/demo', ['package.xml'])]
    data_files.extend(entries())
    setup(data_files=data_files)


if __name__ == '__main__':
    main()
""",
    # what is read, or fails, does not matter
    """
import os
import sys

with open('package.xml') as stream:
    text = stream.read()
try:
    from wheel.bdist_wheel import bdist_wheel
except ImportError:
    bdist_wheel = None
data_files = []
for name in ['launch', 'config']:
    print(len(data_files))
    data_files.append(('share/demo/' + name, glob(f'{name}/*.*')))
setup(data_files=data_files, cmdclass={'bdist_wheel': bdist_wheel})
""",
)


@pytest.mark.parametrize("text", SETUPS)
def test_data_files_are_those_of_python(
    text: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    text = HEAD + text
    files = dict.fromkeys(FILES, "") | {"package.xml": "<package/>\n", "setup.py": text}
    for name, content in files.items():
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text(content)
    given: dict[str, list[tuple[str, list[str]]]] = {}
    setuptools = types.SimpleNamespace(setup=given.update)
    monkeypatch.setitem(sys.modules, "setuptools", setuptools)
    monkeypatch.chdir(tmp_path)
    exec(text, {"__name__": "__main__"})  # noqa: S102  the texts above
    setup = Package.of(files).setup_py
    assert setup.data_files_complete
    assert normal(given["data_files"]) == normal(
        [
            (
                str(data.destination),
                [
                    path
                    for source in data.sources
                    for path in (
                        matches(source, files) if isinstance(source, Glob) else [str(source)]
                    )
                ],
            )
            for data in setup.data_files
        ]
    )


def normal(entries: list[tuple[str, list[str]]]) -> list[tuple[str, list[str]]]:
    """Return entries in an order of their own."""
    return sorted((where, sorted(map(os.path.normpath, sources))) for where, sources in entries)
