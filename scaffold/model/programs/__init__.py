"""The programs of a package: what runs, and how."""
