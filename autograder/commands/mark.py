"""Opens a page on which a person marks proofs by their rubric."""

import argparse
import contextlib
import errno
import webbrowser
from pathlib import Path
from urllib.parse import quote

from autograder import arguments as argument
from autograder.commands.assignments import name_of, unknown
from autograder.commands.saying import complain
from autograder.terminal import say, shown_note


def add_to(commands) -> None:
    marking = commands.add_parser(
        "mark", help="open a page on which a person marks proofs by their table of points"
    )
    marking.add_argument(
        "assignment",
        nargs="?",
        type=argument.name,
        help="its name in solutions/, such as p1-inertia (default: a list of all)",
    )
    marking.add_argument(
        "--second",
        action="store_true",
        help="as a second marker, who does not see the first one's points; the first one then "
        "compares the two, and chooses",
    )
    marking.add_argument("--names", action="store_true", help="show who wrote each answer")
    marking.add_argument(
        "--port", type=argument.port, default=0, help="of this machine (default: a free one)"
    )
    marking.add_argument(
        "--no-browser", action="store_true", help="only show the address, which opens the page"
    )
    marking.set_defaults(run=run)


def run(root: Path, given: argparse.Namespace) -> int:
    """Serve the page for marking until Ctrl-C; then say how many answers are left."""
    from autograder.lab import has_display
    from autograder.marking.desk import Desk
    from autograder.marking.kept import Kept
    from autograder.marking.opening import Opening
    from autograder.marking.server import serve
    from autograder.nbgrader_glue import answer_page
    from autograder.nbgrader_glue.by_hand import ByHand
    from autograder.nbgrader_glue.late import settle_course

    to = ""
    try:
        book, kept = ByHand(root), Kept(root)
        desk = Desk(book, kept, given.second, given.names)
        if given.assignment is not None:
            name = name_of(given.assignment)
            if why := unknown(root, name):
                return complain(why)
            cells = [one["cell"] for one in desk.proofs() if one["assignment"] == name]
            if not cells:
                return complain(f"{name} has no answer that a person reads, or is not released yet")
            to = f"mark/{quote(name, safe='')}/{quote(cells[0], safe='')}"
        with Opening(kept.folder()) as opening:

            def ready(address: str) -> None:
                whole = f"{address}&to={to}" if to else address
                say(f"\n    Open {whole}\n    Stop with Ctrl-C\n")
                if not given.no_browser and has_display():
                    webbrowser.open(opening.leading_to(whole))

            with contextlib.suppress(KeyboardInterrupt):
                serve(desk, answer_page.style(), given.port, ready)
        for line in [] if given.second else settle_course(root):
            say(shown_note(line))
        left = desk.left()
    except OSError as error:
        if error.errno == errno.EADDRINUSE:
            return complain(
                f"another program uses port {given.port}: choose another --port, or none"
            )
        return complain(str(error))
    except ValueError as error:
        return complain(str(error))
    say(
        "\n".join(
            ["Left to mark:", *(f"  {line}" for line in left)] if left else ["All are marked."]
        )
    )
    return 0
