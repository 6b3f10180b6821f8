# SPDX-License-Identifier: Apache-2.0
"""A broker (mosquitto) and a database (PostGIS) for a test, on the loopback and in its folder; and a client that sends anything."""
import os
import pathlib
import shutil
import socket
import struct
import subprocess
import time
import unittest

from support import PATIENCE_S, free_port

MOSQUITTO = shutil.which("mosquitto", path=os.environ.get("PATH", "") + ":/usr/sbin")
POSTGRES = sorted(pathlib.Path("/usr/lib/postgresql").glob("*/bin/pg_ctl"), key=lambda file: float(file.parts[-3]))


def wait_for_port(port):
    deadline = time.monotonic() + PATIENCE_S
    while time.monotonic() < deadline:
        try:
            socket.create_connection(("127.0.0.1", port), 1).close()
            return
        except OSError:
            time.sleep(0.05)
    raise AssertionError(f"nothing listens on port {port}")


class Broker:
    """It keeps nothing over a restart. `settings`: lines of its configuration."""

    def __init__(self, folder, *settings):
        if not MOSQUITTO:
            raise unittest.SkipTest("mosquitto is not installed")
        self.port = free_port(socket.SOCK_STREAM)
        self._config = folder / f"mosquitto-{self.port}.conf"
        self._config.write_text("\n".join((f"listener {self.port} 127.0.0.1", "user root", *settings)) + "\n")
        self.start()

    def start(self):
        self._process = subprocess.Popen([MOSQUITTO, "-c", self._config], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        wait_for_port(self.port)

    def kill(self):
        self._process.kill()
        self._process.wait()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.kill()


def _text(value):
    return struct.pack(">H", len(value)) + value


def _packet(kind, body):
    size, left = b"", len(body)
    while True:
        size, left = size + bytes([left % 128 | (128 if left > 127 else 0)]), left // 128
        if left == 0:
            return bytes([kind]) + size + body


def send_retained(port, topic, payload):
    """Any payload to any topic, by MQTT 3.1.1."""
    with socket.create_connection(("127.0.0.1", port)) as broker:
        broker.sendall(_packet(0x10, _text(b"MQTT") + b"\x04\x02\x00\x3c" + _text(b"tester")))
        broker.recv(4)
        broker.sendall(_packet(0x33, _text(topic.encode()) + b"\x00\x01" + payload))
        broker.recv(4)  # it has it
        broker.sendall(_packet(0xE0, b""))


class Database:
    """A cluster of its own. PostgreSQL does not run as root, so that root runs it as the user postgres."""

    def __init__(self, folder):
        if not POSTGRES or not list(pathlib.Path("/usr/share/postgresql").glob("*/extension/postgis.control")):
            raise unittest.SkipTest("PostGIS is not installed")
        self.port = free_port(socket.SOCK_STREAM)
        self._folder = folder / "database"
        self._folder.mkdir()
        self._as_user = []
        if os.geteuid() == 0:
            self._as_user = ["runuser", "-u", "postgres", "--"]
            folder.chmod(0o755)
            shutil.chown(self._folder, "postgres")
        self._call(POSTGRES[-1].with_name("initdb"), "-A", "trust", "-U", "postgres", "--no-sync")
        self.start()
        self.url = f"postgresql://postgres@127.0.0.1:{self.port}/postgres"

    def _call(self, program, *arguments):
        subprocess.run([*self._as_user, program, "-D", self._folder, *arguments], cwd="/", check=True, timeout=PATIENCE_S,
                       stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

    def start(self):
        self._call(POSTGRES[-1], "start", "-w", "-l", self._folder / "log", "-o",
                   f"-p {self.port} -c listen_addresses=127.0.0.1 -c unix_socket_directories={self._folder} -c fsync=off")

    def stop(self):
        self._call(POSTGRES[-1], "stop", "-m", "immediate")

    def ask(self, question):
        """Lines of columns."""
        told = subprocess.run(["psql", "-X", "-A", "-t", "-F", "|", self.url, "-c", question], check=True, capture_output=True,
                              text=True, timeout=PATIENCE_S)
        return [line.split("|") for line in told.stdout.splitlines()]

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.stop()
