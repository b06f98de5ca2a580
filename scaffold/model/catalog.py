"""Known ROS names: packages, their transitive dependencies, and rosdep keys."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Mapping

from scaffold.closure import closure
from scaffold.model.released import has_rosdep_rule, is_released, is_rosdep_key

_ROS_PACKAGES = """
ackermann_msgs action_msgs action_tutorials_cpp action_tutorials_interfaces action_tutorials_py
actionlib_msgs actuator_msgs ament_black ament_clang_format ament_clang_tidy ament_cmake
ament_cmake_auto ament_cmake_clang_format ament_cmake_clang_tidy ament_cmake_copyright
ament_cmake_core ament_cmake_cppcheck ament_cmake_cpplint ament_cmake_export_definitions
ament_cmake_export_dependencies ament_cmake_export_include_directories ament_cmake_export_interfaces
ament_cmake_export_libraries ament_cmake_export_link_flags ament_cmake_export_targets
ament_cmake_flake8 ament_cmake_gen_version_h ament_cmake_gmock ament_cmake_google_benchmark
ament_cmake_gtest ament_cmake_include_directories ament_cmake_libraries ament_cmake_lint_cmake
ament_cmake_mypy ament_cmake_pclint ament_cmake_pep257 ament_cmake_pycodestyle ament_cmake_pyflakes
ament_cmake_pytest ament_cmake_python ament_cmake_ros ament_cmake_target_dependencies
ament_cmake_test ament_cmake_uncrustify ament_cmake_vendor_package ament_cmake_version
ament_cmake_xmllint ament_copyright ament_cppcheck ament_cpplint ament_flake8 ament_index_cpp
ament_index_python ament_lint ament_lint_auto ament_lint_cmake ament_lint_common ament_mypy
ament_package ament_pclint ament_pep257 ament_pycodestyle ament_pyflakes ament_uncrustify
ament_xmllint angles apriltag apriltag_msgs apriltag_ros asio_cmake_module async_web_server_cpp
backward_ros behaviortree_cpp bond bondcpp bondpy builtin_interfaces camera_calibration
camera_calibration_parsers camera_info_manager camera_ros cartographer cartographer_ros class_loader
common_interfaces composition composition_interfaces compressed_depth_image_transport
compressed_image_transport console_bridge_vendor control_msgs control_toolbox controller_interface
controller_manager controller_manager_msgs cv_bridge demo_nodes_cpp demo_nodes_cpp_native
demo_nodes_py depth_image_proc depthimage_to_laserscan desktop desktop_full diagnostic_aggregator
diagnostic_common_diagnostics diagnostic_msgs diagnostic_updater diagnostics diff_drive_controller
domain_bridge domain_coordinator dummy_map_server dummy_robot_bringup dummy_sensors dynamixel_sdk
eigen3_cmake_module eigen_stl_containers example_interfaces examples_rclcpp_minimal_publisher
examples_rclpy_executors examples_rclpy_minimal_publisher examples_tf2_py fastcdr fastrtps
fastrtps_cmake_module filters foxglove_bridge foxglove_msgs gazebo_msgs generate_parameter_library
geodesy geographic_msgs geometric_shapes geometry2 geometry_msgs gmock_vendor
google_benchmark_vendor gps_msgs grid_map grid_map_msgs gripper_controllers gtest_vendor
gz_ros2_control hardware_interface iceoryx_binding_c ignition_math6_vendor image_common
image_geometry image_pipeline image_proc image_publisher image_rotate image_tools image_transport
image_transport_plugins image_view imu_complementary_filter imu_filter_madgwick
imu_sensor_broadcaster imu_tools interactive_markers intra_process_demo joint_limits
joint_state_broadcaster joint_state_publisher joint_state_publisher_gui joint_trajectory_controller
joy joy_linux joy_teleop kdl_parser key_teleop keyboard_handler laser_filters laser_geometry
laser_proc launch launch_pytest launch_ros launch_testing launch_testing_ament_cmake
launch_testing_examples launch_testing_ros launch_xml launch_yaml libcurl_vendor
libstatistics_collector libyaml_vendor lifecycle lifecycle_msgs lifecycle_py logging_demo map_msgs
marti_common_msgs mavlink mavros mavros_msgs message_filters micro_ros_msgs mouse_teleop moveit
moveit_common moveit_configs_utils moveit_core moveit_kinematics moveit_msgs moveit_planners
moveit_ros moveit_ros_move_group moveit_ros_planning moveit_ros_planning_interface
moveit_ros_visualization moveit_servo moveit_visual_tools nav2_amcl nav2_behavior_tree
nav2_behaviors nav2_bringup nav2_bt_navigator nav2_collision_monitor nav2_common nav2_controller
nav2_core nav2_costmap_2d nav2_lifecycle_manager nav2_map_server nav2_mppi_controller nav2_msgs
nav2_navfn_planner nav2_planner nav2_regulated_pure_pursuit_controller nav2_rviz_plugins
nav2_simple_commander nav2_smac_planner nav2_smoother nav2_util nav2_velocity_smoother
nav2_voxel_grid nav2_waypoint_follower nav_2d_msgs nav_2d_utils nav_msgs navigation2 nmea_msgs
nmea_navsat_driver novatel_gps_msgs octomap octomap_msgs octomap_ros octomap_server
orocos_kdl_vendor osrf_pycommon osrf_testing_tools_cpp parameter_traits pcl_conversions pcl_msgs
pcl_ros pendulum_control pendulum_msgs perception perception_pcl performance_test_fixture
phidgets_msgs pluginlib point_cloud_transport pointcloud_to_laserscan polygon_msgs
position_controllers py_trees py_trees_ros py_trees_ros_interfaces pybind11_vendor
python_cmake_module python_orocos_kdl_vendor python_qt_binding qt_dotgraph qt_gui qt_gui_app
qt_gui_core qt_gui_cpp qt_gui_py_common quality_of_service_demo_cpp quality_of_service_demo_py
radar_msgs random_numbers range_sensor_broadcaster rcl rcl_action rcl_interfaces rcl_lifecycle
rcl_logging_interface rcl_logging_spdlog rcl_yaml_param_parser rclc rclc_lifecycle rclc_parameter
rclcpp rclcpp_action rclcpp_cascade_lifecycle rclcpp_components rclcpp_lifecycle rclpy
rclpy_message_converter rcpputils rcutils realsense2_camera realsense2_camera_msgs
realsense2_description realtime_tools resource_retriever rmf_building_map_msgs rmw rmw_connextdds
rmw_cyclonedds_cpp rmw_dds_common rmw_fastrtps_cpp rmw_fastrtps_dynamic_cpp rmw_fastrtps_shared_cpp
rmw_implementation rmw_implementation_cmake rmw_zenoh_cpp robot_calibration robot_localization
robot_state_publisher ros2_control ros2_control_test_assets ros2_controllers
ros2_controllers_test_nodes ros2_socketcan ros2action ros2bag ros2cli ros2cli_common_extensions
ros2cli_test_interfaces ros2component ros2controlcli ros2doctor ros2interface ros2launch
ros2launch_security ros2lifecycle ros2multicast ros2node ros2nodl ros2param ros2pkg ros2plugin
ros2run ros2service ros2test ros2topic ros2trace ros_base ros_core ros_environment ros_gz
ros_gz_bridge ros_gz_image ros_gz_interfaces ros_gz_sim ros_image_to_qimage ros_testing
ros_workspace rosapi rosapi_msgs rosbag2 rosbag2_compression rosbag2_cpp rosbag2_interfaces
rosbag2_py rosbag2_storage rosbag2_storage_default_plugins rosbag2_storage_mcap
rosbag2_storage_sqlite3 rosbag2_test_common rosbag2_transport rosbot_localization rosbridge_library
rosbridge_msgs rosbridge_server rosbridge_suite rosgraph_msgs rosidl_adapter rosidl_cli rosidl_cmake
rosidl_core_generators rosidl_core_runtime rosidl_default_generators rosidl_default_runtime
rosidl_dynamic_typesupport rosidl_generator_c rosidl_generator_cpp rosidl_generator_py
rosidl_generator_type_description rosidl_parser rosidl_pycommon rosidl_runtime_c rosidl_runtime_cpp
rosidl_runtime_py rosidl_typesupport_c rosidl_typesupport_cpp rosidl_typesupport_fastrtps_c
rosidl_typesupport_fastrtps_cpp rosidl_typesupport_interface rosidl_typesupport_introspection_c
rosidl_typesupport_introspection_cpp rpyutils rqt rqt_action rqt_bag rqt_bag_plugins
rqt_common_plugins rqt_console rqt_controller_manager rqt_dotgraph rqt_graph rqt_gui rqt_gui_cpp
rqt_gui_py rqt_image_view rqt_joint_trajectory_controller rqt_msg rqt_plot rqt_publisher
rqt_py_common rqt_py_console rqt_reconfigure rqt_robot_monitor rqt_robot_steering
rqt_runtime_monitor rqt_service_caller rqt_shell rqt_srv rqt_tf_tree rqt_topic rtabmap rtabmap_msgs
rtabmap_ros rti_connext_dds_cmake_module rttest rviz2 rviz_assimp_vendor rviz_common
rviz_default_plugins rviz_imu_plugin rviz_ogre_vendor rviz_rendering rviz_visual_tools sensor_msgs
sensor_msgs_py service_msgs shape_msgs shared_queues_vendor simple_launch simulation_interfaces
slam_toolbox smclib sophus spatio_temporal_voxel_layer spdlog_vendor sqlite3_vendor srdfdom sros2
sros2_cmake statistics_msgs std_msgs std_srvs stereo_image_proc stereo_msgs system_modes
tango_icons_vendor teleop_tools teleop_tools_msgs teleop_twist_joy teleop_twist_keyboard
test_interface_files test_msgs tf2 tf2_bullet tf2_eigen tf2_eigen_kdl tf2_geometry_msgs tf2_kdl
tf2_msgs tf2_py tf2_ros tf2_ros_py tf2_sensor_msgs tf2_tools tf_transformations
theora_image_transport tinyxml2_vendor tinyxml_vendor tlsf tlsf_cpp topic_monitor
topic_statistics_demo topic_tools topic_tools_interfaces tracetools tracetools_acceleration
tracetools_launch tracetools_read tracetools_test tracetools_trace trajectory_msgs turtle_tf2_cpp
turtle_tf2_py turtlebot3_msgs turtlesim twist_mux twist_mux_msgs type_description_interfaces
ublox_msgs uncrustify_vendor unique_identifier_msgs ur_client_library ur_msgs urdf urdf_launch
urdf_parser_plugin urdf_tutorial urdfdom urdfdom_headers urdfdom_py usb_cam v4l2_camera
velocity_controllers velodyne velodyne_msgs vision_msgs vision_opencv visualization_msgs
warehouse_ros web_video_server webots_ros2 webots_ros2_driver xacro yaml_cpp_vendor zmqpp_vendor
zstd_vendor
"""

ROS_PACKAGES = frozenset(_ROS_PACKAGES.split())
BUILD_TOOLS = frozenset(
    {"ament_cmake", "ament_cmake_auto", "ament_cmake_python", "ament_cmake_ros"}
    | {"rosidl_default_generators"}
)
"""Packages that are only needed to build others."""

_OTHER_MODULES = {
    "PIL": "python3-pil",
    "PyKDL": "python_orocos_kdl_vendor python3-pykdl orocos_kdl_vendor",
    "PyQt5": "python3-pyqt5 python_qt_binding python3-qt5-bindings",
    "bs4": "python3-bs4",
    "casadi": "casadi-pip",
    "catkin_pkg": "python3-catkin-pkg python3-catkin-pkg-modules",
    "click": "python3-click",
    "cv2": "python3-opencv libopencv-dev cv_bridge vision_opencv",
    "dateutil": "python3-dateutil",
    "em": "python3-empy",
    "evdev": "python3-evdev",
    "fastapi": "python3-fastapi",
    "filelock": "python3-filelock",
    "flask": "python3-flask",
    "geopandas": "python3-geopandas",
    "git": "python3-git",
    "graphviz": "python3-graphviz graphviz",
    "importlib_metadata": "python3-importlib-metadata",
    "importlib_resources": "python3-importlib-resources",
    "jinja2": "python3-jinja2",
    "jsonschema": "python3-jsonschema",
    "lark": "python3-lark-parser",
    "lxml": "python3-lxml",
    "matplotlib": "python3-matplotlib",
    "mock": "python3-mock",
    "moveit": "moveit_py moveit",
    "msgpack": "python3-msgpack",
    "netifaces": "python3-netifaces",
    "networkx": "python3-networkx",
    "numpy": "python3-numpy",
    "open3d": "python3-open3d-pip",
    "osrf_pycommon": "osrf_pycommon python3-osrf-pycommon",
    "packaging": "python3-packaging",
    "paho": "python3-paho-mqtt",
    "pandas": "python3-pandas",
    "pexpect": "python3-pexpect",
    "pkg_resources": "python3-setuptools python3-pkg-resources",
    "psutil": "python3-psutil",
    "py_trees": "py_trees",
    "pydantic": "python3-pydantic",
    "pydot": "python3-pydot",
    "pygame": "python3-pygame",
    "pymap3d": "python3-pymap3d pymap3d-pip",
    "pyproj": "python3-pyproj",
    "pytest": "python3-pytest ament_cmake_pytest",
    "requests": "python3-requests",
    "rosdistro": "python3-rosdistro-modules",
    "rospkg": "python3-rospkg python3-rospkg-modules",
    "scipy": "python3-scipy",
    "serial": "python3-serial",
    "setuptools": "python3-setuptools",
    "shapely": "python3-shapely",
    "skimage": "python3-skimage",
    "sklearn": "python3-sklearn",
    "smbus": "python3-smbus",
    "smbus2": "python3-smbus2 python3-smbus2-pip",
    "sympy": "python3-sympy",
    "tabulate": "python3-tabulate",
    "tf2_ros": "tf2_ros_py",
    "tkinter": "python3-tk",
    "torch": "python3-torch python3-pytorch-pip",
    "torchvision": "python3-torchvision python3-pytorch-pip",
    "tornado": "python3-tornado",
    "tqdm": "python3-tqdm",
    "transforms3d": "python3-transforms3d tf_transformations",
    "transitions": "python3-transitions",
    "trimesh": "python3-trimesh-pip",
    "typing_extensions": "python3-typing-extensions",
    "urdf_parser_py": "urdfdom_py",
    "usb": "python3-usb",
    "uvicorn": "python3-uvicorn",
    "websocket": "python3-websocket",
    "websockets": "python3-websockets",
    "wx": "python3-wxgtk4.0",
    "yaml": "python3-yaml",
    "zmq": "python3-zmq",
}

_BROUGHT = {
    "casadi-pip": "python3-numpy",
    "python3-cvxpy-pip": "python3-numpy python3-scipy",
    "python3-fastapi": "python3-pydantic",
    "python3-flask": "python3-jinja2 python3-click",
    "python3-flask-cors": "python3-flask",
    "python3-flask-socketio": "python3-flask",
    "python3-flask-sqlalchemy": "python3-flask",
    "python3-geopandas": "python3-pandas python3-pyproj python3-shapely",
    "python3-gtts": "python3-click python3-requests",
    "python3-gymnasium-pip": "python3-numpy python3-typing-extensions",
    "python3-h5py": "python3-numpy",
    "python3-imageio": "python3-numpy python3-pil",
    "python3-matplotlib": "python3-dateutil python3-numpy python3-packaging python3-pil python3-tk",
    "python3-mediapipe-pip": "python3-matplotlib python3-numpy python3-opencv "
    "python3-sounddevice-pip",
    "python3-numba": "python3-numpy python3-scipy",
    "python3-onnxruntime-pip": "python3-numpy python3-packaging python3-sympy",
    "python3-openai-pip": "python3-pydantic python3-tqdm",
    "python3-opencv": "python3-numpy",
    "python3-pandas": "python3-dateutil python3-numpy",
    "python3-pydantic": "python3-typing-extensions",
    "python3-pyqtgraph": "python3-numpy python3-pyqt5",
    "python3-rasterio": "python3-click python3-numpy",
    "python3-requests": "python3-certifi python3-urllib3",
    "python3-scipy": "python3-numpy",
    "python3-seaborn": "python3-matplotlib python3-numpy python3-pandas",
    "python3-shapely": "python3-numpy",
    "python3-skimage": "python3-networkx python3-numpy python3-packaging python3-pil python3-scipy",
    "python3-sklearn": "python3-numpy python3-scipy",
    "python3-stable-baselines3-pip": "python3-gymnasium-pip python3-matplotlib python3-numpy "
    "python3-pandas python3-torch",
    "python3-transformers-pip": "python3-filelock python3-numpy python3-packaging "
    "python3-requests python3-tqdm python3-yaml",
    "python3-transforms3d": "python3-numpy",
    "python3-ultralytics-pip": "python3-matplotlib python3-numpy python3-opencv python3-pandas "
    "python3-pil python3-psutil python3-requests python3-scipy python3-seaborn python3-torch "
    "python3-torchvision python3-tqdm python3-yaml",
    "python3-uvicorn": "python3-click",
}
"""Libraries whose packages depend on or recommend others with rosdep keys."""

ROS1_PACKAGES = {
    "actionlib": "rclpy or rclcpp_action",
    "amcl": "nav2_amcl",
    "catkin": "ament_cmake",
    "cmake_modules": "ament_cmake",
    "dynamic_reconfigure": "ROS 2 parameters (rcl_interfaces)",
    "genmsg": "rosidl_default_generators",
    "gmapping": "slam_toolbox",
    "map_server": "nav2_map_server",
    "message_generation": "rosidl_default_generators",
    "message_runtime": "rosidl_default_runtime",
    "move_base": "nav2_bringup",
    "move_base_msgs": "nav2_msgs",
    "nodelet": "rclcpp_components",
    "robot_pose_ekf": "robot_localization",
    "rosbag": "rosbag2_py",
    "roscpp": "rclcpp",
    "roscpp_serialization": "rclcpp",
    "rosconsole": "rcutils",
    "rosgraph": "rclpy",
    "roslaunch": "launch_ros",
    "roslib": "ament_index_python",
    "roslint": "ament_lint_auto",
    "rosmsg": "ros2interface",
    "rosnode": "ros2node",
    "rosparam": "ros2param",
    "rospy": "rclpy",
    "rosserial": "micro-ROS",
    "rosserial_python": "micro-ROS",
    "rosservice": "ros2service",
    "rostest": "launch_testing",
    "rostime": "rclpy",
    "rostopic": "ros2topic",
    "rosunit": "ament_cmake_pytest",
    "rviz": "rviz2",
    "tf": "tf2_ros",
    "tf_conversions": "tf_transformations",
    "xmlrpcpp": "rclcpp",
}
"""Packages of ROS 1 that ROS 2 does not have, and their replacements."""

OTHER_NAMES = {
    "rclpy_action": "rclpy",
    "rclpy_lifecycle": "rclpy",
}
"""Names that no package ever had, each with the package to name instead."""

LIBRARY_KEYS = {
    "Boost": "boost",
    "Eigen3": "eigen",
    "OpenCV": "libopencv-dev",
    "PCL": "libpcl-all-dev",
    "eigen3": "eigen",
    "nlohmann_json": "nlohmann-json-dev",
    "yaml_cpp": "yaml-cpp",
}
"""Names that CMake and C++ have for libraries, with their rosdep keys."""


def keys_of_module(root: str) -> tuple[str, ...]:
    """Return the manifest keys that provide a Python module, the usual one first.

    Args:
        root: The first part of the imported name.

    Returns:
        Nothing if the module is unknown.
    """
    if root in _OTHER_MODULES:
        return tuple(_OTHER_MODULES[root].split())
    return (root,) if root in ROS_PACKAGES else ()


def library_keys(root: str) -> tuple[str, ...]:
    """Return the rosdep keys that are named after a Python module, as in Debian.

    Args:
        root: The first part of the imported name.
    """
    name = f"{_PYTHON}{root.lower().replace('_', '-')}"
    keys = (name, f"{name}-pip")
    return tuple(key for key in keys if is_rosdep_key(key) and has_rosdep_rule(key))


def keys_brought(keys: Iterable[str]) -> set[str]:
    """Return the keys of the libraries that declared ones depend on.

    Args:
        keys: The declared keys.
    """
    return closure(keys, lambda key: _BROUGHT.get(key, "").split())


def module_keys() -> frozenset[str]:
    """Return the manifest keys that provide Python modules."""
    return frozenset(key for keys in _OTHER_MODULES.values() for key in keys.split())


def similar_key(key: str) -> str | None:
    """Return the key of a Python module closest to a misspelled one, if it is close enough."""
    if not key.startswith(_PYTHON) or key in _OF_DEBIAN or key in module_keys():
        return None
    name = key.removeprefix(_PYTHON)
    candidates = (
        other
        for other in sorted(module_keys())
        if other.startswith(_PYTHON) and is_near(name, other.removeprefix(_PYTHON))
    )
    return next(candidates, None)


_PYTHON = "python3-"
_OF_DEBIAN = frozenset(
    f"{_PYTHON}{name}"
    for name in ("gwebsockets", "network", "opengv", "pykml", "scapy", "simpy", "unicorn")
) | {f"{_PYTHON}websocketd"}
"""Debian packages with names similar to keys."""


def module_of_key(key: str) -> str | None:
    """Return the module of a name of the Python package index, if its rosdep key differs.

    ``numpy`` is such a name: the manifest needs ``python3-numpy``.
    """
    if key in _SYSTEM_KEYS or key in ROS_PACKAGES:
        return None
    for module, keys in _OTHER_MODULES.items():
        is_named = key == module or key.lower() in _INDEX_NAMES.get(module, "").lower().split()
        if is_named and key not in keys.split():
            return module
    return None


_SYSTEM_KEYS = frozenset({"git", "graphviz", "lark", "yaml"})
"""Rosdep keys that look like names of the package index."""

_INDEX_NAMES = {
    "PIL": "pillow",
    "cv2": "opencv-python opencv-python-headless opencv-contrib-python opencv opencv2 opencv4 "
    "python3-cv2",
    "bs4": "beautifulsoup4",
    "git": "GitPython",
    "paho": "paho-mqtt",
    "serial": "pyserial",
    "skimage": "scikit-image",
    "sklearn": "scikit-learn",
    "usb": "pyusb",
    "yaml": "PyYAML",
    "zmq": "pyzmq",
}


def is_near(name: str, other: str) -> bool:
    """Return whether a name is a misspelling of another one; see ``similar_package``."""
    if name == other or len(name) < 5:  # noqa: PLR2004  short names resemble by chance
        return False
    plain = name.replace("-", "").replace("_", "").lower()
    return other.replace("_", "") == plain or is_one_slip(name, other, digits=False)


def similar_package(name: str) -> str | None:
    """Return the known package closest to a misspelled name, if it is close enough.

    A close name has one letter added, missing, changed or swapped, or other separators; no digit
    (``turtlebot4_msgs`` is not ``turtlebot3_msgs``).
    """
    if name in ROS_PACKAGES or is_released(name):
        return None
    plain = name.replace("-", "").replace("_", "").lower()
    candidates = set(_similarity_index()[len(plain), plain])
    for length in range(len(name) - 1, len(name) + 2):
        # Wherever the typo is, one end of the name is right.
        for end in (name[:1] + "*", "*" + name[-1:]):
            candidates.update(_similarity_index()[length, end])
    return next((candidate for candidate in sorted(candidates) if is_near(name, candidate)), None)


_ALIKE: defaultdict[tuple[int, str], list[str]] = defaultdict(list)


def _similarity_index() -> Mapping[tuple[int, str], list[str]]:
    """Index the packages by length with first letter, last letter, or all letters."""
    if not _ALIKE:
        for name in ROS_PACKAGES:
            plain = name.replace("_", "")
            for key in ((len(name), name[0] + "*"), (len(name), "*" + name[-1])):
                _ALIKE[key].append(name)
            _ALIKE[len(plain), plain].append(name)
    return _ALIKE


def is_one_slip(text: str, other: str, *, digits: bool = True) -> bool:
    """Return whether two names differ by one letter or by two adjacent letters swapped.

    Args:
        text: A name.
        other: Another one.
        digits: Whether a changed or additional digit counts as a typo.
    """
    if abs(len(text) - len(other)) > 1:
        return False
    same = 0
    while same < min(len(text), len(other)) and text[same] == other[same]:
        same += 1
    a, b = text[same:], other[same:]
    if len(a) != len(b):
        longer, shorter = (a, b) if len(a) > len(b) else (b, a)
        return longer[1:] == shorter and (digits or not longer[0].isdigit())
    if a[1:] == b[1:]:
        return digits or not (a[:1].isdigit() or b[:1].isdigit())
    return a[:2] == b[1::-1] and a[2:] == b[2:]
