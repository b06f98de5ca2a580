"""Renders a part to be added: a node, an interface, a program or an extra."""

from __future__ import annotations

import os
import re
from collections.abc import Iterable, Mapping, Sequence
from typing import Any, NamedTuple

from scaffold.errors import InputError
from scaffold.generate import parts
from scaffold.generate.add import existing_answers, existing_nodes, remarks
from scaffold.generate.context import part_scopes
from scaffold.generate.draft import Composed, Existing, compose
from scaffold.generate.edit.addition import Addition, Compiled, Program
from scaffold.generate.edit.edit import README
from scaffold.generate.edit.layout import Layout, layout_of
from scaffold.generate.questions.defaults import User
from scaffold.generate.questions.questions import Given
from scaffold.generate.repository import Place, place_of
from scaffold.generate.templates import licenses
from scaffold.generate.templates.render import Rendered
from scaffold.generate.templates.template import BASE, ENDING, PARTS, Role, Template
from scaffold.generate.update import update
from scaffold.generate.update.provenance import Provenance
from scaffold.model.launch.files import launch_files
from scaffold.model.package import Package

_TESTS = "test"
_FIXTURES = "conftest.py"
"""What the tests of nodes share."""
_OWN_TESTS = "nodes"
"""The directory for tests if the fixtures of the package conflict with ours."""
EXTRAS = "extras"
"""The question for extras."""
LAUNCH = "launch/"
"""The directory of launch files."""
_OF_README = "_readme.md"
"""What an extra adds to the README of its package."""

_Scope = tuple[Template, Mapping[str, Any]]
"""A template, and the variables of its files."""


class Target(NamedTuple):
    """The package to which something is added, and the templates to use."""

    package: Package
    roots: Sequence[str]
    """The ``templates`` directories; a later one wins."""
    templates: Mapping[str, Template]
    """The templates in them."""
    user: User
    """Supplies answers that are neither in the package nor given."""

    @property
    def place(self) -> Place:
        """Where the package is in its git repository."""
        return place_of(self.package.root)


class Wanted(NamedTuple):
    """The addition that the user requests."""

    template: Template
    name: str | None
    """Of a part; an extra has none."""
    given: Mapping[str, Given]
    """The answers; the package answers what it has decided."""
    launch: str = ""
    """The launch file that starts a node, as the user has named it."""


class Piece(NamedTuple):
    """The rendered addition, in memory."""

    template: Template
    composed: Composed
    rendered: Rendered
    """Its own files, at the places where the package has such files."""
    addition: Addition
    """The edits that it needs in other files."""
    others: Sequence[str] = ()
    """Programs that a launch file does not start: they may or may not be nodes."""

    @property
    def built(self) -> str | None:
        """The name of its program for ``ros2 run``, if it is one."""
        if self.addition.program is not None:
            return self.addition.program.name
        return self.addition.compiled.name if self.addition.compiled is not None else None


def make(target: Target, old: Provenance | None, wanted: Wanted) -> Piece:
    """Render what is added to a package.

    Args:
        target: The package.
        old: How it was created, if it was generated.
        wanted: What is added.

    Raises:
        InputError: it does not fit the package, or an answer is not acceptable.
        ViewError: a file of the package is missing or cannot be parsed.
    """
    layout = layout_of(target.package)
    if wanted.template.role is Role.EXTRA:
        return _extra(target, old, wanted, layout)
    part = {parts.KIND: wanted.template.name, "name": wanted.name}
    composed = _compose(target, {**wanted.given, parts.ADD: Given([part], "NAME")})
    composed.context["is_added"] = True
    scopes = _with_roles(composed, PARTS)
    rendered = _rendered(target, composed, scopes, layout)
    if _is_foreign(target.package, old, f"{layout.tests}/{_FIXTURES}", rendered):
        layout = layout._replace(tests=f"{layout.tests}/{_OWN_TESTS}")
        rendered = _rendered(target, composed, scopes, layout)
    rendered = _without_existing_fixtures(target.package, rendered, layout)
    addition = _of_part(target, composed, layout, rendered)
    if wanted.launch:
        addition = addition._replace(launch=_launch_file(target.package, wanted.launch))
    return Piece(wanted.template, composed, rendered, addition)


