.PHONY: help rehearse lab test test-all coverage lint hooks lessons bench site book browser installed
.SUFFIXES:

ARGS =
# CI has the libraries that armdyn is compared with, and those that make the sites; elsewhere the tests that
# need them are skipped.
comma := ,
TESTED := $(if $(CI),test$(comma)peers$(comma)site$(comma)browser,test)
LOG := .venv/install.log

help:
	@echo 'make lab       open JupyterLab on the first lesson; ARGS="--port=8899" goes to JupyterLab'
	@echo 'make test      ruff, mypy, pytest; every lesson and solution is run again; ARGS="-k chain"'
	@echo 'make test-all  the same, and long tests that only repeat what short ones show'
	@echo 'make coverage  which lines the tests run; fails below the floor in pyproject.toml'
	@echo 'make rehearse  200 students through eight assignments, against a ledger; ARGS=60 for fewer'
	@echo 'make hooks     have git run "make lint" before each commit'
	@echo 'make bench     time library, ports, grading and feedback; writes docs/benchmarks.md'
	@echo 'make lessons   run the lessons, store their outputs; writes docs/course-map.md, references.md'
	@echo 'make site      the course as static pages, in build/site; open build/site/index.html'
	@echo 'make book      the course as one PDF, build/armdyn.pdf'
	@echo 'make browser   the course as a site that runs in the browser, in build/browser; ARGS=p3-pendulum'
	@echo 'PYTHON=/path/to/python3 chooses the Python of .venv'

lab: .venv/lab.done
	@.venv/bin/autograder problems
	@.venv/bin/autograder lab $(ARGS)

# One run of pytest for all, on as many cores as there are: a part that fails keeps no other from running.
test: .venv/$(TESTED).done
	@$(lint); \
	.venv/bin/python -m pytest --nbval --numprocesses=auto --dist=loadfile --no-loadscope-reorder \
	  tests lessons solutions $(ARGS) || failed="$$failed pytest"; \
	$(verdict)

test-all:
	@$(MAKE) test ARGS='-m "long or not long" $(ARGS)'

rehearse: .venv/$(TESTED).done
	.venv/bin/python -m tests.rehearsal $(ARGS)

# Slower than `make test`, and without the notebooks: it says what the tests see. One test sends os._exit to
# another process, which coverage's own os._exit does not survive.
coverage: .venv/dev.done
	@.venv/bin/python -m coverage erase
	@failed=; \
	PYTEST_ADDOPTS=--deselect=tests/autograder/pipeline/test_run.py::test_a_process_that_dies_takes_nobody_along \
	.venv/bin/python -m coverage run -m pytest --numprocesses=auto --dist=loadfile --no-loadscope-reorder \
	  tests $(ARGS) || failed=pytest; \
	.venv/bin/python -m coverage combine --quiet && \
	.venv/bin/python -m coverage report || failed="$$failed coverage"; \
	if [ -n "$$failed" ]; then echo "make coverage: failed:" $$failed >&2; exit 1; fi

hooks: .venv/dev.done
	.venv/bin/pre-commit install

lint: .venv/$(TESTED).done
	@$(lint); $(verdict)

# mypy checks the types of armdyn and autograder; pyproject.toml says how. It checks the room's programs by
# themselves, as they import each other, and the protocol, by the names that these have in the room.
INSIDE := autograder/sandbox/inside
lint = failed=; \
	{ .venv/bin/ruff check && .venv/bin/ruff format --check; } || failed=ruff; \
	{ .venv/bin/python -m mypy; outside=$$?; \
	  MYPYPATH=$(INSIDE):autograder:lib .venv/bin/python -m mypy $(INSIDE)/[a-z]*.py && test $$outside = 0; \
	} || failed="$$failed mypy"
verdict = if [ -n "$$failed" ]; then echo "make $@: failed:" $$failed >&2; exit 1; fi

installed: .venv/$(TESTED).done

lessons: .venv/$(TESTED).done
	.venv/bin/python tests/notebooks/store_outputs.py lessons/*.ipynb
	.venv/bin/python -m tests.notebooks.course_map docs/course-map.md
	.venv/bin/python -m tests.notebooks.references docs/references.md

bench: .venv/bench.done
	.venv/bin/python -m tests.benchmarks.library docs/benchmarks.md
	.venv/bin/python -m tests.benchmarks.ports docs/benchmarks.md
	.venv/bin/python -m tests.benchmarks.grading docs/benchmarks.md
	.venv/bin/python -m tests.benchmarks.checks docs/benchmarks.md
	.venv/bin/python -m tests.benchmarks.pictures docs/benchmarks.md

site: .venv/site.done
	.venv/bin/python -m docs.site build/site

book: .venv/site.done
	.venv/bin/python -m docs.book build/armdyn.pdf

browser: .venv/browser.done
	.venv/bin/python -m docs.browser build/browser $(ARGS)

define install
@echo "Installing $(1) into .venv; the first time takes some minutes (log: $(LOG))"
@.venv/bin/python -m pip --disable-pip-version-check install -c constraints.txt -e ".[$(1)]" \
  >$(LOG) 2>&1 || { echo "make: installing failed; is the network there? The reason is at the" \
  "end of $(LOG): $$(grep ERROR $(LOG) | tail -n 1)" >&2; exit 1; }
@touch $@
endef

.venv/lab.done: .venv/path pyproject.toml constraints.txt
	$(call install,lab)

# One after the other, also with -j: two installations into one .venv break each other.
.venv/$(TESTED).done .venv/dev.done .venv/bench.done .venv/site.done .venv/browser.done: .venv/lab.done
	$(call install,$(basename $(@F)))

# An environment knows its own path and its Python: when either has gone, it is made anew.
ifneq ($(shell { test "$$(cat .venv/path)" = "$$(pwd)" && .venv/bin/python -c "" && echo works; } 2>/dev/null),works)
.PHONY: .venv/path
endif

.venv/path:
	@if [ -n "$$PYTHON" ]; then set -- "$$PYTHON"; \
	else set -- python3 python3.13 python3.12 python3.11 python; fi; \
	chosen=; why=; \
	for python do \
	  if ! said=$$("$$python" --version 2>&1); then \
	    why="$${why:-$${PYTHON:+$$python does not run. }}"; \
	  elif ! "$$python" -c 'import sys; sys.exit(sys.version_info < (3, 11))'; then \
	    why="$${why:-$$python is $$said. }"; \
	  elif ! "$$python" -c 'import ensurepip, venv' 2>/dev/null; then \
	    why="$${why:-$$python lacks venv (Debian, Ubuntu: apt install python3-venv). }"; \
	  else chosen=$$python; break; fi; \
	done; \
	if [ -z "$$chosen" ]; then \
	  echo "make: Python 3.11 or newer, with venv, is needed. $${why}Install one, or name it:" \
	    "make lab PYTHON=/path/to/python3" >&2; exit 1; fi; \
	said=$$("$$chosen" -m venv --clear .venv 2>&1) || { \
	  echo "make: $$chosen could not make .venv: $$said" >&2; exit 1; }; \
	pwd >.venv/path
