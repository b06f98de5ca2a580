from typing import Any
from typing import Mapping
from typing import Text
from ..action import Action as Action
from ..frontend import Entity as Entity
from ..frontend import expose_action as expose_action
from ..frontend import Parser as Parser
from ..launch_context import LaunchContext as LaunchContext
from ..utilities import normalize_to_list_of_substitutions as normalize_to_list_of_substitutions
from ..utilities import perform_substitutions as perform_substitutions

class ReplaceEnvironmentVariables(Action):
    def __init__(self, environment: Mapping[Text, Text] = ..., **kwargs: Any) -> None: ...
    @classmethod
    def parse(cls, entity: Entity, parser: Parser) -> Any: ...
    @property
    def environment(self) -> Any: ...
    def execute(self, context: LaunchContext) -> None: ...
    __environment: Any
