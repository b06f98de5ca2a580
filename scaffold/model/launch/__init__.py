"""Launch files, in Python, XML and YAML."""
