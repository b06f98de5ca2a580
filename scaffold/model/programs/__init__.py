"""What the programs of a package do when they run."""
