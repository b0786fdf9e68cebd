"""Tests of chains and sprockets."""
