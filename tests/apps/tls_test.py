# SPDX-License-Identifier: Apache-2.0
"""Cursor on Target to a TAK server that speaks TLS: Python's, with certificates that openssl makes."""
import re
import socket
import ssl
import subprocess
import threading
import time
import types
import unittest
import xml.etree.ElementTree

from support import PATIENCE_S, AppTest, Live, World, free_port, run

PASSWORD = "atakatak"


class Certificates:
    """An authority, a server of this computer and a client, in a folder."""

    def __init__(self, folder, name="ca"):
        self.folder = folder
        self.authority = name
        self.openssl("req", "-x509", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:P-256", "-nodes", "-days", "2",
                     "-subj", f"/CN={name}", "-keyout", f"{name}.key", "-out", f"{name}.pem")

    def openssl(self, *arguments):
        subprocess.run(["openssl", *map(str, arguments)], cwd=self.folder, check=True, capture_output=True)

    def issue(self, name, alternative="DNS:localhost,IP:127.0.0.1"):
        extensions = self.folder / f"{name}.ext"
        extensions.write_text(f"subjectAltName={alternative}\n")
        self.openssl("req", "-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:P-256", "-nodes", "-subj", f"/CN={name}",
                     "-keyout", f"{name}.key", "-out", f"{name}.csr")
        self.openssl("x509", "-req", "-in", f"{name}.csr", "-CA", f"{self.authority}.pem", "-CAkey", f"{self.authority}.key",
                     "-CAcreateserial", "-days", "1", "-extfile", extensions, "-out", f"{name}.pem")

    def pkcs12(self, name, *options):
        """As TAK servers give it to their clients."""
        self.openssl("pkcs12", "-export", *options, "-in", f"{name}.pem", "-inkey", f"{name}.key",
                     "-certfile", f"{self.authority}.pem", "-passout", f"pass:{PASSWORD}", "-out", f"{name}.p12")


class TakServer:
    """A server that demands certificates of the authority's, one client after the other. `events` holds what it got."""

    def __init__(self, folder, port=0, newest=ssl.TLSVersion.TLSv1_3):
        context = ssl.SSLContext(ssl.PROTOCOL_TLS_SERVER)
        context.load_cert_chain(folder / "server.pem", folder / "server.key")
        context.load_verify_locations(folder / "ca.pem")
        context.verify_mode = ssl.CERT_REQUIRED
        context.maximum_version = newest
        self._context = context
        self._listening = socket.create_server(("127.0.0.1", port))
        self.port = self._listening.getsockname()[1]
        self.url = f"tls://127.0.0.1:{self.port}"
        self.received = bytearray()
        self.clients = []
        self.faults = []
        self.is_closed = False
        self._thread = threading.Thread(target=self._serve)
        self._thread.start()

    def _serve(self):
        while not self.is_closed:
            try:
                client, _ = self._listening.accept()
            except OSError:
                return
            client.settimeout(PATIENCE_S)
            try:
                with self._context.wrap_socket(client, server_side=True) as session:
                    self.clients.append(session)
                    while chunk := session.recv(4096):
                        self.received.extend(chunk)
            except OSError as fault:
                self.faults.append(str(fault))

    @property
    def events(self):
        events = bytes(self.received).split(b"</event>")[:-1]
        return [xml.etree.ElementTree.fromstring(event.strip() + b"</event>") for event in events]

    def close(self):
        """Cuts the present client, too."""
        if self.is_closed:
            return
        self.is_closed = True
        self._listening.shutdown(socket.SHUT_RDWR)
        self._listening.close()
        for session in self.clients:
            try:
                session.shutdown(socket.SHUT_RDWR)
            except OSError:
                pass
        self._thread.join()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()