def _is_foreign(package: Package, old: Provenance | None, path: str, rendered: Rendered) -> bool:
    """Return whether a package has its own fixtures in the file for ours."""
    if path not in rendered.files or not package.has(path):
        return False
    is_ours = old is not None and path in old.rendered
    return not is_ours and _body(package.source(path).text) != _body(rendered.files[path])


def _without_existing_fixtures(package: Package, rendered: Rendered, layout: Layout) -> Rendered:
    """Remove the fixtures if the package has them already, under any license."""
    path = f"{layout.tests}/{_FIXTURES}"
    if not package.has(path):
        return rendered
    files = {name: text for name, text in rendered.files.items() if name != path}
    return rendered._replace(files=files)


def _body(text: str) -> str:
    """Return a Python file without the header of its license."""
    return text[text.find('"""') :]


def _launch_file(package: Package, given: str) -> str:
    """Return the path of a launch file in the package; the user may give it from elsewhere.

    Raises:
        InputError: it is not a launch file of the package.
    """
    existing = launch_files(package)
    relative = os.path.relpath(os.path.realpath(given), os.path.realpath(package.root or "."))
    path = next((path for path in (os.path.normpath(given), relative) if path in existing), None)
    if path is None:
        names = ", ".join(existing) or "none"
        raise InputError(
            f"--launch: {given} is not a launch file of {package.name}; it has {names}"
        )
    return path


def _extra(target: Target, old: Provenance | None, wanted: Wanted, layout: Layout) -> Piece:
    """Render an extra for the nodes that the package has, ours and those of others."""
    package, template = target.package, wanted.template
    recorded = update.recorded(old, target.templates, package.directory, []) if old else {}
    chosen = {
        parts.ADD: recorded.get(parts.ADD, Given([], "KIND")),
        EXTRAS: Given([template.name], "KIND"),
    }
    composed = _compose(target, {**recorded, **wanted.given, **chosen})
    context = composed.context
    existing = existing_nodes.find(package, context["nodes"], context["programs"])
    context["nodes"] = existing.nodes
    context["other_programs"] = existing.others
    context["interfaces"] = _interfaces(package)
    rendered = _rendered(target, composed, [(template, context)], layout)
    if not rendered.files:
        lacks = "installs no node" if template.needs_nodes else "has no program and no interface"
        raise InputError(
            f"{template.name} has nothing to write for {package.directory or package.name}: it "
            f"{lacks} that is known"
        )
    addition = _described(composed, template, context, package.name, rendered)
    tests = filter(None, (composed.renderer.text(text, context) for text in template.tests))
    placed = (_relocated(path, {_TESTS: layout.tests}) for path in tests)
    addition = addition._replace(test=next(placed, None))
    readme = f"{template.name}/{_OF_README}{ENDING}"
    if composed.renderer.has(readme):
        macro = f"{{% import '{readme}' as readme with context %}}{{{{ readme.run() }}}}"
        text = composed.renderer.text(macro, context).strip("\n")
        addition = addition._replace(readme=f"## Run\n\n{text}\n" if text else "")
    is_launch = template.needs_nodes and any(path.startswith(LAUNCH) for path in rendered.files)
    return Piece(template, composed, rendered, addition, existing.others if is_launch else ())


def _interfaces(package: Package) -> list[dict[str, str]]:
    """Return the interfaces that a package defines, as its files see them."""
    paths = [path for kind in ("msg", "srv", "action") for path in package.glob(f"{kind}/*.{kind}")]
    return [
        {"file": path, "type": f"{package.name}/{path.rpartition('.')[0]}"}
        for path in sorted(paths)
    ]


