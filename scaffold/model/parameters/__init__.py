"""Parameters of a whole package, and its parameter files."""
