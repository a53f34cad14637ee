"""What a student's notebook calls: `check`, `hint`, `look_at` and `own_arm`."""
