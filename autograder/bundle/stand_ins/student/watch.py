"""`watch` needs the right equations, which a student's package does not have."""

from autograder.problems import known_check


def watch(id: str | None = None) -> None:
    """Say so. UnknownCheckError where no check has this id."""
    check = known_check(id)
    print(
        f"watch compares your {check.name} with the right equations, and they are not in this package. "
        f'worst_case("{check.id}") gives the arguments of the worst case, to work with.'
    )
