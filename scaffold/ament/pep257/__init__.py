"""Reimplementation of ament_pep257: pydocstyle, as on Jazzy."""
