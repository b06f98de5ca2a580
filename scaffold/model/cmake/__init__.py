"""CMakeLists.txt."""
