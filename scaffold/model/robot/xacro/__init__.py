"""Static expansion of xacro files."""
