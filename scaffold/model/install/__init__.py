"""What a package installs, and where."""
