from collections.abc import Callable

from launch.event import Event as Event

def event_named(name: str) -> Callable[[Event], bool]: ...
