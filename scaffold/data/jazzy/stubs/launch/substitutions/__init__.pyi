from launch.substitutions.anon_name import AnonName as AnonName
from launch.substitutions.boolean_substitution import AllSubstitution as AllSubstitution
from launch.substitutions.boolean_substitution import AndSubstitution as AndSubstitution
from launch.substitutions.boolean_substitution import AnySubstitution as AnySubstitution
from launch.substitutions.boolean_substitution import NotSubstitution as NotSubstitution
from launch.substitutions.boolean_substitution import OrSubstitution as OrSubstitution
from launch.substitutions.command import Command as Command
from launch.substitutions.environment_variable import (
    EnvironmentVariable as EnvironmentVariable,
)
from launch.substitutions.equals_substitution import (
    EqualsSubstitution as EqualsSubstitution,
)
from launch.substitutions.file_content import FileContent as FileContent
from launch.substitutions.find_executable import FindExecutable as FindExecutable
from launch.substitutions.if_else_substitution import (
    IfElseSubstitution as IfElseSubstitution,
)
from launch.substitutions.launch_configuration import (
    LaunchConfiguration as LaunchConfiguration,
)
from launch.substitutions.launch_log_dir import LaunchLogDir as LaunchLogDir
from launch.substitutions.local_substitution import (
    LocalSubstitution as LocalSubstitution,
)
from launch.substitutions.not_equals_substitution import (
    NotEqualsSubstitution as NotEqualsSubstitution,
)
from launch.substitutions.path_join_substitution import (
    PathJoinSubstitution as PathJoinSubstitution,
)
from launch.substitutions.path_join_substitution import (
    PathSubstitution as PathSubstitution,
)
from launch.substitutions.python_expression import PythonExpression as PythonExpression
from launch.substitutions.substitution_failure import (
    SubstitutionFailure as SubstitutionFailure,
)
from launch.substitutions.text_substitution import TextSubstitution as TextSubstitution
from launch.substitutions.this_launch_file import ThisLaunchFile as ThisLaunchFile
from launch.substitutions.this_launch_file_dir import (
    ThisLaunchFileDir as ThisLaunchFileDir,
)
