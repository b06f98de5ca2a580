from launch.invalid_launch_file_error import (
    InvalidLaunchFileError as InvalidLaunchFileError,
)
from launch.launch_description_sources.any_launch_description_source import (
    AnyLaunchDescriptionSource as AnyLaunchDescriptionSource,
)
from launch.launch_description_sources.any_launch_file_utilities import (
    get_launch_description_from_any_launch_file as get_launch_description_from_any_launch_file,
)
from launch.launch_description_sources.frontend_launch_description_source import (
    FrontendLaunchDescriptionSource as FrontendLaunchDescriptionSource,
)
from launch.launch_description_sources.frontend_launch_file_utilities import (
    InvalidFrontendLaunchFileError as InvalidFrontendLaunchFileError,
)
from launch.launch_description_sources.frontend_launch_file_utilities import (
    get_launch_description_from_frontend_launch_file as get_launch_description_from_frontend_launch_file,
)
from launch.launch_description_sources.python_launch_description_source import (
    PythonLaunchDescriptionSource as PythonLaunchDescriptionSource,
)
from launch.launch_description_sources.python_launch_file_utilities import (
    InvalidPythonLaunchFileError as InvalidPythonLaunchFileError,
)
from launch.launch_description_sources.python_launch_file_utilities import (
    get_launch_description_from_python_launch_file as get_launch_description_from_python_launch_file,
)
from launch.launch_description_sources.python_launch_file_utilities import (
    load_python_launch_file_as_module as load_python_launch_file_as_module,
)
