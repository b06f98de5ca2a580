"""Write names, interfaces and stubs of a distribution below scaffold/data/NAME.

Usage:

    python -m scripts.bundle_distribution NAME SOURCES

``SOURCES/jazzy`` and ``SOURCES/NAME`` have released packages, one directory each: the output of
``git archive release/NAME/PACKAGE`` in the release repositories (``ros2-gbp/*-release``).
The data of Jazzy is made from installed packages and was completed by hand (bundle_names.py,
make_stubs.py), so others are written as Jazzy's with what differs between the two sources. Stubs
that are the same are not stored again; those that a distribution does not have any more are in
``removed_stubs.txt``. ``profile.toml`` and ``standard_library.txt`` are those of the distribution
before until somebody reviews them.
"""

from __future__ import annotations

import ast
import os
import re
import sys
import tempfile
from collections.abc import Collection, Iterator, Mapping, Sequence
from pathlib import Path

from scaffold.distributions import ORDER
from scaffold.model.interfaces.definitions import Definitions
from scaffold.model.interfaces.sources import PrefixSource
from scripts.bundle_interfaces import HEAD, PACKAGES, bundled
from scripts.make_stubs import formatted, stub

DATA = Path(__file__).parent.parent / "scaffold" / "data"
BASE = "jazzy"
"""The distribution whose data is complete."""
PYTHON = {
    "ament_index_python": "ament_index_python",
    "launch": "launch",
    "launch_ros": "launch_ros",
    "launch_testing": "launch_testing",
    "launch_testing_ros": "launch_testing_ros",
    "launch_xml": "launch_xml",
    "launch_yaml": "launch_yaml",
    "rclpy": "rclpy",
    "sensor_msgs_py": "sensor_msgs_py",
    "tf2_ros_py": "tf2_ros",
}
"""Python packages whose stubs are compared, by the package that holds them."""
NAMED = ("rclpy", "ament_index_python")
_OWN_ENTER = re.compile(
    r"(?m)^(    def __enter__\(self\)) -> (?!None\b|Any\b|Self\b)[\w\[\], ]+: \.\.\.$"
)
"""The return type of ``__enter__`` in classes without a better one."""
Function = ast.FunctionDef | ast.AsyncFunctionDef
Definition = Function | ast.ClassDef | ast.Assign | ast.AnnAssign
Group = list[Definition]


# -- sources


def modules(sources: Path, package: str) -> dict[str, str]:
    """Return the public modules of a package, by the path of their stub."""
    top = sources / package
    files: dict[str, str] = {}
    for path in sorted((top / PYTHON[package]).rglob("*.py")):
        relative = path.relative_to(top).with_suffix(".pyi")
        parts = [part.removesuffix(".pyi") for part in relative.parts]
        if not any(part.startswith("_") and part != "__init__" for part in parts):
            files[relative.as_posix()] = path.read_text()
    return files


def module_name(path: str) -> str:
    """Return the name of a module by the path of its stub."""
    return path.removesuffix(".pyi").removesuffix("/__init__").replace("/", ".")


# -- names


def names(files: Mapping[str, str]) -> dict[str, set[str]]:
    """Return the names in modules and classes by full name; methods end in ``()``."""
    trees = {module_name(path): ast.parse(text) for path, text in files.items()}
    places: dict[str, tuple[str, ast.ClassDef]] = {}
    result: dict[str, set[str]] = {}
    for module, tree in trees.items():
        below = {name.rpartition(".")[2] for name in trees if name.rpartition(".")[0] == module}
        result[module] = {name for node in _flat(tree.body) for name in _bound_names(node)} | below
        for node in _flat(tree.body):
            if isinstance(node, ast.ClassDef) and not node.name.startswith("_"):
                places[f"{module}.{node.name}"] = (module, node)
    for full, (module, node) in places.items():
        result[full] = _class_names(node, module, places, trees, ())
    return result


def _flat(body: Sequence[ast.stmt]) -> Iterator[ast.stmt]:
    """Yield the statements of a module, including those below conditions."""
    for node in body:
        if isinstance(node, ast.If | ast.Try):
            yield from _flat(node.body)
            yield from _flat(node.orelse)
        else:
            yield node


def _bound_names(node: ast.stmt) -> Iterator[str]:
    match node:
        case ast.Import(names=aliases) | ast.ImportFrom(names=aliases):
            yield from (alias.asname or alias.name.partition(".")[0] for alias in aliases)
        case ast.FunctionDef(name=name) | ast.AsyncFunctionDef(name=name) | ast.ClassDef(name=name):
            yield name
        case ast.Assign(targets=targets):
            yield from (target.id for target in targets if isinstance(target, ast.Name))
        case ast.AnnAssign(target=ast.Name(id=name)):
            yield name


