"""Type checking of ROS code: stubs for libraries and interfaces, and the type checker."""
