"""The files that a package installs, and where."""
