from launch.action import Action as Action
from launch.condition import Condition
from launch.some_substitutions_type import (
    SomeSubstitutionsType as SomeSubstitutionsType,
)
from launch.substitution import Substitution as Substitution

class SetROSLogDir(Action):
    def __init__(
        self, new_log_dir: SomeSubstitutionsType, *, condition: Condition | None = None
    ) -> None: ...
    @property
    def log_dir(self) -> list[Substitution]: ...
