"""Shows an output where a student's code runs: in a notebook's cell, or as plain text elsewhere."""


def show(bundle: dict[str, str]) -> None:
    """bundle: the same thing as text/plain and as text/html."""
    try:
        from IPython import get_ipython
        from IPython.display import display
    except ImportError:
        print(bundle["text/plain"])
        return
    if get_ipython() is None:
        print(bundle["text/plain"])
    else:
        display(bundle, raw=True)
