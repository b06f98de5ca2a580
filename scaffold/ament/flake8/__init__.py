"""Reimplementation of ament_flake8: flake8 and its plugins, as on Jazzy."""
