"""What a workspace needs of the packages in it and around it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Protocol, TypeVar

if TYPE_CHECKING:
    from scaffold.model.cmake.lists import CMakeLists
    from scaffold.source import Source


class Member(Protocol):
    """A package in a workspace."""

    directory: str

    @property
    def name(self) -> str:
        """The name in its manifest."""

    @property
    def files(self) -> Sequence[str]:
        """All files, relative to the root."""

    @property
    def cmake(self) -> CMakeLists:
        """CMakeLists.txt; raises ViewError."""

    def has(self, path: str) -> bool:
        """Return whether a file exists."""

    def has_directory(self, path: str) -> bool:
        """Return whether a directory exists."""

    def source(self, path: str) -> Source:
        """Return the decoded text of a file; raises ViewError."""

    def forget(self) -> None:
        """Drop what derives from its files."""

    def forget_others(self) -> None:
        """Drop what derives from the packages around it."""


AnyMember = TypeVar("AnyMember", bound=Member)
Found_co = TypeVar("Found_co", covariant=True)


class Neighbors(Protocol[Found_co]):
    """The packages around a workspace, which are found on demand."""

    @property
    def directories(self) -> Mapping[str, str]:
        """Their directories by name."""

    def get(self, name: str) -> Found_co | None:
        """Return the package with a name, if it exists."""

    def __iter__(self) -> Iterator[Found_co]:
        """Return all of them."""
