"""A Python file as tokenized by flake8 and pydocstyle."""
