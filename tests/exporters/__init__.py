"""Tests of ``exporters``: files measured from outside, negative controls, and the command."""
