"""The I codes of flake8-import-order."""
