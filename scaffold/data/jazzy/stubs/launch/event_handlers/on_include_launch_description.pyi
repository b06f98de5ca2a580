from launch.event_handler import EventHandler

class OnIncludeLaunchDescription(EventHandler):
    def __init__(self, *, handle_once: bool = False) -> None: ...
