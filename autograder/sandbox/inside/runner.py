"""Runs a student's cells and answers calls, inside the sandbox.

One request a line on standard input, one reply a line on standard output, both JSON:
{"files": {name: base64}} → {"failed": [names]}, {"run": source} → {"outputs": [...]}, {"ask": [calls]}
→ a {"reply": ...} for each call in turn, up to the first fault. The runner first moves both descriptors,
so that what the student's code prints cannot mix with the replies.
"""

import base64
import json
import os
import random
import resource
import signal
import socket
import sys
import time
from contextlib import suppress

MEMORY_BYTES = 4 << 30
FILE_BYTES = 64 << 20
# No process needs more processor time than a whole notebook may have; a process that hides from the
# watch ends at this limit.
PROCESS_SECONDS = 600
MOST_TEXT = 200_000
MOST_OUTPUTS = 50
MOST_LEFT_OUT = 500  # characters about a line that was left out
MOST_HANDLED = 100  # errors, each raised while the last was handled
# Quick calls are answered together, as waking the judge costs more than a call.
HELD_SECONDS = 0.02
# What a feedback page shows of a student's output. No HTML or JavaScript: it would run in the
# instructor's browser. An SVG is shown as a picture, in which nothing runs.
SHOWN = ("text/plain", "text/latex", "image/png", "image/jpeg", "image/svg+xml")


def main():
    """runner.py [walled] DESCRIPTOR, where the judge talks to the watch on the descriptor's socket."""
    walled = "walled" in sys.argv
    judge = socket.socket(fileno=int(sys.argv[-1]))
    sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
    if walled and os.getuid() == 0:
        import namespaces

        namespaces.become_nobody()
    leave_to_watch(judge, walled)
    serve(walled=walled)


def leave_to_watch(judge, walled):
    """Go on as a child of this process, which watches the room and ends it with the judge."""
    import watch

    linux = sys.platform == "linux"
    if linux:
        import namespaces
    if linux and not walled:
        namespaces.adopt_orphans()
    child = os.fork()
    if child == 0:
        judge.close()
        if linux and not walled:
            namespaces.end_with_parent()
        return
    os.closerange(0, 3)
    if linux:
        namespaces.close_to_tracing()
    watch.Watch(judge, child, walled, reaper=1 if walled else None).until_child_ended()
    if not walled:
        watch.sweep(watch.descendants)
        os.killpg(0, signal.SIGKILL)
    os._exit(0)


def serve(shell=None, walled=False):
    """Answer requests to the end of standard input, in `shell` or a new one.

    walled: whether the kernel counts the user's processes for this room alone, so that a limit on their
    number harms nothing else.
    """
    requests, replies = _private_channel()
    _limit_resources(walled)
    import beside
    import numpy as np
    import protocol
    from shell import new_shell

    random.seed(0)
    shell = shell or new_shell()
    # The same cells draw the same numbers in every room.
    random.seed(0)
    np.random.seed(0)  # noqa: NPY002
    beside.look_in_the_folder()
    _reply(replies, {"ready": True})
    for line in requests:
        request = json.loads(line)
        if "run" in request:
            outputs = _run(shell, request["run"], request["seconds"], protocol)
            _reply(replies, {"outputs": outputs})
        elif "files" in request:
            _reply(replies, {"failed": beside.lay(request["files"])})
        else:
            shell.context.run(_quietly, _answer, request["ask"], shell.user_ns, replies, protocol)


def _private_channel():
    requests = os.fdopen(os.dup(0), encoding="utf-8")
    replies = os.fdopen(os.dup(1), "w", encoding="utf-8")
    nothing = os.open(os.devnull, os.O_RDWR)
    for descriptor in (0, 1, 2):
        os.dup2(nothing, descriptor)
    os.close(nothing)
    return requests, replies


def _limit_resources(walled):
    resource.setrlimit(resource.RLIMIT_FSIZE, (FILE_BYTES, FILE_BYTES))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    resource.setrlimit(resource.RLIMIT_CPU, (PROCESS_SECONDS, PROCESS_SECONDS))
    if sys.platform == "linux":  # macOS refuses a limit on the address space
        resource.setrlimit(resource.RLIMIT_AS, (MEMORY_BYTES, MEMORY_BYTES))
        # When the machine's memory runs out, it is this process that ends.
        with open("/proc/self/oom_score_adj", "w") as file:
            file.write("1000")
    if walled:
        from watch import MOST_PROCESSES

        resource.setrlimit(resource.RLIMIT_NPROC, (MOST_PROCESSES, MOST_PROCESSES))


