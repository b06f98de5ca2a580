"""A ROS 2 package as data: parsed, never imported or run."""