def _class_names(
    node: ast.ClassDef,
    module: str,
    places: Mapping[str, tuple[str, ast.ClassDef]],
    trees: Mapping[str, ast.Module],
    above: tuple[str, ...],
) -> set[str]:
    result: set[str] = set()
    for base in node.bases:
        full = _resolved(base, module, trees)
        if full in places and full not in above:
            result |= _class_names(places[full][1], places[full][0], places, trees, (*above, full))
    for item in node.body:
        for name in _bound_names(item):
            is_method = isinstance(item, Function) and not item.decorator_list
            is_method |= isinstance(item, Function) and "deprecated" in ast.unparse(
                ast.Tuple(item.decorator_list)
            )
            result.discard(name if is_method else f"{name}()")
            result.add(f"{name}()" if is_method else name)
        for inner in ast.walk(item):
            match inner:
                case ast.Attribute(attr=name, ctx=ast.Store(), value=ast.Name(id="self")):
                    result |= {name} if f"{name}()" not in result else set()
    return {name for name in result if not name.startswith("__")}


def _resolved(base: ast.expr, module: str, trees: Mapping[str, ast.Module]) -> str:
    name = ast.unparse(base.value if isinstance(base, ast.Subscript) else base)
    for node in _flat(trees[module].body):
        if isinstance(node, ast.ImportFrom):
            for alias in node.names:
                if (alias.asname or alias.name) == name:
                    return f"{node.module}.{alias.name}"
    return f"{module}.{name}"


def compared_names(old: Mapping[str, str], new: Mapping[str, str]) -> str:
    """Return the table of names: that of the base with what differs between the sources."""
    before, after = names(old), names(new)
    table: dict[str, set[str]] = {}
    for line in (DATA / BASE / "names.txt").read_text().splitlines():
        owner, _, rest = line.partition(": ")
        table[owner] = set(rest.split())
    order = [*table, *sorted(after.keys() - table.keys())]
    lines = []
    for owner in order:
        if owner in after:
            gone = before.get(owner, set()) - after[owner]
            known = (table.get(owner, set()) - gone) | (after[owner] - before.get(owner, set()))
            lines.append(f"{owner}: {' '.join(sorted(known))}\n")
        elif owner not in before:
            lines.append(f"{owner}: {' '.join(sorted(table[owner]))}\n")
    return "".join(lines)


# -- stubs


def compared_stub(known: str, old: str, new: str, still: Mapping[str, set[str]]) -> str:
    """Return a stub for a new source: the known one, with what differs from the old source.

    Args:
        known: The stub for the old source.
        old: The stub of the old source, without manual additions.
        new: Likewise of the new source.
        still: The names in the classes of the module, including inherited ones.
    """
    body = ast.parse(known).body
    imports = [node for node in body if isinstance(node, ast.Import | ast.ImportFrom)]
    before, after = ast.parse(old).body, ast.parse(new).body
    merged = _merged(_groups(body), _groups(before), _groups(after), still)
    if merged == _groups(body) and _exports(before) == _exports(after):
        return known
    added = [node for node in after if isinstance(node, ast.Import | ast.ImportFrom)]
    gone = _exports(before) - _exports(after)
    kept = [_without_names(node, gone) for node in imports]
    lines = [node for group in merged.values() for node in group]
    everything = [*(node for node in kept if node.names), *added, *lines]
    return ast.unparse(
        ast.fix_missing_locations(ast.Module(_without_unused_imports(everything), []))
    )


def with_modules(text: str, path: str, old: Collection[str], new: Collection[str]) -> str:
    """Return the stub of a package that imports its modules, with those of the new source."""
    package = module_name(path)
    tree = ast.parse(text)
    own = [
        node for node in tree.body if isinstance(node, ast.ImportFrom) and node.module == package
    ]
    gone, added = (
        {*map(module_name, names)} - {*map(module_name, others)}
        for names, others in ((old, new), (new, old))
    )
    start = f"{package}."
    for node in own[:1]:
        aliases = [alias for alias in node.names if start + alias.name not in gone]
        names = sorted(
            name.removeprefix(start)
            for name in added
            if name.startswith(start) and "." not in name.removeprefix(start)
        )
        aliases += [ast.alias(name, name) for name in names]
        if len(aliases) != len(node.names) or names:
            node.names = aliases
            return ast.unparse(tree)
    return text


def _exports(body: Sequence[ast.stmt]) -> set[str]:
    return {
        alias.asname
        for node in body
        if isinstance(node, ast.Import | ast.ImportFrom)
        for alias in node.names
        if alias.asname
    }


