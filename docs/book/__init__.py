"""The course as one PDF, set by Typst: `python -m docs.book build/armdyn.pdf`, or `make book`."""
