"""What launch files start: nodes, programs, their parameters and remappings."""
