# SPDX-License-Identifier: Apache-2.0
"""Runs the programs under test and reads their messages. Standard library only; traffic stays on the loopback."""
import collections
import json
import os
import pathlib
import pty
import random
import re
import signal
import socket
import subprocess
import tempfile
import threading
import time
import unittest

BIN = pathlib.Path(os.environ["GEOLOC_BIN_DIR"])
SOURCE = pathlib.Path(os.environ["GEOLOC_SOURCE_DIR"])
PATIENCE_S = 100  # how long to wait for what must come; only a slow machine needs so long

Result = collections.namedtuple("Result", "status out err")


def run(program, *arguments, timeout=PATIENCE_S, **options):
    """Runs a program to its end."""
    done = subprocess.run([BIN / program, *map(str, arguments)], capture_output=True, text=True,
                          timeout=timeout, check=False, **options)
    return Result(done.returncode, done.stdout, done.stderr)


def free_port(kind=socket.SOCK_DGRAM):
    """A free port on the loopback, below those that the system gives to whoever asks for any: they may be taken until it is used."""
    while True:
        with socket.socket(socket.AF_INET, kind) as probe:
            port = random.randrange(10000, 32000)
            try:
                probe.bind(("127.0.0.1", port))
                return port
            except OSError:
                continue


def open_terminal():
    """The controlling and the other end of a new terminal. Skips the test where the system has none, as in a chroot without devpts."""
    try:
        return pty.openpty()
    except OSError as fault:
        raise unittest.SkipTest(f"there are no terminals here: {fault}") from fault


class Live:
    """A program that runs in parallel with the test, which can wait for its messages (stderr). It ends with the `with` block."""

    def __init__(self, program, *arguments, **options):
        self._process = subprocess.Popen([BIN / program, *map(str, arguments)], stderr=subprocess.PIPE,
                                         stdout=subprocess.DEVNULL, text=True, **options)
        self._lines = []
        self._said_more = threading.Condition()
        self._reader = threading.Thread(target=self._read)
        self._reader.start()

    def _read(self):
        for line in self._process.stderr:
            with self._said_more:
                self._lines.append(line.rstrip("\n"))
                self._said_more.notify_all()
        with self._said_more:
            self._lines.append(None)  # no more will come
            self._said_more.notify_all()

    @property
    def process_id(self):
        return self._process.pid

    @property
    def is_running(self):
        return self._process.poll() is None

    @property
    def lines(self):
        with self._said_more:
            return [line for line in self._lines if line is not None]

    def wait_for(self, pattern, after=0):
        """The match of `pattern` in the first line that contains it, from line number `after` on (see line_count())."""
        deadline = time.monotonic() + PATIENCE_S
        with self._said_more:
            while True:
                for line in self._lines[after:]:
                    match = re.search(pattern, line or "")
                    if match:
                        return match
                left_s = deadline - time.monotonic()
                if left_s <= 0 or self._lines[-1:] == [None]:
                    raise AssertionError(f"never said {pattern!r}:\n" + "\n".join(map(str, self._lines)))
                self._said_more.wait(left_s)

    def line_count(self):
        return len(self.lines)

    def wait(self):
        """Waits until it ends by itself; returns its exit status."""
        status = self._process.wait(PATIENCE_S)
        self._reader.join()
        return status

    def interrupt(self):
        """Sends Ctrl-C; returns its exit status."""
        self._process.send_signal(signal.SIGINT)
        return self.wait()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self.is_running:
            self._process.kill()
        self.wait()
        self._process.stderr.close()


PROGRAMS = "geoloc_app", "geoloc_detect", "geoloc_replay", "geoloc_sim", "geoloc_eval", "geoloc_fuse", "geoloc_import"


class AppTest(unittest.TestCase):
    """A test with a temporary folder of its own, `self.folder`."""

    def setUp(self):
        holder = tempfile.TemporaryDirectory(prefix="geoloc-test-")
        self.addCleanup(holder.cleanup)
        self.folder = pathlib.Path(holder.name)

    def assert_refused(self, result, *reasons):
        """Asserts exit status 2 and that every reason is reported."""
        self.assertEqual(result.status, 2, result.err)
        for reason in reasons:
            self.assertIn(str(reason), result.err)

    def write(self, name, content):
        file = self.folder / name
        file.write_text(content if isinstance(content, str) else json.dumps(content))
        return file

    def make_recording(self, name="recording", *arguments):
        """A short recording of geoloc_sim."""
        result = run("geoloc_sim", "--record", self.folder / name, "--start-s", 80, "--end-s", 100, *arguments)
        self.assertEqual(result.status, 0, result.err)
        return self.folder / name


class World:
    """The ports of a simulated drone, and the programs' arguments to use them."""

    def __init__(self):
        self.udp_port = free_port()
        self.rtsp_port = free_port(socket.SOCK_STREAM)

    def fly(self, *arguments):
        return Live("geoloc_sim", "--udp", f"127.0.0.1:{self.udp_port}", "--rtsp-port", self.rtsp_port, *arguments)

    def watch(self, *arguments, **options):
        return Live("geoloc_app", *self.inputs(), *arguments, **options)

    def inputs(self):
        return "--udp", f"127.0.0.1:{self.udp_port}", "--rtsp", f"rtsp://127.0.0.1:{self.rtsp_port}/cam"


def rmse_m(summary):
    """The RMSE in a program's last line about a run with known truth."""
    return float(re.search(r"RMSE ([\d.]+) m", summary)[1])


def tree(folder):
    """Every file below a folder with its bytes."""
    return {str(path.relative_to(folder)): path.read_bytes() for path in folder.rglob("*") if path.is_file()}
