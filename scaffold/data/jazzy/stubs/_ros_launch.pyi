# Types that the stubs of launch share; a program cannot import it.
from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import Any, Protocol, SupportsIndex, TypeAlias, TypeVar

from launch.event import Event
from launch.launch_context import LaunchContext
from launch.launch_description_entity import LaunchDescriptionEntity
from launch.some_entities_type import SomeEntitiesType
from launch.some_substitutions_type import SomeSubstitutionsType

_T_co = TypeVar("_T_co", covariant=True)
_EventT = TypeVar("_EventT", bound=Event)

# A list or a tuple: a str would become a list of its letters, a dict one of its keys.
class Listed(Protocol[_T_co]):
    def __contains__(self, item: object, /) -> bool: ...
    def __getitem__(self, index: SupportsIndex, /) -> _T_co: ...
    def __iter__(self) -> Iterator[_T_co]: ...
    def __len__(self) -> int: ...

Environment: TypeAlias = Mapping[Any, SomeSubstitutionsType]
# What a handler returns is executed; `None` in a list of it is skipped.
_Returned: TypeAlias = LaunchDescriptionEntity | Iterable[LaunchDescriptionEntity | None] | None
Reaction: TypeAlias = SomeEntitiesType | Callable[[_EventT, LaunchContext], _Returned]
