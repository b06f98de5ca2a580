"""A Python file as flake8 and pydocstyle tokenize it."""