def _compose(target: Target, given: Mapping[str, Given]) -> Composed:
    """Answer all questions, using the answers implied by the package."""
    package = target.package
    decided = existing_answers.answers(package, licenses.names(target.roots))
    settled = {**decided, **given}
    answers = {**decided, **given, "build_type": Given(package.build_type, "package.xml")}
    fixed = {"package": package.name, "build_type": package.build_type}
    messages = [path[len("msg/") : -len(".msg")] for path in package.glob("msg/*.msg")]
    composed = compose(
        target.roots,
        target.templates,
        answers,
        target.user,
        existing=Existing(fixed, messages, list(remarks.uses(package))),
        place=target.place,
    )
    composed.context["has_license"] = "license" in settled
    if not composed.context["has_license"]:
        # The header of the author's other files, or none, is better than another license.
        composed.context["header"] = existing_answers.own_header(package)
    elif not {"copyright_holder", "maintainer_name"} & {*settled}:
        composed.context["header"] = ""  # the user need not be the copyright holder
    return composed


def _with_roles(composed: Composed, roles: Iterable[Role]) -> list[_Scope]:
    """Return the templates of some roles with the variables of their files."""
    scopes = part_scopes(composed.layers, composed.context)
    return [(layer, scope) for layer, scope in scopes if layer.role in roles]


def _rendered(
    target: Target, composed: Composed, scopes: Sequence[_Scope], layout: Layout
) -> Rendered:
    """Render single files; programs and tests go to the directories of the package for them."""
    rendered = composed.renderer.package(scopes)
    name = target.package.name

    def place(path: str) -> str:
        return _relocated(path, {name: layout.programs, _TESTS: layout.tests})

    files = {place(path): _without_gap(text) for path, text in rendered.files.items()}
    if any(path.startswith(f"{layout.programs}/") for path in files):
        files |= dict.fromkeys(layout.new_files, "")
    return Rendered(
        files,
        frozenset(map(place, rendered.executable)),
        {place(path): note for path, note in rendered.notes.items()},
        rendered.unread,
    )


def _relocated(path: str, places: Mapping[str, str]) -> str:
    """Return a path in the directory that the package uses instead of the default one."""
    directory, _, rest = path.partition("/")
    return f"{places[directory]}/{rest}" if rest and directory in places else path


def _without_gap(text: str) -> str:
    """Remove the blank lines left by an empty header."""
    return re.sub(r"\A(#!.*\n)?\n+", r"\1", text) if re.match(r"(#!.*\n)?\n", text) else text


def _described(
    composed: Composed,
    layer: Template,
    scope: Mapping[str, Any],
    package: str,
    rendered: Rendered,
) -> Addition:
    """Return the dependencies and directories that the manifest of a template declares."""
    renderer = composed.renderer
    depends = {
        kind: [name for text in texts for name in renderer.text(text, scope).split()]
        for kind, texts in layer.depends.items()
    }
    installs = {renderer.text(text, scope) for text in layer.installs}
    directories = sorted(installs - {""})
    return Addition(
        package,
        depends=depends,
        groups=[renderer.text(text, scope) for text in layer.groups],
        directories=directories,
        shared=[
            path
            for path in rendered.files
            if any(path.startswith(f"{directory}/") for directory in directories)
        ],
    )


def _of_part(target: Target, composed: Composed, layout: Layout, rendered: Rendered) -> Addition:
    """Return the edits that other files need for a node, an interface or a program."""
    context, renderer = composed.context, composed.renderer
    ((layer, scope),) = _with_roles(composed, PARTS)
    package = target.package.name
    tests = [path for path in rendered.files if path.startswith(f"{layout.tests}/test_")]
    changelog = renderer.file(f"{BASE}/CHANGELOG.rst{ENDING}", context)
    addition = _described(composed, layer, scope, package, rendered)._replace(
        test=tests[0] if tests else None,
        readme=renderer.file(f"{BASE}/{README}{ENDING}", context),
        changes=[line for line in changelog.splitlines() if line.startswith("* ")],
    )
    if layer.role is Role.NODE:
        node = scope["node"]
        path = next(iter(sorted(rendered.executable)))
        module = f"{layout.module}.{node['module']}" if layout.module else node["module"]
        return addition._replace(program=Program(path, node["executable"], module))
    if layer.role is Role.INTERFACE:
        depends = addition.depends.get("depend", ())
        return addition._replace(
            interfaces=[scope["interface"]["file"]],
            interface_depends=[name for name in depends if name != package],
        )
    source = next(path for path in rendered.files if path.startswith("src/"))
    return addition._replace(compiled=Compiled(str(scope["program"]["name"]), source))
