from typing import Any
from typing import Dict
from typing import Optional
from typing import Text
from typing import Tuple
from typing import Type
from typing import Union
from .declare_launch_argument import DeclareLaunchArgument as DeclareLaunchArgument
from ..frontend import Entity as Entity
from ..frontend import expose_action as expose_action
from ..frontend import Parser as Parser
from ..some_substitutions_type import SomeSubstitutionsType as SomeSubstitutionsType

class DeclareBooleanLaunchArgument(DeclareLaunchArgument):
    def __init__(
        self,
        name: Text,
        *,
        default_value: Optional[Union[SomeSubstitutionsType, bool]] = None,
        **kwargs: Any,
    ) -> None: ...
    @classmethod
    def parse(
        cls, entity: Entity, parser: Parser
    ) -> Tuple[Type["DeclareBooleanLaunchArgument"], Dict[str, Any]]: ...
