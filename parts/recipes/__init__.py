"""Recipes: a few keys of ``[[assemblies]]`` that become parts, instances, mates and drives."""
