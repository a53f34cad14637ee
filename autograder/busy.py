"""What is raised where grades cannot be recorded now; the pipeline and the gradebook both know it."""


class BusyError(OSError):
    """Another program is at the gradebook. What is judged is kept, and a later run goes on."""
