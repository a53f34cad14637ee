"""Attacks by the notebook itself: its cells, their settings and the outputs they come with."""

import copy

from nbformat.v4 import new_markdown_cell, new_output

from tests.submissions.answers import cell_of
from tests.submissions.attack import GOT, OUTSIDE, attack, cheat
from tests.submissions.p3_pendulum import POINTS, RIGHT


def claims(notebook, name):
    return cell_of(notebook, name).metadata["nbgrader"]


@attack(lost=(), says="p3-M: correct")
def warns_in_the_check(release):
    """Adds code to a grade cell that warns on stderr, which nbgrader scores with zero."""
    notebook = cheat(release, M=RIGHT["M"])
    cell_of(notebook, "p3-M").source += "\nimport warnings; warnings.warn('loud')"
    return notebook


@attack(
    says="The notebook does not define g_vec.",
    fallback="a shell reads all that the instructor may read",
)
def another_language(release):
    """Hands its cell to a shell, with commands that read and write."""
    return cheat(
        release, g_vec="%%bash\ncat /etc/shadow && echo got ${x:-through} the wall\nexit 1"
    )


@attack()
def forged_card(release):
    """Shows a verdict of its own, with a script for the instructor's browser."""
    return cheat(
        release,
        """
from IPython.display import HTML, Javascript
display(HTML("<div class='armdyn-verdict'><script>forged()</script>p3-g_vec: all right</div>"))
display(Javascript("forged()"))
display({"text/html": "<script>forged()</script>", "image/png": '"><script>forged()</script>'}, raw=True)
""",
    )


@attack()
def forged_outputs(release):
    """Comes with the outputs of a perfect run in its cells."""
    notebook = cheat(release)
    for cell in notebook.cells:
        if cell.cell_type == "code":
            data = {"text/plain": "1000000.0", "text/html": "<script>forged()</script>"}
            cell.outputs = [new_output("execute_result", data=data, execution_count=1)]
            cell.execution_count = 1
    return notebook


@attack(says="the nbgrader settings of p3-g_vec had been changed")
def forged_points(release):
    """Claims a million points for a grade cell."""
    notebook = cheat(release)
    claims(notebook, "p3-g_vec")["points"] = 1e6
    claims(notebook, "p3-M")["points"] = float("nan")
    claims(notebook, "p3-C")["points"] = "many"
    claims(notebook, "p3-lagrangian")["points"] = -3
    return notebook


@attack()
def edited_checks(release):
    """Writes a score into the grade cells in place of their checks."""
    notebook = cheat(release)
    for name in POINTS:
        cell_of(notebook, name).source = f"1000000  # check({name!r})"
    return notebook


@attack(says="the nbgrader settings of answer-g_vec had been changed")
def reflagged_cells(release):
    """Makes its answer a grade cell and the grade cell an answer."""
    notebook = cheat(release)
    claims(notebook, "p3-g_vec").update(solution=True, locked=False)
    claims(notebook, "answer-g_vec").update(grade=True, solution=False, points=100)
    claims(notebook, "p3-derivation").update(grade=False)
    return notebook


@attack(says="p3-g_vec was missing; it was put back")
def deleted_checks(release):
    """Deletes the check that it does not pass, and the setup."""
    notebook = cheat(release)
    notebook.cells.remove(cell_of(notebook, "p3-g_vec"))
    notebook.cells.remove(cell_of(notebook, "p3-setup"))
    return notebook


@attack(says="p3-M was there more than once; the last one counts")
def duplicated_cells(release):
    """Copies grade cells it passes, to count more than once, and an answer it does not pass."""
    notebook = cheat(release)
    notebook.cells += [copy.deepcopy(cell_of(notebook, "p3-M")) for _ in range(5)]
    notebook.cells.append(copy.deepcopy(cell_of(notebook, "answer-g_vec")))
    return notebook


@attack(says="The notebook does not define g_vec.")
def reordered_cells(release):
    """Moves the grade cell of g_vec to the top of the notebook."""
    notebook = cheat(release)
    grade_cell = cell_of(notebook, "p3-g_vec")
    notebook.cells.remove(grade_cell)
    notebook.cells.insert(0, grade_cell)
    return notebook


