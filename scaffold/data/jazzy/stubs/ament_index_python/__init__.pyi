# Made by scripts/make_stubs.py from ament_index_python 1.8.1 of ROS 2 Jazzy; do not edit.
from .constants import RESOURCE_INDEX_SUBFOLDER as RESOURCE_INDEX_SUBFOLDER
from .packages import get_package_prefix as get_package_prefix
from .packages import get_package_share_directory as get_package_share_directory
from .packages import get_package_share_path as get_package_share_path
from .packages import get_packages_with_prefixes as get_packages_with_prefixes
from .packages import PackageNotFoundError as PackageNotFoundError
from .resources import get_resource as get_resource
from .resources import get_resource_types as get_resource_types
from .resources import get_resources as get_resources
from .resources import has_resource as has_resource
from .resources import InvalidResourceNameError as InvalidResourceNameError
from .resources import InvalidResourceTypeNameError as InvalidResourceTypeNameError
from .search_paths import get_search_paths as get_search_paths
