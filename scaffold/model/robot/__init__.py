"""What describes a robot: URDF and xacro files, and the bridge to its simulation."""
