from typing import Any
from typing import Dict
from typing import List
from typing import Tuple
from typing import Type
from ..action import Action as Action
from ..frontend import Entity as Entity
from ..frontend import expose_action as expose_action
from ..frontend import Parser as Parser
from ..launch_context import LaunchContext as LaunchContext
from ..some_substitutions_type import SomeSubstitutionsType as SomeSubstitutionsType
from ..substitution import Substitution as Substitution
from ..utilities import normalize_to_list_of_substitutions as normalize_to_list_of_substitutions

class LogInterface(Action):
    def __init__(
        self, *, msg: SomeSubstitutionsType, level: SomeSubstitutionsType, **kwargs: Any
    ) -> None: ...
    @property
    def msg(self) -> List[Substitution]: ...
    @property
    def level(self) -> List[Substitution]: ...
    def execute(self, context: LaunchContext) -> None: ...
    __msg: Any
    __level: Any
    __logger: Any

class Log(LogInterface):
    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> Tuple[Type["Log"], Dict[str, Any]]: ...

class SharedLogSpecificParse(Action):
    @classmethod
    def parse(
        cls, entity: Entity, parser: Parser
    ) -> Tuple[Type["SharedLogSpecificParse"], Dict[str, Any]]: ...

class LogInfo(SharedLogSpecificParse, LogInterface):
    def __init__(self, *, msg: SomeSubstitutionsType, **kwargs: Any) -> None: ...

class LogWarning(SharedLogSpecificParse, LogInterface):
    def __init__(self, *, msg: SomeSubstitutionsType, **kwargs: Any) -> None: ...

class LogDebug(SharedLogSpecificParse, LogInterface):
    def __init__(self, *, msg: SomeSubstitutionsType, **kwargs: Any) -> None: ...

class LogError(SharedLogSpecificParse, LogInterface):
    def __init__(self, *, msg: SomeSubstitutionsType, **kwargs: Any) -> None: ...
