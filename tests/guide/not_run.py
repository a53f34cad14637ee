"""Commands of the pages that no session here runs, each with the reason, or the test that does."""

REGISTRY = "it installs packages from a registry: .ci/run and `make` do so before each test"
WINDOW = "it opens a browser's window and does not end: tests/autograder/test_lab.py starts it"
MARKS = "it does not end by itself: tests/browser/test_marking.py marks with it in a browser"
SENDS = "it needs a platform, and .[lti]: tests/autograder/lti/test_scores.py has both"
NEW = "it adds to the repository: tests/new/test_new.py does so in a copy"
WHOLE = "it runs all tests, this one among them"

REASONS = {
    "make lab": WINDOW,
    "autograder lab": WINDOW,
    "autograder lab --instructor": WINDOW,
    "autograder mark p3-pendulum": MARKS,
    "autograder mark p3-pendulum --second": MARKS,
    "autograder mark --port 8899 --no-browser": MARKS,
    'python -m pip install -c constraints.txt -e ".[lti]"': REGISTRY,
    "autograder lti key": SENDS,
    "autograder lti send p3-pendulum --dry-run": SENDS,
    "autograder lti send p3-pendulum": SENDS,
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
    "nowhere --report report.json "
    'appnope colorama pywinpty ".[browser,dev,hub,lti,peers,site]"': REGISTRY,
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
    ".venv/bin/python -m tests.notebooks.course_map docs/course-map.md": "it changes the repository: "
    "tests/notebooks/test_course_map.py compares what it writes",
    '.venv/bin/python -m tests.new.problem p6-crane "The crane" '
    "lessons/10-state-space-and-simulation.ipynb#10-state": NEW,
    '.venv/bin/python -m tests.new.lesson the-crane "The crane"': NEW,
    ".venv/bin/python tests/notebooks/change_lessons.py lessons/NN-title.ipynb": "it takes minutes: "
    "tests/notebooks/test_change_lessons.py changes a small lesson",
}
