"""Python files: names, scopes, and static evaluation."""
