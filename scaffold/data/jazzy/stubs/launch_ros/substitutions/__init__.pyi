from launch_ros.substitutions.executable_in_package import (
    ExecutableInPackage as ExecutableInPackage,
)
from launch_ros.substitutions.find_package import FindPackage as FindPackage
from launch_ros.substitutions.find_package import FindPackagePrefix as FindPackagePrefix
from launch_ros.substitutions.find_package import FindPackageShare as FindPackageShare
from launch_ros.substitutions.parameter import Parameter as Parameter
