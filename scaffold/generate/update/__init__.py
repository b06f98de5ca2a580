"""Updates a package to the current templates."""