@attack(says="a cell claims to be p3-bonus, which this assignment does not have")
def renamed_cells(release):
    """Renames the grade cell it does not pass, and adds one of its own."""
    notebook = cheat(release)
    extra = copy.deepcopy(cell_of(notebook, "p3-g_vec"))
    extra.metadata["nbgrader"].update(grade_id="p3-bonus", points=1e6)
    claims(notebook, "p3-g_vec")["grade_id"] = "p3-g-vec"
    notebook.cells.append(extra)
    return notebook


@attack(says="p3-g_vec had been made a markdown cell")
def retyped_cells(release):
    """Makes the grade cell text, which a person would have to read."""
    notebook = cheat(release)
    cell = cell_of(notebook, "p3-g_vec")
    cell.cell_type = "markdown"
    del cell["outputs"], cell["execution_count"]
    return notebook


@attack(says="p3-M was there more than once; the last one counts")
def repointed_cells(release):
    """Points the grade cell of g_vec to M, which is right."""
    notebook = cheat(release)
    claims(notebook, "p3-g_vec")["grade_id"] = "p3-M"
    return notebook


@attack()
def broken_claims(release):
    """Comes with nbgrader settings of every wrong kind, checksums among them."""
    notebook = cheat(release)
    for name, checksum in zip(POINTS, (1, 1e6, None, ["a"], {"a": 1}, "x" * 1000), strict=True):
        claims(notebook, name)["checksum"] = checksum
    for cell, wrong in zip(
        notebook.cells, ("p3-M", 1, None, [], {"grade_id": ["p3-M"]}), strict=False
    ):
        if "nbgrader" not in cell.metadata:
            cell.metadata["nbgrader"] = wrong
    return notebook


@attack()
def wrong_kernel(release):
    """Names a kernel and a language that do not exist here."""
    notebook = cheat(release)
    notebook.metadata["kernelspec"] = {"name": "no-such-kernel", "display_name": GOT.title()}
    notebook.metadata["language_info"] = {"name": "cobol"}
    return notebook


@attack()
def great_cell(release):
    """Fifty megabytes: ten in one cell's text, the rest in outputs."""
    notebook = cheat(release)
    notebook.cells[1].source = "x" * 10_000_000
    cell_of(notebook, "answer-M").outputs = [new_output("stream", text="y" * 40_000_000)]
    return notebook


@attack(says="the nbgrader settings of p3-g_vec had been changed")
def task_cells(release):
    """Makes the grade cell a task, which a person marks, and adds tasks worth a fortune."""
    notebook = cheat(release)
    claims(notebook, "p3-g_vec").update(task=True, grade=False, points="1e9")
    for name, points in (("p3-extra", 1e9), ("p3-C", "1e9"), ("p3-M", -1e9)):
        extra = new_markdown_cell("All done.")
        extra.metadata["nbgrader"] = claims(notebook, "p3-g_vec") | {
            "grade_id": name,
            "points": points,
        }
        notebook.cells.insert(0, extra)
    return notebook


@attack(says="p3-g_vec was there more than once; the last one counts")
def whole_notebook_twice(release):
    """Selects all cells, copies and pastes them: each graded cell is there twice."""
    notebook = cheat(release)
    notebook.cells += copy.deepcopy(notebook.cells)
    return notebook


@attack()
def kernel_with_a_command(release):
    """Brings a kernel that is a command, and settings for whoever executes it."""
    notebook = cheat(release)
    command = ["touch", str(OUTSIDE / "written")]
    notebook.metadata["kernelspec"] = {"name": "python3", "display_name": "x", "argv": command}
    notebook.metadata["nbgrader"] = {"grade": True, "points": 1e9}
    notebook.metadata["execute"] = {"timeout": -1, "kernel_name": GOT}
    return notebook


@attack()
def deep_settings(release):
    """Nests a cell's settings, and an attachment, as deep as they can be saved."""
    notebook = cheat(release)
    deep = []
    for _ in range(300):
        deep = [deep]
    notebook.cells[0].metadata["deep"] = deep
    notebook.cells[1].attachments = {"bomb.zip": {"application/zip": "UEsDBA" * 1_000_000}}
    return notebook
