"""The kinds of mates."""
