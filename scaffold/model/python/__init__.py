"""Python files: names, scopes, and values that are certain."""
