"""Takes hand-ins out of what a learning platform hands out, and puts marks into what it takes in.

What is said of the platforms was read in their sources: Moodle 4 and 5 (mod/assign: classes/downloader,
gradingtable, feedback/offline and feedback/file) and Canvas (lib: content_zipper, gradebook_exporter and
gradebook_importer).
"""
