"""Robot descriptions: URDF and xacro files, and ros_gz_bridge configurations."""
