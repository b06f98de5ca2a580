"""The workspace around a package, and packages known to this machine."""
