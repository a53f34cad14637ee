"""What a student's notebook calls: `check`, `hint` and `look_at`."""
