from types import ModuleType

from launch.launch_description import LaunchDescription

class InvalidPythonLaunchFileError(Exception): ...

def load_python_launch_file_as_module(python_launch_file_path: str) -> ModuleType: ...
def get_launch_description_from_python_launch_file(
    python_launch_file_path: str,
) -> LaunchDescription: ...
