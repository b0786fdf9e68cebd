"""Parts laid out on boards and beds."""
