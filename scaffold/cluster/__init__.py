"""Distribution of work over a Dask cluster."""
