"""Static evaluation of launch files: conditions, configurations and paths."""
