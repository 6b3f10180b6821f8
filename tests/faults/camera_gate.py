# SPDX-License-Identifier: Apache-2.0
"""A camera's connection that a test cuts and restores. Loopback only."""
import contextlib
import socket
import threading


class CameraGate:
    """Passes TCP on to a camera while it is open, which it is from its construction on; ends with the `with` block. The port stays the same."""

    def __init__(self, camera_port):
        self._camera_port = camera_port
        self._ends = []  # of the connections that exist
        self._guard = threading.Lock()
        self._listener = socket.create_server(("127.0.0.1", 0))
        self.port = self._listener.getsockname()[1]
        self._begin(self._accept, self._listener)

    def open(self):
        self._listener = socket.create_server(("127.0.0.1", self.port))
        self._begin(self._accept, self._listener)

    def close(self):
        """Cuts what is connected; nothing listens any more."""
        with contextlib.suppress(OSError):
            self._listener.shutdown(socket.SHUT_RDWR)
        self._listener.close()
        with self._guard:
            for end in self._ends:
                with contextlib.suppress(OSError):
                    end.shutdown(socket.SHUT_RDWR)
            self._ends.clear()

    @staticmethod
    def _begin(step, *arguments):
        threading.Thread(target=step, args=arguments, daemon=True).start()

    def _accept(self, listener):
        while True:
            try:
                viewer, _ = listener.accept()
            except OSError:  # closed
                return
            try:
                camera = socket.create_connection(("127.0.0.1", self._camera_port))
            except OSError:  # it is not there yet
                viewer.close()
                continue
            with self._guard:
                self._ends += [viewer, camera]
            self._begin(self._pass_on, viewer, camera, self._edit_request)
            self._begin(self._pass_on, camera, viewer, bytes)

    def _edit_request(self, request):
        """What the camera gets in place of what the viewer sends."""
        return request

    @staticmethod
    def _pass_on(source, target, edit):
        with source, contextlib.suppress(OSError):  # either end has gone
            while data := source.recv(65536):
                target.sendall(edit(data))
            target.shutdown(socket.SHUT_RDWR)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()
