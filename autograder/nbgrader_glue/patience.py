"""How long Validate waits for a cell, on a student's side and on the graders'."""

# For `Execute`, by which Validate runs each cell, s by the clock. nbgrader's own 30 are too few where a
# whole class shares a server.
VALIDATE_SECONDS = 120
