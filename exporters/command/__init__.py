"""The command and what it prints."""
