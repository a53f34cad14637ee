"""What both sides of the exchange share."""

from nbgrader.exchange import default
from nbgrader.utils import check_directory


class Entered(default.Exchange):
    """Asks of the exchange's folder only that one can enter it; nbgrader asks that one can write."""

    def ensure_root(self) -> None:
        if not check_directory(self.root, execute=True):
            self.fail(f"There is no exchange that you can enter at {self.root}.")
