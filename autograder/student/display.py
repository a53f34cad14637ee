"""Shows an output where a student's code runs: in a notebook's cell, or as plain text elsewhere."""

from html import escape

from autograder.judging.passages import filled


def say(sentence: str) -> None:
    """Show it in lines that end between words.

    A notebook would break what is printed anywhere, where its window is narrower than a line.
    """
    show(
        {
            "text/plain": filled(sentence, indent=0),
            "text/html": f'<div class="armdyn-said" style="margin:0.4em 0.8em">{escape(sentence)}</div>',
        }
    )


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
