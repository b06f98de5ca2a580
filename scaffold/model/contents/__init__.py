"""What the files of a package say together: its requirements, imports, names and interfaces."""
