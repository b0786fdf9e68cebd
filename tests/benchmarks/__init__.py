"""Measurements that are run on demand and never fail on time."""
