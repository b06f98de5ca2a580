from launch.some_substitutions_type import (
    SomeSubstitutionsType as SomeSubstitutionsType,
)
from launch.substitution import Substitution as Substitution

class Command(Substitution):
    def __init__(
        self, command: SomeSubstitutionsType, *, on_stderr: SomeSubstitutionsType = "fail"
    ) -> None: ...
    @property
    def command(self) -> list[Substitution]: ...
    @property
    def on_stderr(self) -> list[Substitution]: ...
