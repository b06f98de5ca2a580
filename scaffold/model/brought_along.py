"""What known packages bring along: their own dependencies, which a manifest may leave out.

From the manifests of ROS 2 Jazzy, as far as Python code or launch files can see it; a package that
is not here brings along nothing that is known.
"""

from __future__ import annotations

PROVIDES = {
    "launch_ros": "launch ament_index_python rclpy composition_interfaces lifecycle_msgs "
    "osrf_pycommon python3-yaml",
    "launch_testing": "launch ament_index_python osrf_pycommon python3-pytest",
    "launch_testing_ament_cmake": "launch_testing launch python3-pytest ament_cmake_test",
    "launch_testing_ros": "launch_ros launch launch_testing ament_index_python rclpy "
    "python3-pytest",
    "launch_xml": "launch",
    "launch_yaml": "launch",
    "launch_pytest": "launch launch_testing osrf_pycommon python3-pytest",
    "rclpy": "ament_index_python builtin_interfaces rcl_interfaces action_msgs service_msgs "
    "lifecycle_msgs rosgraph_msgs rpyutils unique_identifier_msgs type_description_interfaces "
    "python3-yaml",
    "common_interfaces": "actionlib_msgs builtin_interfaces diagnostic_msgs geometry_msgs nav_msgs "
    "sensor_msgs shape_msgs std_msgs std_srvs stereo_msgs trajectory_msgs visualization_msgs",
    "ament_cmake": "ament_cmake_core ament_cmake_python ament_cmake_test ament_cmake_version",
    "rclcpp": "ament_index_cpp builtin_interfaces libstatistics_collector rcl rcl_interfaces "
    "rcl_yaml_param_parser rcpputils rcutils rmw rosgraph_msgs statistics_msgs tracetools",
    "rclcpp_action": "action_msgs rcl rcl_action rclcpp rcpputils",
    "rclcpp_components": "ament_index_cpp class_loader composition_interfaces rclcpp",
    "rclcpp_lifecycle": "lifecycle_msgs rcl rcl_interfaces rcl_lifecycle rclcpp rcutils rmw",
    "tf2_eigen": "geometry_msgs tf2 tf2_ros",
    "tf2_geometry_msgs": "geometry_msgs python3-numpy tf2 tf2_ros tf2_ros_py",
    "tf2_sensor_msgs": "geometry_msgs python3-numpy sensor_msgs sensor_msgs_py std_msgs tf2 "
    "tf2_ros tf2_ros_py",
    "std_msgs": "builtin_interfaces",
    "geometry_msgs": "std_msgs builtin_interfaces",
    "sensor_msgs": "std_msgs geometry_msgs builtin_interfaces",
    "nav_msgs": "std_msgs geometry_msgs builtin_interfaces",
    "visualization_msgs": "std_msgs geometry_msgs sensor_msgs builtin_interfaces",
    "trajectory_msgs": "std_msgs geometry_msgs builtin_interfaces",
    "diagnostic_msgs": "std_msgs geometry_msgs builtin_interfaces",
    "ros2cli": "rclpy ament_index_python python3-argcomplete python3-packaging python3-psutil",
    "ros2launch": "launch launch_ros launch_xml launch_yaml ros2cli ros2pkg ament_index_python",
    "ros2pkg": "ament_index_python ros2cli",
    "ros_testing": "launch_testing launch_testing_ament_cmake launch_testing_ros ros2test",
    "ament_cmake_ros": "ament_cmake ament_cmake_gtest ament_cmake_gmock ament_cmake_pytest "
    "domain_coordinator",
    "ament_cmake_auto": "ament_cmake ament_cmake_gtest ament_cmake_gmock ament_cmake_python",
    "ament_cmake_pytest": "python3-pytest",
    "autoware_cmake": "ament_cmake ament_cmake_auto ament_lint_auto ament_cmake_python",
    "ament_lint_common": "ament_cmake_copyright ament_cmake_cppcheck ament_cmake_cpplint "
    "ament_cmake_flake8 ament_cmake_lint_cmake ament_cmake_pep257 ament_cmake_uncrustify "
    "ament_cmake_xmllint ament_copyright ament_flake8 ament_pep257 ament_xmllint",
    "ament_cmake_copyright": "ament_copyright",
    "ament_cmake_flake8": "ament_flake8",
    "ament_cmake_pep257": "ament_pep257",
    "ament_cmake_mypy": "ament_mypy",
    "ament_cmake_xmllint": "ament_xmllint",
    "tf2_ros": "tf2_ros_py tf2 tf2_py tf2_msgs geometry_msgs builtin_interfaces message_filters "
    "rclcpp rclcpp_action rclcpp_components rclpy std_msgs",
    "tf2_ros_py": "tf2_py tf2_msgs geometry_msgs builtin_interfaces rclpy sensor_msgs std_msgs",
    "cv_bridge": "ament_index_python rclcpp rcpputils sensor_msgs python3-numpy python3-opencv",
    "sensor_msgs_py": "sensor_msgs python3-numpy",
    "nav2_amcl": "geometry_msgs message_filters nav2_msgs nav2_util nav_msgs sensor_msgs std_srvs "
    "tf2_geometry_msgs tf2_ros",
    "nav2_behaviors": "geometry_msgs nav2_core nav2_costmap_2d nav2_msgs nav2_util std_msgs "
    "tf2_geometry_msgs tf2_ros",
    "nav2_bringup": "launch_ros nav2_common navigation2 ros_gz_bridge ros_gz_sim slam_toolbox "
    "diff_drive_controller joint_state_broadcaster xacro",
    "nav2_common": "launch launch_ros osrf_pycommon python3-yaml rclpy",
    "nav2_costmap_2d": "geometry_msgs laser_geometry map_msgs message_filters nav2_msgs nav2_util "
    "nav_msgs sensor_msgs std_msgs std_srvs tf2_geometry_msgs tf2_ros tf2_sensor_msgs "
    "visualization_msgs",
    "nav2_lifecycle_manager": "diagnostic_updater geometry_msgs lifecycle_msgs nav2_msgs nav2_util "
    "std_srvs",
    "nav2_map_server": "launch_ros lifecycle_msgs nav2_msgs nav2_util nav_msgs std_msgs tf2_ros",
    "nav2_msgs": "action_msgs builtin_interfaces geographic_msgs geometry_msgs nav_msgs std_msgs",
    "nav2_simple_commander": "rclpy geometry_msgs nav2_msgs action_msgs lifecycle_msgs",
    "nav2_util": "bond builtin_interfaces geometry_msgs lifecycle_msgs nav2_msgs nav_msgs "
    "rcl_interfaces rclcpp rclcpp_action rclcpp_lifecycle std_msgs tf2_geometry_msgs tf2_msgs "
    "tf2_ros",
    "nav2_velocity_smoother": "geometry_msgs nav2_util",
    "navigation2": "nav2_amcl nav2_behaviors nav2_costmap_2d nav2_lifecycle_manager "
    "nav2_map_server nav2_msgs nav2_simple_commander nav2_util nav2_velocity_smoother",
    "slam_toolbox": "interactive_markers message_filters nav2_map_server nav_msgs sensor_msgs "
    "std_msgs std_srvs tf2_geometry_msgs tf2_ros tf2_sensor_msgs visualization_msgs",
    "robot_localization": "diagnostic_msgs diagnostic_updater geographic_msgs geometry_msgs "
    "message_filters nav_msgs sensor_msgs std_msgs std_srvs tf2_geometry_msgs tf2_ros",
    "controller_manager": "controller_interface controller_manager_msgs diagnostic_updater "
    "hardware_interface launch launch_ros launch_testing_ros rclcpp ros2param ros2run std_msgs "
    "python3-filelock python3-yaml",
    "ros2_control": "controller_interface controller_manager controller_manager_msgs "
    "hardware_interface joint_limits ros2controlcli",
    "ros2controlcli": "controller_manager controller_manager_msgs rcl_interfaces rclpy ros2cli "
    "ros2node ros2param rosidl_runtime_py",
    "ros2param": "rcl_interfaces rclpy ros2cli ros2node ros2service",
    "ros2run": "ros2cli ros2pkg",
    "ros2topic": "python3-numpy python3-yaml rclpy ros2cli rosidl_runtime_py",
    "diagnostic_aggregator": "diagnostic_msgs rclcpp rclpy std_msgs",
    "diagnostic_updater": "diagnostic_msgs rclcpp rclpy std_msgs",
    "py_trees_ros": "geometry_msgs py_trees py_trees_ros_interfaces rcl_interfaces rclpy ros2topic "
    "sensor_msgs std_msgs tf2_ros_py unique_identifier_msgs",
    "realsense2_camera": "builtin_interfaces cv_bridge diagnostic_updater geometry_msgs "
    "image_transport launch_ros realsense2_camera_msgs sensor_msgs std_msgs tf2_ros",
    "depth_image_proc": "cv_bridge image_geometry image_transport message_filters sensor_msgs "
    "stereo_msgs tf2_ros",
    "image_proc": "cv_bridge geometry_msgs image_geometry image_transport sensor_msgs",
    "image_transport": "message_filters rclcpp sensor_msgs",
    "camera_calibration": "cv_bridge image_geometry message_filters python3-opencv rclpy "
    "sensor_msgs std_srvs",
    "usb_cam": "builtin_interfaces cv_bridge python3-pydantic sensor_msgs std_msgs std_srvs",
    "pcl_ros": "geometry_msgs pcl_conversions rclcpp sensor_msgs tf2_geometry_msgs tf2_ros",
    "moveit_servo": "control_msgs controller_manager geometry_msgs moveit_configs_utils "
    "moveit_msgs sensor_msgs std_msgs std_srvs tf2_ros trajectory_msgs",
    "ros_gz": "ros_gz_bridge ros_gz_image ros_gz_sim",
    "ros_gz_bridge": "actuator_msgs geometry_msgs gps_msgs launch launch_ros nav_msgs "
    "ros_gz_interfaces rosgraph_msgs sensor_msgs std_msgs tf2_msgs trajectory_msgs vision_msgs",
    "ros_gz_image": "image_transport ros_gz_bridge sensor_msgs",
    "ros_gz_sim": "ament_index_python launch launch_ros rclcpp std_msgs",
    "rosapi": "builtin_interfaces rcl_interfaces rclpy ros2node ros2param ros2pkg ros2service "
    "ros2topic rosapi_msgs rosbridge_library",
    "rosbridge_library": "python3-bson python3-pil rclpy",
    "rosbridge_server": "python3-tornado python3-twisted rclpy rosapi rosbridge_library "
    "rosbridge_msgs",
    "rqt_gui": "ament_index_python python_qt_binding qt_gui rclpy",
    "rqt_gui_py": "qt_gui rclpy rqt_gui",
    "rqt_py_common": "python_qt_binding qt_gui rclpy",
    "rviz2": "rviz_common rviz_default_plugins",
    "rviz_common": "geometry_msgs message_filters rclcpp sensor_msgs std_msgs std_srvs tf2_ros "
    "urdf",
    "rviz_default_plugins": "geometry_msgs image_transport interactive_markers laser_geometry "
    "map_msgs nav_msgs rviz_common tf2_geometry_msgs tf2_ros visualization_msgs",
    "webots_ros2_driver": "geometry_msgs rclcpp rclpy sensor_msgs std_msgs tf2_geometry_msgs "
    "tf2_ros vision_msgs webots_ros2_msgs",
    "xacro": "ament_index_python python3-yaml",
    "launch_pal": "ament_index_python launch launch_ros python3-jinja2 python3-yaml",
    "moveit_configs_utils": "launch launch_ros launch_param_builder ament_index_python",
}
"""What a declared package declares itself (``exec_depend`` or ``depend``), from their manifests:
a dependency that comes along this way is missing in the manifest, yet present on every robot."""


def provided_by(keys: set[str]) -> set[str]:
    """Return what declared packages bring along, over any number of steps."""
    found: set[str] = set()
    pending = list(keys)
    while pending:
        for key in PROVIDES.get(pending.pop(), "").split():
            if key not in found:
                found.add(key)
                pending.append(key)
    return found
