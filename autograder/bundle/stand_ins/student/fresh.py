"""`check(…, fresh=True)` needs right answers to new cases, which a student's package does not have."""


def refusal() -> str:
    """Why no fresh cases are drawn, as a sentence for the student."""
    return (
        "fresh=True needs the right answers to new cases, and they are not in this package: these are "
        "the fixed cases of the visible check. The grader draws fresh ones when you hand in."
    )
