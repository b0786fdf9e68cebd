"""Tests of worms and worm wheels."""
