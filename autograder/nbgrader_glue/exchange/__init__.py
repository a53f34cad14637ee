"""nbgrader's exchange, closed between students who have accounts of their own on one machine.

With nbgrader's own, everybody may write to the exchange and to each hand-in, whose name is all that
hides it. Here a hand-in belongs to the student and to the group of the folder `inbound`, which is the
graders', and nobody else can open it.

Importing this package does not import nbgrader. A student's package has the students' side alone.
"""

# For `ExchangeFactory`: our parts by nbgrader's names.
OF_STUDENTS = {
    name: f"autograder.nbgrader_glue.exchange.students.{ours}"
    for name, ours in {
        "fetch_assignment": "FetchAssignment",
        "fetch_feedback": "FetchFeedback",
        "list": "List",
        "submit": "Submit",
    }.items()
}
OF_GRADERS = {
    name: f"autograder.nbgrader_glue.exchange.graders.{ours}"
    for name, ours in {
        "collect": "Collect",
        "release_assignment": "ReleaseAssignment",
        "release_feedback": "ReleaseFeedback",
    }.items()
}
