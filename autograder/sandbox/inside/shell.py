"""The shell in which a student's cells run: it takes what JupyterLab's kernel takes.

If a magic or a shell command cannot work here, it is left out, a sentence says why, and the rest of its
cell runs. A function that must return something, as `input` must, raises an error.
"""

import ast
import asyncio
import builtins
import contextvars
import errno
import getpass
import io
import os
import pdb
import re
import socket
import subprocess
import sys
import traceback
from typing import NamedTuple

import inline_figures
import left_out
from IPython.core.displayhook import DisplayHook
from IPython.core.displaypub import DisplayPublisher
from IPython.core.error import UsageError
from IPython.core.interactiveshell import InteractiveShell
from IPython.utils.text import SList
from traitlets import Type
from traitlets.config import Config

CELL_MAGIC = re.compile(r"%%(\w+)")
# The file names of a student's own code: cells, and lines given to magics.
TYPED = ("<ipython-input-", "<timed", "<magic-timeit", "<string>")
NO_NETWORK = (errno.ENETUNREACH, errno.EHOSTUNREACH, errno.ENETDOWN)


def new_shell():
    """The one shell of this process."""
    config = Config()
    config.HistoryManager.enabled = False
    config.InteractiveShell.colors = "nocolor"
    inline_figures.only_pictures()
    shell = RoomShell.instance(config=config)
    shell.user_ns["__name__"] = "__main__"
    return shell


class Shown(NamedTuple):
    """A mime bundle. is_value: whether it is the value of the cell's last expression."""

    data: dict
    display_id: str | None = None
    is_value: bool = False


class Displays(DisplayPublisher):
    """Keeps what a cell displays in `shown`."""

    def __init__(self, *args, **kwargs):
        super().__init__(*args, **kwargs)
        self.shown: list[Shown] = []
        self._clear_first = False

    def publish(self, data, metadata=None, source=None, *, transient=None, update=False, **kwargs):
        if self._clear_first:
            self.clear_output()
        name = (transient or {}).get("display_id")
        if update:
            self.shown[:] = [
                old._replace(data=data) if old.display_id == name else old for old in self.shown
            ]
        else:
            self.shown.append(Shown(data, name))

    def publish_value(self, data):
        self.publish(data)
        self.shown[-1] = self.shown[-1]._replace(is_value=True)

    def clear_output(self, wait=False):
        self._clear_first = wait
        if wait:
            return
        self.shown.clear()
        for stream in (sys.stdout, sys.stderr):
            if isinstance(stream, io.StringIO):
                stream.seek(0)
                stream.truncate()


class Results(DisplayHook):
    """Shows the value of a cell's last expression, and keeps it as `_` and in `Out`."""

    def write_output_prompt(self):
        pass

    def write_format_data(self, format_dict, md_dict=None):
        assert self.shell is not None  # it made this hook
        self.shell.display_pub.publish_value(format_dict)

    def finish_displayhook(self):
        self._is_active = False


