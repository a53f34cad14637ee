"""Which sentences of a verdict speak of an error that is only carried on."""

from autograder.problems import check_here


def is_carried_on(check: str, sentence: str) -> bool:
    """Whether a sentence on the answer to this check says that the mistake is in an earlier one."""
    known = check_here(check)
    return known is not None and any(sentence.startswith(one.sentence) for one in known.follows)
