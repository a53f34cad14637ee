"""What a student's notebook calls."""
