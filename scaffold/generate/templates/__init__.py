"""Templates: their declaration and rendering."""
