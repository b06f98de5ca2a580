"""A Dask cluster: work is handed to its workers, and comes back as it is done."""
