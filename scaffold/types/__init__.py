"""Types of what ROS programs call: stubs of the libraries and of the interfaces."""
