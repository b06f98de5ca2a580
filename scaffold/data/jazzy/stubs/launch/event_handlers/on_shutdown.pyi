from _ros_launch import Reaction
from launch.event_handler import BaseEventHandler
from launch.events.shutdown import Shutdown

class OnShutdown(BaseEventHandler):
    def __init__(self, *, on_shutdown: Reaction[Shutdown], handle_once: bool = False) -> None: ...
