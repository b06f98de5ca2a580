from collections.abc import Iterable
from _ros_launch import Listed
from launch.some_substitutions_type import SomeSubstitutionsType as SomeSubstitutionsType
from launch.substitution import Substitution as Substitution
from typing import Any
from typing import Dict
from typing import Sequence
from typing import Tuple
from typing import Type
from ..frontend import expose_substitution as expose_substitution
from ..launch_context import LaunchContext as LaunchContext
from ..utilities import normalize_to_list_of_substitutions as normalize_to_list_of_substitutions
from ..utilities import perform_substitutions as perform_substitutions

class PathJoinSubstitution(Substitution):
    def __init__(self, substitutions: Listed[SomeSubstitutionsType]) -> None: ...
    @property
    def substitutions(self) -> Iterable[Substitution]: ...
    def __truediv__(self, additional_path: SomeSubstitutionsType) -> PathJoinSubstitution: ...
    @classmethod
    def parse(
        cls, data: Sequence[SomeSubstitutionsType]
    ) -> Tuple[Type["PathJoinSubstitution"], Dict[str, Any]]: ...

class PathSubstitution(PathJoinSubstitution):
    def __init__(self, path: SomeSubstitutionsType) -> None: ...
