"""One Python file as flake8 and pydocstyle cut it."""
