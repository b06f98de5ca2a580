"""What launch files do not use, and where else it is named."""