def _without_names(
    node: ast.Import | ast.ImportFrom, names: set[str]
) -> ast.Import | ast.ImportFrom:
    node.names = [alias for alias in node.names if alias.asname not in names]
    return node


def _without_unused_imports(body: Sequence[ast.stmt]) -> list[ast.stmt]:
    """Return a stub without imports that are repeated or not needed."""
    needed = {
        item.id
        for node in body
        if not isinstance(node, ast.Import | ast.ImportFrom)
        for item in ast.walk(node)
        if isinstance(item, ast.Name)
    }
    known: set[str] = set()
    result: list[ast.stmt] = []
    for node in body:
        if isinstance(node, ast.Import | ast.ImportFrom):
            wanted = []
            for alias in node.names:
                name = alias.asname or alias.name.partition(".")[0]
                if name not in known and (alias.asname or name in needed or alias.name == "*"):
                    wanted.append(alias)
                    known.add(name)
            if wanted:
                node.names = wanted
                result.append(node)
        else:
            result.append(node)
    if "Any" in needed - known:
        result.insert(0, ast.ImportFrom("typing", [ast.alias("Any")], 0))
    return result


def _groups(body: Sequence[ast.stmt]) -> dict[str, Group]:
    """Return the definitions by name; a property and an overloaded function have several."""
    result: dict[str, Group] = {}
    for node in body:
        if isinstance(node, Definition):
            result.setdefault(next(_bound_names(node), ""), []).append(node)
    return result


def _merged(
    known: dict[str, Group],
    old: dict[str, Group],
    new: dict[str, Group],
    still: Mapping[str, set[str]],
    inherited: Collection[str] = (),
) -> dict[str, Group]:
    result: dict[str, Group] = {}
    for name, group in known.items():
        if name in old and name not in new and name not in inherited:
            continue
        result[name] = _merged_group(group, old.get(name), new.get(name), still)
    for name, group in new.items():
        if name not in result and name not in old:
            result[name] = group
    return result


def _merged_group(
    known: Group, old: Group | None, new: Group | None, still: Mapping[str, set[str]]
) -> Group:
    if old is None or new is None:
        return known
    match known[-1], old[-1], new[-1]:
        case ast.ClassDef() as class_, ast.ClassDef() as first, ast.ClassDef() as second:
            return [_merged_class(class_, first, second, still)]
    before, after = old[-1], new[-1]
    if not isinstance(before, Function) or not isinstance(after, Function):
        return known if type(before) is type(after) else new
    if _call_interface(before) == _call_interface(after):
        return known
    function = known[0]
    if len(known) == 1 and isinstance(function, Function):
        return [_with_annotations(after, function)]
    return new


def _merged_class(
    known: ast.ClassDef, old: ast.ClassDef, new: ast.ClassDef, still: Mapping[str, set[str]]
) -> ast.ClassDef:
    inherited = still.get(known.name, ())
    merged = _merged(_groups(known.body), _groups(old.body), _groups(new.body), still, inherited)
    gone = set(_bases(old)) - set(_bases(new))
    added = [name for name in _bases(new) if name not in _bases(old)]
    if merged == _groups(known.body) and not gone and not added:
        return known
    bases: list[ast.expr] = [ast.Name(name) for name in added]
    bases += [base for base in known.bases if _unquoted(base) not in gone]
    body: list[ast.stmt] = [node for group in merged.values() for node in group]
    empty: list[ast.stmt] = [ast.Expr(ast.Constant(...))]
    return ast.ClassDef(known.name, bases, known.keywords, body or empty, [])


def _unquoted(base: ast.expr) -> str:
    return ast.unparse(base.value if isinstance(base, ast.Subscript) else base)


def _bases(node: ast.ClassDef) -> list[str]:
    return [name for name in map(_unquoted, node.bases) if name not in {"Generic", "object"}]


def _call_interface(node: Function) -> object:
    """Return the call interface of a function: arguments, their order, which are optional."""
    arguments = node.args
    return (
        type(node),
        [item.arg for item in [*arguments.posonlyargs, *arguments.args]],
        len(arguments.defaults),
        [item.arg for item in arguments.kwonlyargs],
        [value is None for value in arguments.kw_defaults],
        bool(arguments.vararg),
        bool(arguments.kwarg),
        _gives_nothing(node),
        sorted(map(ast.unparse, node.decorator_list)),
    )


def _gives_nothing(node: Function) -> bool:
    return isinstance(node.returns, ast.Constant) and node.returns.value is None


def _with_annotations(new: Function, known: Function) -> Function:
    """Return a new signature with the types of the known one, where both have a parameter."""
    types = {item.arg: item.annotation for item in _all_arguments(known)}
    for item in _all_arguments(new):
        item.annotation = types.get(item.arg) or item.annotation
    if _gives_nothing(new) == _gives_nothing(known):
        new.returns = known.returns
    return new


