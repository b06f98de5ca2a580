from launch.event import Event as Event
from launch.launch_description import LaunchDescription

class IncludeLaunchDescription(Event):
    def __init__(self, launch_description: LaunchDescription) -> None: ...
    @property
    def launch_description(self) -> LaunchDescription: ...
