"""Templates: what they declare, and how they are rendered."""