def _all_arguments(node: Function) -> list[ast.arg]:
    extra = [item for item in (node.args.vararg, node.args.kwarg) if item is not None]
    return [*node.args.posonlyargs, *node.args.args, *node.args.kwonlyargs, *extra]


def stubs(sources: Path, name: str) -> tuple[dict[str, str], list[str]]:
    """Return the stubs that differ from those of the base, and the removed ones, by path."""
    changed: dict[str, str] = {}
    gone: list[str] = []
    everything = {
        path: text for package in PYTHON for path, text in modules(sources / name, package).items()
    }
    known_names = names(everything)
    for package in PYTHON:
        old, new = modules(sources / BASE, package), modules(sources / name, package)
        gone += sorted(old.keys() - new.keys())
        for path, text in new.items():
            after = stub(text, "")
            file = DATA / BASE / "stubs" / path
            if path not in old:
                changed[path] = after
            elif file.is_file():
                known = file.read_text()
                known = with_modules(known, path, old, new)
                result = compared_stub(
                    known, stub(old[path], ""), after, _members_of_classes(known_names, path)
                )
                if result != file.read_text():
                    changed[path] = result
    same = formatted(changed)
    kept = [path for path in gone if (DATA / BASE / "stubs" / path).is_file()]
    return same, kept


def of_subclasses(text: str) -> str:
    """Let ``__enter__`` of subclasses return an object of the subclass."""
    text, count = _OWN_ENTER.subn(r"\1 -> Self: ...", text)
    if not count or re.search(r"import .*\bSelf\b", text):
        return text
    return re.sub(r"(?m)^(?=from |import )", "from typing_extensions import Self\n", text, count=1)


def _members_of_classes(table: Mapping[str, set[str]], path: str) -> dict[str, set[str]]:
    """Return the names of the classes of a module, by the name of the class."""
    start = f"{module_name(path)}."
    return {
        owner.removeprefix(start): {name.removesuffix("()") for name in names}
        for owner, names in table.items()
        if owner.startswith(start)
    }


# -- interfaces


def interfaces(sources: Path, name: str) -> str:
    """Return the common interfaces; packages released elsewhere are those of the base."""
    known = _bundled_packages()
    with tempfile.TemporaryDirectory() as prefix:
        os.symlink(sources.resolve() / name, os.path.join(prefix, "share"))
        definitions = Definitions([PrefixSource([prefix])])
        text = HEAD.replace("Jazzy", name.capitalize()).replace("installed", "released")
        for package in PACKAGES:
            if (sources / name / package).is_dir():
                text += bundled(definitions, prefix, package)
            elif not (sources / BASE / package).is_dir():
                text += known.get(package, "")
    return text.rstrip("\n") + "\n"


def _bundled_packages() -> dict[str, str]:
    """Return the interfaces of the base by package."""
    chunks = (DATA / BASE / "interfaces.txt").read_text().split("\n@ ")[1:]
    return {chunk.partition(" ")[0]: f"@ {chunk.rstrip()}\n" for chunk in chunks}


def main() -> int:
    """Write the data of a distribution."""
    if len(sys.argv) != 3:  # noqa: PLR2004  the program and two arguments
        sys.stderr.write(f"usage: {os.path.basename(sys.argv[0])} NAME SOURCES\n")
        return 2
    name, sources = sys.argv[1], Path(sys.argv[2])
    target = DATA / name
    old, new = {}, {}
    for package in NAMED:
        old.update(modules(sources / BASE, package))
        new.update(modules(sources / name, package))
    changed, gone = stubs(sources, name)
    files = {
        "names.txt": compared_names(old, new),
        "interfaces.txt": interfaces(sources, name),
        "removed_stubs.txt": "".join(f"{path}\n" for path in gone),
        **{f"stubs/{path}": of_subclasses(text) for path, text in changed.items()},
    }
    for path, text in files.items():
        file = target / path
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text)
        sys.stdout.write(f"{file.relative_to(DATA)}: {len(text)}\n")
    for missing in with_facts(name):
        sys.stdout.write(f"{name}/{missing}: copied, review each line\n")
    return 0


def with_facts(name: str) -> Iterator[str]:
    """Copy hand-written files from the previous distribution, and yield them."""
    before = DATA / max((other for other in ORDER if other < name), default=BASE)
    for file in ("profile.toml", "standard_library.txt"):
        if (before / file).is_file() and not (DATA / name / file).exists():
            (DATA / name / file).write_bytes((before / file).read_bytes())
            yield file


if __name__ == "__main__":
    sys.exit(main())
