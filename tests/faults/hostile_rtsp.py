# SPDX-License-Identifier: Apache-2.0
"""An RTSP server that misbehaves, for the tests: only on the loopback, one thread a connection."""
import socket
import threading

SDP = ("v=0\r\no=- 1 1 IN IP4 127.0.0.1\r\ns=camera\r\nt=0 0\r\na=control:*\r\n"
       "m=video 0 RTP/AVP 96\r\nc=IN IP4 0.0.0.0\r\na=rtpmap:96 H264/90000\r\na=control:track0\r\n"
       "a=fmtp:96 packetization-mode=1\r\n")
DRIP_PERIOD_S = 0.2  # well below any timeout of a read


class HostileServer:
    """Answers as `Answers` does, a class that makes the connections misbehave. It ends with the `with` block."""

    def __init__(self, answers, **options):
        self._listener = socket.create_server(("127.0.0.1", 0))
        self.port = self._listener.getsockname()[1]
        self._make = lambda connection: answers(self, connection, **options)
        self.ended = threading.Event()
        self.connections = 0
        self.requests = []
        threading.Thread(target=self._accept, daemon=True).start()

    @property
    def url(self):
        return f"rtsp://127.0.0.1:{self.port}/camera"

    def _accept(self):
        while not self.ended.is_set():
            try:
                connection, _ = self._listener.accept()
            except OSError:
                return
            self.connections += 1
            threading.Thread(target=self._serve, args=(connection,), daemon=True).start()

    def _serve(self, connection):
        try:
            with connection:
                self._make(connection).serve()
        except OSError:  # the client has gone
            pass

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.ended.set()
        self._listener.close()


class Honest:
    """Answers every request, but never sends a frame."""

    def __init__(self, server, connection):
        self.server, self.connection = server, connection

    def serve(self):
        with self.connection.makefile("rb") as requests:
            while True:
                lines = []
                while (line := requests.readline().strip()) or not lines:
                    if not line:
                        return
                    lines.append(line.decode())
                method = lines[0].split()[0]
                self.server.requests.append(method)
                sequence = next(line for line in lines if line.lower().startswith("cseq"))
                self.answer(method, sequence)

    def answer(self, method, sequence):
        self.send(self.response(method, sequence))
        if method == "PLAY":
            self.after_play()

    def response(self, method, sequence):
        extra, body = "", ""
        if method == "OPTIONS":
            extra = "Public: OPTIONS, DESCRIBE, SETUP, PLAY, TEARDOWN, GET_PARAMETER\r\n"
        if method == "DESCRIBE":
            extra, body = f"Content-Type: application/sdp\r\nContent-Length: {len(SDP)}\r\n", SDP
        if method == "SETUP":
            extra = "Transport: RTP/AVP/TCP;unicast;interleaved=0-1\r\nSession: 1;timeout=60\r\n"
        return f"RTSP/1.0 200 OK\r\n{sequence}\r\n{extra}\r\n{body}".encode()

    def after_play(self):
        pass

    def send(self, data):
        self.connection.sendall(data)

    def drip(self, data):
        for byte in data:
            self.send(bytes([byte]))
            if self.server.ended.wait(DRIP_PERIOD_S):
                return


class HostileTo(Honest):
    """Answers one method by `misanswer`, and the others honestly."""

    def __init__(self, server, connection, method):
        super().__init__(server, connection)
        self.method = method

    def answer(self, method, sequence):
        return self.misanswer(sequence) if method == self.method else super().answer(method, sequence)


class Dripping(HostileTo):
    """Sends its answer to one method a byte at a time, and with it goes on for ever."""

    def misanswer(self, sequence):
        self.drip(f"RTSP/1.0 200 OK\r\n{sequence}\r\n".encode())
        while not self.server.ended.is_set():
            self.drip(b"X-Header: and one more\r\n")


class DrippingFrames(Honest):
    """Plays, but its packets come a byte at a time."""

    def after_play(self):
        while not self.server.ended.is_set():
            self.drip(b"$\0\xff\xff" + b"\0" * 64)


class EndlessBody(HostileTo):
    """Answers one method with a body of 4 GB, as fast as it is taken."""

    def misanswer(self, sequence):
        self.send(f"RTSP/1.0 200 OK\r\n{sequence}\r\nContent-Type: application/sdp\r\n"
                  f"Content-Length: 4294967294\r\n\r\n".encode())
        while not self.server.ended.is_set():
            self.send(b"\0" * (1 << 20))


class Redirecting(Honest):
    """Redirects every DESCRIBE: to an address, or to itself."""

    def __init__(self, server, connection, target=None):
        super().__init__(server, connection)
        self.target = target or server.url

    def response(self, method, sequence):
        if method != "DESCRIBE":
            return super().response(method, sequence)
        return f"RTSP/1.0 302 Found\r\n{sequence}\r\nLocation: {self.target}\r\n\r\n".encode()
