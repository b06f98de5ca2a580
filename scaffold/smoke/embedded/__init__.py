"""Builds interface packages that the ROS wheels lack, from the bundled definitions."""
