"""Whether `check(…, fresh=True)` can draw fresh cases."""


def refusal() -> str:
    """Why it cannot, as a sentence for the student; "" where it can."""
    return ""