class CotOverTls(AppTest):
    def setUp(self):
        super().setUp()
        self.certificates = Certificates(self.folder)
        self.certificates.issue("server")
        self.certificates.issue("client")

    def config(self, **settings):
        return self.write("config.json", {"cot": {f"tls_{key}": str(value) for key, value in settings.items()}})

    def proving(self, **settings):
        return self.config(**{"ca_file": self.folder / "ca.pem", "client_file": self.folder / "client.pem",
                              "key_file": self.folder / "client.key", **settings})

    def replay(self, server, config):
        return run("geoloc_replay", self.recording, "--config", config, "--cot", server.url, "--out", self.objects)

    def test_whoever_is_known_to_both_sides_is_heard(self):
        self.recording, self.objects = self.make_recording(), self.folder / "objects.geojson"
        self.write("password", PASSWORD + "\n")
        self.certificates.pkcs12("client")
        by_pkcs12 = {"client_file": self.folder / "client.p12", "key_file": "", "password_file": self.folder / "password",
                     "ca_file": self.folder / "client.p12"}
        for settings, newest in ({}, ssl.TLSVersion.TLSv1_3), ({}, ssl.TLSVersion.TLSv1_2), (by_pkcs12, ssl.TLSVersion.TLSv1_3):
            with self.subTest(newest=newest, **settings), TakServer(self.folder, newest=newest) as server:
                result = self.replay(server, self.proving(**settings))
                self.assertEqual(result.status, 0, result.err)
                server.close()
                self.assertNotRegex(result.err, "trying again|no answer")
                self.assertEqual(server.faults, [])
                found = self.objects.read_text().count('"Feature"')
                self.assertGreaterEqual(len({event.get("uid") for event in server.events}), found)
                self.assertGreater(found, 3)

    def test_pkcs12_as_older_tak_servers_write_it(self):
        try:
            self.certificates.pkcs12("client", "-legacy")
        except subprocess.CalledProcessError:
            self.skipTest("this openssl has no legacy ciphers")
        self.recording, self.objects = self.make_recording(), self.folder / "objects.geojson"
        self.write("password", PASSWORD)
        with TakServer(self.folder) as server:
            result = self.replay(server, self.proving(client_file=self.folder / "client.p12", key_file="",
                                                      password_file=self.folder / "password"))
            self.assertEqual(result.status, 0, result.err)
            server.close()
            self.assertGreater(len(server.events), 3)

    def test_a_refusal_is_named_once_and_costs_no_object(self):
        self.recording, self.objects = self.make_recording(), self.folder / "objects.geojson"
        self.assertEqual(run("geoloc_replay", self.recording, "--out", self.objects).status, 0)
        expected = self.objects.read_bytes()
        other = Certificates(self.folder, "other")
        other.issue("stranger")
        for settings, reason in (
                ({"ca_file": self.folder / "other.pem"}, "not from a trusted authority"),
                ({"ca_file": ""}, "not from a trusted authority"),
                ({"server_name": "tak.example"}, "is not for tak.example"),
                ({"client_file": "", "key_file": ""}, "wants a client certificate"),
                ({"client_file": self.folder / "stranger.pem", "key_file": self.folder / "stranger.key"},
                 "refuses our certificate")):
            with self.subTest(reason, **settings), TakServer(self.folder) as server:
                result = self.replay(server, self.proving(**settings))
                self.assertEqual(result.status, 0, result.err)
                self.assertEqual(result.err.count("trying again"), 1, result.err)
                self.assertRegex(result.err, rf"--cot {server.url}: .*{reason}")
                self.assertEqual(self.objects.read_bytes(), expected)
                server.close()
                self.assertEqual(server.events, [])

    def test_a_refusal_is_not_repeated_with_every_attempt(self):
        with TakServer(self.folder) as server:
            world = World()
            config = self.config(ca_file=self.folder / "ca.pem")
            with world.watch("--config", config, "--cot", server.url, "--out", self.folder / "objects.geojson") as app:
                self.wait_until(lambda: len(server.faults) >= 3)
                self.assertEqual(app.interrupt(), 0)
            [told] = [line for line in app.lines if server.url in line and "EGM96" not in line]
            self.assertIn("wants a client certificate", told)

    def test_files_that_cannot_be_used_are_refused_before_the_flight(self):
        for settings, setting in (({"ca_file": self.folder / "none.pem"}, "cot.tls_ca_file"),
                                  ({"key_file": self.folder / "server.key"}, "cot.tls_key_file"),
                                  ({"client_file": self.folder / "client.key"}, "cot.tls_client_file")):
            with self.subTest(setting):
                self.assert_refused(run("geoloc_app", *World().inputs(), "--config", self.proving(**settings), "--cot",
                                        "tls://127.0.0.1:1"), setting)
        key = self.folder / "client.key"
        self.assert_refused(run("geoloc_app", *World().inputs(), "--config", self.proving(), "--out", key), key,
                            "input of this run", "cot.tls_key_file")

    def test_a_server_that_stalls_in_the_handshake_holds_nothing_up(self):
        self.recording, self.objects = self.make_recording(), self.folder / "objects.geojson"
        with socket.create_server(("127.0.0.1", 0)) as silent:
            server = types.SimpleNamespace(url=f"tls://127.0.0.1:{silent.getsockname()[1]}")
            begin = time.monotonic()
            alone = run("geoloc_replay", self.recording, "--out", self.objects)
            alone_s = time.monotonic() - begin
            expected = self.objects.read_bytes()
            begin = time.monotonic()
            result = self.replay(server, self.proving())
            self.assertEqual((alone.status, result.status), (0, 0), result.err)
            self.assertLess(time.monotonic() - begin, 3 * alone_s + 10)
            self.assertIn(f"{server.url}: no answer", result.err)
            self.assertEqual(self.objects.read_bytes(), expected)

    def test_a_server_that_restarts_is_told_everything_again(self):
        port = free_port(socket.SOCK_STREAM)
        world = World()
        first = TakServer(self.folder, port)
        try:
            with world.watch("--config", self.proving(), "--cot", first.url, "--out", self.folder / "objects.geojson") as app:
                with world.fly("--start-s", 80, "--end-s", 104):
                    self.wait_until(lambda: first.events)
                    first.close()
                    app.wait_for(rf"--cot tls://127.0.0.1:{port}: .*trying again")
                    with TakServer(self.folder, port) as second:
                        self.wait_until(lambda: second.events)
                        app.wait_for(rf"--cot tls://127.0.0.1:{port}: connected")
                        self.assertEqual(app.interrupt(), 0)
                        second.close()
                        known = {event.get("uid") for event in first.events}
                        self.assertLessEqual(known, {event.get("uid") for event in second.events})
        finally:
            first.close()

    def wait_until(self, holds):
        deadline = time.monotonic() + PATIENCE_S
        while not holds():
            self.assertLess(time.monotonic(), deadline)
            time.sleep(0.05)


if __name__ == "__main__":
    unittest.main()
