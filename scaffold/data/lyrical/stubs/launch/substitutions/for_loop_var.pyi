from typing import Any
from typing import Dict
from typing import List
from typing import Optional
from typing import Sequence
from typing import Text
from typing import Tuple
from typing import Type
from ..frontend import expose_substitution as expose_substitution
from ..launch_context import LaunchContext as LaunchContext
from ..logging import get_logger as get_logger
from ..some_substitutions_type import SomeSubstitutionsType as SomeSubstitutionsType
from ..substitution import Substitution as Substitution
from ..utilities import perform_substitutions as perform_substitutions

class ForEachVar(Substitution):
    def __init__(
        self, name: SomeSubstitutionsType, *, default_value: Optional[SomeSubstitutionsType] = None
    ) -> None: ...
    @property
    def name(self) -> List[Substitution]: ...
    @property
    def default_value(self) -> Optional[List[Substitution]]: ...
    def describe(self) -> Text: ...
    @classmethod
    def parse(
        cls, data: Sequence[SomeSubstitutionsType]
    ) -> Tuple[Type["ForEachVar"], Dict[str, Any]]: ...
    def perform(self, context: LaunchContext) -> Text: ...
    @classmethod
    def get_local_arg_name(cls, name: str) -> str: ...
    _name: Any
    _default_value: Any
    _logger: Any

class ForLoopIndex(ForEachVar):
    def __init__(self, name: SomeSubstitutionsType, **kwargs: Any) -> None: ...
