from collections.abc import Iterable, Iterator
from typing import Any, ClassVar, Generic, Protocol, SupportsFloat, SupportsIndex
from typing_extensions import TypeAlias, TypeVar

_T_co = TypeVar("_T_co", covariant=True)
RequestT = TypeVar("RequestT", default=Any)
ResponseT = TypeVar("ResponseT", default=Any)
GoalT = TypeVar("GoalT", default=Any)
ResultT = TypeVar("ResultT", default=Any)
FeedbackT = TypeVar("FeedbackT", default=Any)
Floats: TypeAlias = Iterable[SupportsFloat | SupportsIndex]
Integers: TypeAlias = Iterable[SupportsIndex]

class Items(Protocol[_T_co]):
    def __contains__(self, item: object, /) -> bool: ...
    def __iter__(self) -> Iterator[_T_co]: ...
    def __len__(self) -> int: ...

class AnyMessage(Protocol):
    @classmethod
    def get_fields_and_field_types(cls) -> Any: ...

class Message:
    SLOT_TYPES: ClassVar[tuple[Any, ...]]
    _fields_and_field_types: ClassVar[dict[str, str]]
    _check_fields: bool

    @classmethod
    def get_fields_and_field_types(cls) -> dict[str, str]: ...

class Service(Generic[RequestT, ResponseT]): ...
class Action(Generic[GoalT, ResultT, FeedbackT]): ...
