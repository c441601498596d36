"""McKean's tree of a Maxwell gas, from a value back to the leaves: f and its tails at any time."""
