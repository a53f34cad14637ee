"""The course as a site that runs in the browser: `python -m docs.browser build/browser`, or `make browser`."""
