# Made by scripts/make_stubs.py from ament_index_python 1.8.1 of ROS 2 Jazzy; do not edit.
RESOURCE_INDEX_SUBFOLDER: str
AMENT_PREFIX_PATH_ENV_VAR: str
