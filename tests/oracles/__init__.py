"""Independent oracles: they share no code with the product."""
