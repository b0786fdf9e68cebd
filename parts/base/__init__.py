"""What every kind of part and mate stands on: registries, parts, refusals, texts, schema."""
