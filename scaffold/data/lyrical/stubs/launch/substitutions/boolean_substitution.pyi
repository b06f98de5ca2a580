from launch.some_substitutions_type import SomeSubstitutionsType as SomeSubstitutionsType
from launch.substitution import Substitution as Substitution
from typing import Any
from typing import Callable
from typing import Dict
from typing import Iterable
from typing import List
from typing import Optional
from typing import Sequence
from typing import Text
from typing import Tuple
from typing import Type
from .substitution_failure import SubstitutionFailure as SubstitutionFailure
from ..frontend import expose_substitution as expose_substitution
from ..launch_context import LaunchContext as LaunchContext
from ..utilities import normalize_to_list_of_substitutions as normalize_to_list_of_substitutions
from ..utilities.type_utils import perform_typed_substitution as perform_typed_substitution
from ..utilities.type_utils import StrSomeValueType as StrSomeValueType

class NotSubstitution(Substitution):
    def __init__(self, value: SomeSubstitutionsType) -> None: ...
    @property
    def value(self) -> list[Substitution]: ...

class AndSubstitution(LeftRightLogicalSubstitution):
    def __init__(self, left: SomeSubstitutionsType, right: SomeSubstitutionsType) -> None: ...
    @property
    def left(self) -> list[Substitution]: ...
    @property
    def right(self) -> list[Substitution]: ...

class OrSubstitution(LeftRightLogicalSubstitution):
    def __init__(self, left: SomeSubstitutionsType, right: SomeSubstitutionsType) -> None: ...
    @property
    def left(self) -> list[Substitution]: ...
    @property
    def right(self) -> list[Substitution]: ...

class AnySubstitution(ContainerSubstitution):
    def __init__(self, *args: SomeSubstitutionsType) -> None: ...
    @property
    def args(self) -> list[list[Substitution]]: ...

class AllSubstitution(ContainerSubstitution):
    def __init__(self, *args: SomeSubstitutionsType) -> None: ...
    @property
    def args(self) -> list[list[Substitution]]: ...

class LeftRightLogicalSubstitution(Substitution):
    def __init__(
        self,
        func: Callable[[StrSomeValueType, StrSomeValueType], bool],
        left: SomeSubstitutionsType,
        right: SomeSubstitutionsType,
    ) -> None: ...
    @classmethod
    def parse(
        cls, data: Sequence[SomeSubstitutionsType]
    ) -> Tuple[Type[LeftRightLogicalSubstitution], Dict[str, Any]]: ...
    @property
    def func(self) -> Callable[[StrSomeValueType, StrSomeValueType], bool]: ...
    @property
    def left(self) -> List[Substitution]: ...
    @property
    def right(self) -> List[Substitution]: ...
    def describe(self) -> Text: ...
    def perform(self, context: LaunchContext) -> Text: ...
    __func: Any
    __left: Any
    __right: Any

class ContainerSubstitution(Substitution):
    def __init__(
        self,
        func: Callable[[Iterable[StrSomeValueType]], bool],
        *args: SomeSubstitutionsType,
        container: Optional[Iterable[SomeSubstitutionsType]] = None,
    ) -> None: ...
    @classmethod
    def parse(
        cls, data: Iterable[SomeSubstitutionsType]
    ) -> Tuple[Type[ContainerSubstitution], Dict[str, Any]]: ...
    @property
    def func(self) -> Callable[[List[StrSomeValueType]], bool]: ...
    @property
    def args(self) -> List[List[Substitution]]: ...
    def describe(self) -> Text: ...
    def perform(self, context: LaunchContext) -> Text: ...
    __func: Any
    __args: Any
