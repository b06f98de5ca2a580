from collections.abc import Callable
from launch.event import Event
from launch.event_handler import EventHandler
from launch.some_entities_type import SomeEntitiesType
from launch.some_substitutions_type import SomeSubstitutionsType as SomeSubstitutionsType
from launch_ros.actions.lifecycle_node import LifecycleNode
from launch.some_actions_type import SomeActionsType as SomeActionsType
from ..events.lifecycle import StateTransition as StateTransition

class OnStateTransition(EventHandler):
    def __init__(
        self,
        *,
        entities: SomeEntitiesType,
        target_lifecycle_node: LifecycleNode | None = None,
        transition: SomeSubstitutionsType | None = None,
        start_state: SomeSubstitutionsType | None = None,
        goal_state: SomeSubstitutionsType | None = None,
        matcher: Callable[[Event], bool] | None = None,
        handle_once: bool = False,
    ) -> None: ...
