from launch.action import Action as Action
from launch.some_substitutions_type import SomeSubstitutionsType as SomeSubstitutionsType
from launch.substitution import Substitution as Substitution
from typing import Any
from typing import List
from launch.frontend import Entity as Entity
from launch.frontend import expose_action as expose_action
from launch.frontend import Parser as Parser
from launch.launch_context import LaunchContext as LaunchContext
from launch.substitutions import SubstitutionFailure as SubstitutionFailure
from launch.utilities import (
    normalize_to_list_of_substitutions as normalize_to_list_of_substitutions,
)
from launch.utilities import perform_substitutions as perform_substitutions
from launch_ros.utilities import make_namespace_absolute as make_namespace_absolute
from launch_ros.utilities import prefix_namespace as prefix_namespace
from rclpy.validate_namespace import validate_namespace as validate_namespace

class PushRosNamespace(Action):
    def __init__(self, namespace: SomeSubstitutionsType, **kwargs: Any) -> None: ...
    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> Any: ...
    @property
    def namespace(self) -> List[Substitution]: ...
    def execute(self, context: LaunchContext) -> None: ...
    __namespace: Any
