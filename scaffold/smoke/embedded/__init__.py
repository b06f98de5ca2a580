"""What the ROS wheels lack: interfaces that the bundle knows are generated and built."""
