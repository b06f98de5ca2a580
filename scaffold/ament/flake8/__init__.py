"""The verdict of ament_flake8: flake8 and its plugins on Jazzy."""
