"""setup.py."""
