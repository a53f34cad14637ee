"""One submitted notebook, graded: mended where people damage them, run, judged, its outputs written."""
