"""How cases become jobs: batches, shards, and what a run of the workflow shows."""