class RoomShell(InteractiveShell):
    """An IPython that shows what JupyterLab would show.

    context: keeps context variables, such as NumPy's error state, from cell to cell. running: the
    number of the cell that runs, or ran last. left_out: what was left out of it, and why. errors: those
    that it showed, each as its type, value and traceback in lines.
    """

    displayhook_class = Type(Results)
    display_pub_class = Type(Displays)

    display_pub: Displays

    def __init__(self, *args, **kwargs):
        super().__init__(*args, **kwargs)
        self.context = contextvars.copy_context()
        self.running, self.left_out, self.errors = 0, [], []
        self._loop, self._abandoned = None, []
        self.input_transformers_cleanup.append(self._without_unknown_cell_magic)
        assert self.extension_manager is not None  # it was just made
        self.extension_manager.load_extension("storemagic")
        self.set_hook("show_in_pager", lambda *args, **kwargs: None, 0)

    def move_in(self):
        """Move IPython's files to where the environment says now."""
        self.init_ipython_dir(None)
        self.init_profile_dir(None)

    def init_environment(self):
        os.environ.update(PAGER="cat", GIT_PAGER="cat", PIP_NO_INDEX="1")

    def init_builtins(self):
        super().init_builtins()
        builtins.input = getpass.getpass = _no_input
        sys.breakpointhook = pdb.set_trace = self._pass_over_breakpoint

    def run_line_magic(self, magic_name, line, _stack_depth=1):
        try:
            name = magic_name.removeprefix("%")
            if left_out.refuse_magic(name):
                return None
            if magic_name in ("clear", "cls"):
                return self.display_pub.clear_output()
            if not self.find_line_magic(magic_name):
                known = self.find_cell_magic(name)
                raise left_out.LeftOutError(left_out.NOT_FIRST if known else left_out.UNKNOWN)
            return super().run_line_magic(magic_name, line, _stack_depth + 1)
        except Exception as error:
            self._leave_out(f"%{magic_name} {line}", error)

    def run_cell_magic(self, magic_name, line, cell):
        try:
            return super().run_cell_magic(magic_name, line, cell)
        except Exception as error:
            self._leave_out(f"%%{magic_name} {line}", error)

    def system_piped(self, cmd):
        cmd = self.var_expand(cmd, depth=1)
        try:
            left_out.refuse_what_cannot_work(cmd)
            ended = subprocess.run(
                cmd,
                shell=True,
                stdin=subprocess.DEVNULL,
                stdout=subprocess.PIPE,
                stderr=subprocess.STDOUT,
                errors="replace",
            )
        except Exception as error:
            self._leave_out(f"!{cmd}", error)
        else:
            sys.stdout.write(ended.stdout)
            self.user_ns["_exit_code"] = ended.returncode

    system = system_piped

    def getoutput(self, cmd, split=True, depth=0):
        try:
            left_out.refuse_what_cannot_work(self.var_expand(cmd, depth=depth + 1))
            return super().getoutput(cmd, split, depth + 1)
        except Exception as error:
            self._leave_out(f"!{cmd}", error)
            return SList() if split else ""

    def ask_exit(self):
        self._leave_out("exit", left_out.LeftOutError("the cells below it are graded as well"))

    def _pass_over_breakpoint(self, *args, **kwargs):
        self._leave_out("breakpoint()", left_out.LeftOutError(left_out.MAGICS["debug"]))

    def enable_gui(self, gui=None):
        """There are no windows."""

    def enable_matplotlib(self, gui=None):
        return super().enable_matplotlib("inline")

    def should_run_async(self, raw_cell, **known):
        """A cell finds a running event loop, as in a kernel; a cell that another cell runs does not."""
        if asyncio._get_running_loop() is None:
            return True
        return super().should_run_async(raw_cell, **known)

    @property
    def loop_runner(self):
        return self._in_loop

    @loop_runner.setter
    def loop_runner(self, runner):
        """Ignore what `%autoawait` sets, as a kernel does."""

    def _in_loop(self, cell):
        if self._loop is None or self._loop.is_closed():
            self._loop = asyncio.new_event_loop()
            asyncio.set_event_loop(self._loop)
        task = self._loop.create_task(cell, context=self.context)
        try:
            return self._loop.run_until_complete(task)
        finally:
            # At its time limit: it must not go on while the next cell runs.
            if not task.done() or self._loop.is_running():
                asyncio._set_running_loop(None)
                self._abandoned.append((self._loop, task))
                self._loop = None

    def _without_unknown_cell_magic(self, lines):
        """Leave out an unknown cell magic, and run the cell below it if that is Python."""
        magic = CELL_MAGIC.match(lines[0]) if lines else None
        if magic is None or self._is_cell_magic(magic[1]):
            return lines
        call = f"get_ipython().run_line_magic({'%' + magic[1]!r}, {lines[0][magic.end() :].strip()!r})\n"
        try:
            ast.parse(self.transform_cell("".join(lines[1:])))
        except Exception:
            return [call]
        return [call, *lines[1:]]

    def _is_cell_magic(self, name):
        return name not in left_out.MAGICS and self.find_cell_magic(name) is not None

    def _leave_out(self, line, error):
        """Say why a line does nothing; but an error in the student's own code is shown as one."""
        at = error.__traceback__
        while at is not None and not at.tb_frame.f_code.co_filename.startswith(TYPED):
            at = at.tb_next
        if at is not None:
            self.showtraceback((type(error), error, at), tb_offset=0)
            return
        known = isinstance(error, UsageError | left_out.LeftOutError)
        why = f"{error}" if known else f"{type(error).__name__}: {error}"
        self.left_out.append(f"{line.strip()} was left out: {why}")

    def begin(self):
        """Forget what the last cell showed."""
        self.running = self.execution_count
        self.left_out, self.errors, self.display_pub.shown = [], [], []

    def _showtraceback(self, etype, evalue, stb):
        self.errors.append((etype, evalue, stb))

    def is_below_magic(self, source):
        """Whether a magic runs the cell, so that an error which stops it is only shown."""
        magic = CELL_MAGIC.match(source.lstrip())
        return magic is not None and self._is_cell_magic(magic[1])

    def typed_lines(self, error, source, other_cell):
        """Where an error comes from: the number of the line at which it stopped the running cell, and
        the last line of the student's own that led to it, with its cell where that is another one, as
        `other_cell` names it by a function; 0 and "" where they cannot be known.
        """
        above = int(self.is_below_magic(source))
        # `%%capture` runs what is below it as a cell of its own, and `%%time` as a file of this name.
        cells = tuple(f"<ipython-input-{self.running + more}-" for more in range(above + 1))
        cells += ("<timed",) * above
        typed = []
        for frame in traceback.extract_tb(error.__traceback__):
            if not frame.filename.startswith(TYPED) or "run_cell_magic(" in (frame.line or ""):
                continue
            here = frame.filename.startswith(cells)
            number = (frame.lineno or 0) + (above if here else 0)
            text = "".join(source.split("\n")[number - 1 : number]) if here else frame.line
            is_other = not here and frame.filename.startswith(TYPED[0])
            cell = f"{other_cell(frame.name)}, " if is_other else ""
            typed.append((here, number, text, cell))
        at = next((number for here, number, *_ in typed if here), 0)
        _, number, text, cell = typed[-1] if typed else (False, 0, "", "")
        return at, f"{cell}line {number}: {text.strip()}" if text else ""


def _no_input(*prompt, **options):
    raise RuntimeError(left_out.INPUT)


def needed_network(error) -> bool:
    """Whether the error, or one that led to it, arose because there is no network."""
    for _ in range(10):  # a chain of errors may be a ring
        reason = getattr(error, "reason", None)  # urllib keeps it there
        for one in (error, reason):
            if isinstance(one, socket.gaierror) or getattr(one, "errno", None) in NO_NETWORK:
                return True
        error = error.__cause__ or error.__context__
        if error is None:
            break
    return False
