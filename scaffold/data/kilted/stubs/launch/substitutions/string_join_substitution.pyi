from typing import Any
from typing import Iterable, List, Text
from ..launch_context import LaunchContext as LaunchContext
from ..some_substitutions_type import SomeSubstitutionsType as SomeSubstitutionsType
from ..substitution import Substitution as Substitution
from ..utilities import perform_substitutions as perform_substitutions

class StringJoinSubstitution(Substitution):
    def __init__(
        self, substitutions: Iterable[SomeSubstitutionsType], delimiter: SomeSubstitutionsType = ""
    ) -> None: ...
    @property
    def substitutions(self) -> List[List[Substitution]]: ...
    @property
    def delimiter(self) -> List[Substitution]: ...
    def __repr__(self) -> Text: ...
    def perform(self, context: LaunchContext) -> Text: ...
    __substitutions: Any
    __delimiter: Any
