from collections.abc import Callable

from launch.action import Action

def matches_action(target_action: Action) -> Callable[[Action], bool]: ...
