"""The kinds of files: a row each, its writer and its reader."""
