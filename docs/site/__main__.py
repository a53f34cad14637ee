"""python -m docs.site FOLDER: writes the pages into the folder; every warning of Sphinx is an error."""

import argparse
import shutil
import sys
import tempfile
from pathlib import Path

from sphinx.cmd.build import build_main

from docs.site.frames import write_controls
from docs.site.sources import HERE, lay_out

PICTURES = 1400  # of a control, at most


def main(folder: Path, pictures: int) -> int:
    """Writes the site; returns Sphinx's exit code, 0 where it has nothing to complain of."""
    with tempfile.TemporaryDirectory() as work:
        source, controls = (Path(work).resolve() / name for name in ("source", "controls"))
        lay_out(source)
        write_controls(source / "lessons", controls, pictures)
        shutil.rmtree(folder, ignore_errors=True)
        settings = ["-c", str(HERE), "-d", f"{work}/doctrees", "-q", "-W", "--keep-going"]
        settings += ["-D", f"controls_folder={controls}"]
        return build_main(["-b", "html", *settings, str(source), str(folder)])


if __name__ == "__main__":
    parser = argparse.ArgumentParser(prog="python -m docs.site", description=main.__doc__)
    parser.add_argument("folder", type=Path)
    parser.add_argument(
        "--pictures", type=int, default=PICTURES, help="of each control, at most (%(default)s)"
    )
    sys.exit(main(**vars(parser.parse_args())))
