from _ros_launch import Reaction
from launch.event_handler import BaseEventHandler
from launch.events.shutdown import Shutdown
from ..event import Event as Event
from ..some_actions_type import SomeActionsType as SomeActionsType
from ..utilities import is_a_subclass as is_a_subclass
from ..launch_context import LaunchContext as LaunchContext

class OnShutdown(BaseEventHandler):
    def __init__(self, *, on_shutdown: Reaction[Shutdown], handle_once: bool = False) -> None: ...
