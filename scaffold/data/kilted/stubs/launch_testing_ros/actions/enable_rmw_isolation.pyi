from typing import Any
from typing import List
from typing import Optional
from launch.action import Action as Action
from launch.event import Event as Event
from launch.event_handlers import OnShutdown as OnShutdown
from launch.launch_context import LaunchContext as LaunchContext
from launch.launch_description_entity import LaunchDescriptionEntity as LaunchDescriptionEntity
from launch.some_entities_type import SomeEntitiesType as SomeEntitiesType
from rmw_test_fixture_implementation import rmw_test_isolation_start as rmw_test_isolation_start
from rmw_test_fixture_implementation import rmw_test_isolation_stop as rmw_test_isolation_stop

class EnableRmwIsolation(Action):
    def __init__(self, **kwargs: Any) -> None: ...
    __on_shutdown: Any

    def execute(self, context: LaunchContext) -> Optional[List[LaunchDescriptionEntity]]: ...
