"""Commands of the pages that no session here runs, each with the reason, or the test that does."""

REGISTRY = "it installs packages from a registry: .ci/run and `make` do so before each test"
WINDOW = "it opens a browser's window and does not end: tests/autograder/test_lab.py starts it"
WHOLE = "it runs all tests, this one among them"

REASONS = {
    "make lab": WINDOW,
    "autograder lab": WINDOW,
    "autograder lab --instructor": WINDOW,
    "autograder problems": "tests/autograder/test_cli.py does",
    "make test": WHOLE,
    "pytest --nbval --numprocesses=auto --dist=loadfile tests lessons solutions": WHOLE,
    "ruff check && ruff format --check && mypy": "`make test` does, before it runs this test",
    "python -m venv .venv": REGISTRY,
    "source .venv/bin/activate": "it changes a shell, and nothing else",
    'pip install -c constraints.txt -e ".[lab]"': REGISTRY,
    'pip install -c constraints.txt -e ".[test]"': REGISTRY,
    'pip install -c constraints.txt -e ".[browser]"': REGISTRY,
    "pip install --dry-run --ignore-installed --only-binary=:all: --python-version 3.11.0 --target "
    'nowhere --report report.json appnope colorama pywinpty ".[browser,dev,hub,peers,site]"': REGISTRY,
    "make site": "tests/browser/test_site.py does, where .[site] is installed",
    "make book": "tests/test_book.py makes one, where .[site] is installed",
    "make browser": "tests/browser/test_in_browser.py does, where Pyodide is at hand",
    "python -m docs.browser build/browser p1-inertia p3-pendulum": "the same, as `make browser`",
    "autograder bundle p3-pendulum": "tests/autograder/bundle/test_student.py makes one and uses it",
    "autograder bundle p1-inertia p3-pendulum": "the same",
    "autograder try cart-pole": "it takes a minute: tests/autograder/mutation/test_trial.py tries it",
    "autograder try block": "tests/test_readme.py tries the mechanism of this page",
    "python3 -m tests.class_server.document /opt/armdyn-ci | bash -eu": "as root, by .ci/run",
    "ARMDYN_CLASS_SERVER=/opt/armdyn-ci .venv/bin/python -m pytest tests/class_server": "by .ci/run",
    ".venv/bin/python -m tests.autograder.mutation.said tests/autograder/mutation/said.txt": "it "
    "changes the repository: tests/autograder/mutation/test_said.py compares what it writes",
    ".venv/bin/python tests/notebooks/change_lessons.py lessons/NN-title.ipynb": "it takes minutes: "
    "tests/notebooks/test_change_lessons.py changes a small lesson",
}
