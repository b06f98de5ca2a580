"""``add``: adds parts and extras to an existing package."""
