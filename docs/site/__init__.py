"""The course as static pages: `python -m docs.site build/site`, or `make site`."""
