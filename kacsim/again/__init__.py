"""Files made again from the recipes that they carry, and compared with what they were."""
