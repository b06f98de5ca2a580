from typing import Any
from typing import Callable
from typing import List
from typing import Optional
from typing import Protocol
from typing import Text
from ..action import Action as Action
from ..actions.opaque_function import OpaqueFunction as OpaqueFunction
from ..frontend import Entity as Entity
from ..frontend import expose_action as expose_action
from ..frontend import Parser as Parser
from ..launch_context import LaunchContext as LaunchContext
from ..launch_description_entity import LaunchDescriptionEntity as LaunchDescriptionEntity
from ..logging import get_logger as get_logger
from ..some_substitutions_type import SomeSubstitutionsType as SomeSubstitutionsType
from ..substitution import Substitution as Substitution
from ..substitutions import ForEachVar as ForEachVar
from ..utilities import perform_substitutions as perform_substitutions

class ForEach(Action):
    SEPARATOR: str

    def __init__(
        self,
        input_values: SomeSubstitutionsType,
        *,
        function: Callable[..., Optional[List[LaunchDescriptionEntity]]],
        **kwargs: Any,
    ) -> None: ...
    @property
    def input_values(self) -> List[Substitution]: ...
    @property
    def function(self) -> Callable[[int], Optional[List[LaunchDescriptionEntity]]]: ...
    def describe(self) -> Text: ...
    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> Any: ...
    def execute(self, context: LaunchContext) -> Optional[List[LaunchDescriptionEntity]]: ...
    _get_iteration_entities: Any
    _push_locals: Any
    _pop_locals: Any
    _set_args_local: Any
    _input_values: Any
    _function: Any
    _logger: Any

class ForLoop(Action):
    class _CallbackFunction(Protocol):
        def __call__(self, i: int) -> Optional[List[LaunchDescriptionEntity]]: ...

    def __init__(
        self,
        length: SomeSubstitutionsType,
        *,
        function: _CallbackFunction,
        name: Optional[str] = None,
        **kwargs: Any,
    ) -> None: ...
    @property
    def length(self) -> List[Substitution]: ...
    @property
    def function(self) -> Callable[[int], Optional[List[LaunchDescriptionEntity]]]: ...
    @property
    def name(self) -> Optional[str]: ...
    def describe(self) -> Text: ...
    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> Any: ...
    def execute(self, context: LaunchContext) -> Optional[List[LaunchDescriptionEntity]]: ...
    _length: Any
    _function: Any
    _name: Any
    _logger: Any
