from launch.some_substitutions_type import SomeSubstitutionsType as SomeSubstitutionsType
from launch.substitution import Substitution as Substitution
from ..frontend import expose_substitution as expose_substitution
from ..launch_context import LaunchContext as LaunchContext
from ..utilities import ensure_argument_type as ensure_argument_type

class PythonExpression(Substitution):
    def __init__(self, expression: SomeSubstitutionsType) -> None: ...
    @property
    def expression(self) -> list[Substitution]: ...
