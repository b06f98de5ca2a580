from collections.abc import Iterable

from launch.action import Action as Action
from launch.condition import Condition
from launch.some_substitutions_type import (
    SomeSubstitutionsType as SomeSubstitutionsType,
)
from launch.substitution import Substitution as Substitution

class DeclareLaunchArgument(Action):
    def __init__(
        self,
        name: str,
        *,
        default_value: SomeSubstitutionsType | None = None,
        description: str | None = None,
        choices: Iterable[str] | None = None,
        condition: Condition | None = None,
    ) -> None: ...
    @property
    def name(self) -> str: ...
    @property
    def default_value(self) -> list[Substitution] | None: ...
    @property
    def description(self) -> str: ...
    @property
    def choices(self) -> list[str] | None: ...