def _run(shell, source, seconds, protocol):
    """The cell's outputs as a notebook stores them; an error also says at which line it arose, and what
    shows the value of the last expression says so.
    """
    import inline_figures
    from IPython.utils.capture import capture_output

    shell.begin()
    stopped = None
    limit = protocol.time_limit(seconds)
    try:
        with capture_output(display=False) as captured, limit:
            ran = shell.run_cell(source, store_history=True)
            stopped = ran.error_before_exec or ran.error_in_exec
            inline_figures.show_rest()
    except BaseException as error:
        stopped = error
    outputs = [
        {"output_type": "stream", "name": name, "text": protocol.shortened(text, MOST_TEXT)}
        for name, text in (("stdout", captured.stdout), ("stderr", captured.stderr))
        if text
    ]
    for sentence in shell.left_out[:MOST_OUTPUTS]:
        text = protocol.one_line(sentence, MOST_LEFT_OUT)
        outputs.append(
            {"output_type": "stream", "name": "stderr", "text": f"{text}\n", "left_out": text}
        )
    displayed = shell.display_pub.shown
    value = [shown for shown in displayed[MOST_OUTPUTS:] if shown.is_value]
    for shown in [*displayed[:MOST_OUTPUTS], *value]:
        data = {kind: _text(shown.data[kind]) for kind in SHOWN if kind in shown.data}
        output = {"output_type": "display_data", "data": data, "metadata": {}}
        outputs.append(output | ({"value": True} if shown.is_value else {}))
    errors = shell.errors or ([(type(stopped), stopped, [])] if stopped else [])
    if errors and shell.is_below_magic(source):
        stopped = errors[-1][1]
    if limit.error is not None:
        # It may have come again while the first was shown, and code may swallow it and go on.
        errors = [one for one in errors if one[0] is not protocol.TimeLimitError]
        errors.insert(0, (protocol.TimeLimitError, limit.error, []))
        if _comes_of(protocol.TimeLimitError, stopped):
            stopped = limit.error
    # A magic's error is only shown, and the cell goes on, perhaps to an error that stops it.
    told = [*errors[:1], *(error for error in errors[1:] if error[1] is stopped)]
    return outputs + [
        _error(shell, source, kind, value, lines, protocol) | {"stopped": value is stopped}
        for kind, value, lines in told
    ]


def _comes_of(kind, error):
    """Whether an error is of this kind, or was raised while one of it was handled."""
    with suppress(Exception):  # it may be of a student's own class
        for _ in range(MOST_HANDLED):
            if error is None or isinstance(error, kind):
                return error is not None
            error = error.__cause__ or error.__context__
    return False


def _error(shell, source, kind, value, lines, protocol):
    from shell import needed_network

    at, line, is_offline, starved = 0, "", False, False
    with suppress(Exception):  # it may be of a student's own class
        at, line = shell.typed_lines(value, source, protocol.other_cell)
        is_offline = needed_network(value)
    if kind is protocol.TimeLimitError:
        starved = value.starved
        said = f"this cell ran longer than {value.seconds:g} s"
        if starved:
            said = f"this cell had not ended after {value.seconds:g} s on the clock"
        kind, value, lines = TimeoutError, said, []
    elif isinstance(value, SyntaxError):
        if protocol.kind_of(value) == "SyntaxError":
            kind = SyntaxError
        at, line = 0, ""
        value, lines = f"{value.msg}, line {value.lineno}: {(value.text or '').strip()}", []
    elif is_offline:
        value = f"{protocol.message_of(value)} (the grader has no network)"
    text = protocol.shortened(value if isinstance(value, str) else protocol.message_of(value))
    return {
        "output_type": "error",
        "ename": kind.__name__,
        "evalue": text,
        "traceback": [str(line) for line in lines] or [f"{kind.__name__}: {text}"],
        "at": at,
        "line": protocol.shortened(line),
        "starved": starved,
    }


def _text(data):
    """Output data as a notebook stores it; some objects give their picture as raw bytes."""
    return base64.b64encode(data).decode() if isinstance(data, bytes) else str(data)


def _answer(calls, namespace, replies, protocol):
    """Write a reply for each call; send those written so far before a call that may take long."""
    written = time.monotonic()
    for call in calls:
        if time.monotonic() - written > HELD_SECONDS:
            replies.flush()
            written = time.monotonic()
        answer = protocol.answer(protocol.decode_call(call), namespace)
        replies.write(json.dumps({"reply": protocol.encode_reply(answer)}) + "\n")
        if answer.fault:
            break
    replies.flush()


def _quietly(function, *args):
    from IPython.utils.capture import capture_output

    with capture_output():
        return function(*args)


def _reply(replies, message):
    replies.write(json.dumps(message) + "\n")
    replies.flush()


if __name__ == "__main__":
    main()
