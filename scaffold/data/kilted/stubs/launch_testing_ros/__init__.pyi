from typing import Any
from launch_testing_ros import tools as tools, actions as actions
from launch_testing_ros.wait_for_topics import WaitForTopics as WaitForTopics

def __getattr__(name: str) -> Any: ...
