"""The verdict of ament_pep257: pydocstyle on Jazzy."""
