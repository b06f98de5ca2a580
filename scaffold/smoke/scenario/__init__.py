"""What an author expects of executables: ``smoke.yaml`` in the package."""
