"""Jinja itself: for templates of the user's own, and for what is not translated."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import cached_property
from types import CodeType
from typing import Any

from jinja2 import BaseLoader, StrictUndefined, TemplateError, TemplateNotFound
from jinja2 import Environment as Environment_

from scaffold.errors import ContentError
from scaffold.generate import filters
from scaffold.generate.compiled import Compiled
from scaffold.generate.programs import NotTranslatedError
from scaffold.generate.sandbox import Sandbox
from scaffold.generate.sources import Sources
from scaffold.generate.template import ENDING
from scaffold.generate.translate import UntranslatableError, translate
from scaffold.model.disk import digest


class Jinja:
    """Renders files of templates and short texts, sandboxed, with every variable defined.

    Args:
        sources: The texts of the files.
        globals_: What all templates may use.
    """

    def __init__(self, sources: Sources, globals_: Mapping[str, Any]) -> None:
        self._form = "tutorial" if sources.is_tutorial else "brief"
        self._globals = globals_
        self._loader = _Loader(sources)

    @cached_property
    def plain(self) -> Environment_:
        """For any file."""
        jinja = Sandbox(
            loader=self._loader,
            undefined=StrictUndefined,
            keep_trailing_newline=True,
            trim_blocks=True,
            lstrip_blocks=True,
            autoescape=False,
            bytecode_cache=Compiled(self._form),
        )
        jinja.filters |= {
            "literal": filters.literal,
            "markdown": filters.markdown,
            "slashes": filters.slashes,
            "xml": filters.xml,
        }
        jinja.globals.update(self._globals)
        return jinja

    @cached_property
    def xml(self) -> Environment_:
        """The same for XML files: whatever a template prints there is escaped."""
        kept = Compiled(f"{self._form}_xml")
        return self.plain.overlay(finalize=filters.xml, bytecode_cache=kept)

    def file(self, name: str, context: Mapping[str, Any], *, is_xml: bool) -> str:
        """Render a file.

        Raises:
            ContentError: it cannot be rendered.
        """
        with _Told(name):
            return (self.xml if is_xml else self.plain).get_template(name).render(context)

    def text(self, source: str, context: Mapping[str, Any]) -> str:
        """Render a short text.

        Raises:
            ContentError: it cannot be rendered.
        """
        with _Told(source):
            return self.plain.get_template(self._loader.named(source)).render(context)

    def translated(self, name: str, text: str) -> CodeType:
        """Return the code that a template is in Python; see `scaffold.generate.translate`.

        Raises:
            NotTranslatedError: it is left to Jinja, or is not right.
        """
        try:
            return translate(self.plain.parse(text), name)
        except (UntranslatableError, TemplateError) as error:
            raise NotTranslatedError(name) from error


class _Loader(BaseLoader):
    """Hands the texts to Jinja.

    A short text is a template, too, so that it is kept compiled, as the files are.
    """

    def __init__(self, sources: Sources) -> None:
        self._sources = sources
        self._texts: dict[str, str] = {}

    def named(self, text: str) -> str:
        """Return the name of the template that a short text is."""
        name = f"text {digest(text.encode('utf-8', 'surrogatepass'))}"
        self._texts[name] = text
        return name

    def get_source(
        self, environment: Environment_, template: str
    ) -> tuple[str, str, Callable[[], bool] | None]:
        """Return the text of a template."""
        del environment
        if template in self._texts:
            return self._texts[template], template, None
        path = self._sources.find(template)
        if path is None:
            raise TemplateNotFound(template)
        return self._sources.read(template), path, None


class _Told:
    """Turns what Jinja raises into one line for the author of the template."""

    def __init__(self, where: str) -> None:
        self._where = where

    def __enter__(self) -> None:
        """Do nothing."""

    def __exit__(self, kind: type[BaseException] | None, error: object, trace: object) -> None:
        if kind is None or not isinstance(error, Exception) or isinstance(error, ContentError):
            return
        line = getattr(error, "lineno", None) if isinstance(error, TemplateError) else None
        at = f":{line}" if line else _line_of(error)
        message = f"template {self._where!r}{at}: {type(error).__name__}: {error}"
        raise ContentError(" ".join(message.split())) from error


def _line_of(error: Exception) -> str:
    """Return where in a template's file something went wrong, if Jinja knows."""
    import traceback

    for frame in reversed(traceback.extract_tb(error.__traceback__)):
        if frame.filename.endswith(ENDING):
            return f", {frame.filename}:{frame.lineno}"
    return ""
