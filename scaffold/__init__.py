"""ros2-scaffold: generate, lint, fix, build and observe ROS 2 Python packages."""

__version__ = "0.1.0"
