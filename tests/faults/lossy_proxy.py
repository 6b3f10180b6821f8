# SPDX-License-Identifier: Apache-2.0
"""A network between a camera and its viewer that loses packets: RTSP passes, RTP over UDP with losses. Loopback only."""
import random
import re
import socket
import threading


def consecutive_ports():
    """Two bound UDP sockets, for RTP and RTCP: an even port and the next one."""
    while True:
        rtp, rtcp = (socket.socket(socket.AF_INET, socket.SOCK_DGRAM) for _ in range(2))
        rtp.bind(("127.0.0.1", 0))
        port = rtp.getsockname()[1]
        try:
            if port % 2 == 0:
                rtcp.bind(("127.0.0.1", port + 1))
                return rtp, rtcp
        except OSError:
            pass
        rtp.close()
        rtcp.close()


class LossyProxy:
    """Ends with the `with` block. `loss`: the share of RTP packets that does not come through; may be changed."""

    def __init__(self, camera_port, loss):
        self.loss = loss
        self._camera_port = camera_port
        self._random = random.Random(1)
        self._listener = socket.create_server(("127.0.0.1", 0))
        self.port = self._listener.getsockname()[1]
        self._start(self._accept)

    @staticmethod
    def _start(step, *arguments):
        threading.Thread(target=step, args=arguments, daemon=True).start()

    def _accept(self):
        while True:
            try:
                viewer, _ = self._listener.accept()
            except OSError:  # the end
                return
            try:
                camera = socket.create_connection(("127.0.0.1", self._camera_port))
            except OSError:  # it is not there yet
                viewer.close()
                continue
            self._start(self._pass_on, viewer, camera, self._with_own_ports)
            self._start(self._pass_on, camera, viewer, bytes)

    def _pass_on(self, source, target, edit):
        with source:
            try:
                while data := source.recv(65536):
                    target.sendall(edit(data))
                target.shutdown(socket.SHUT_RDWR)
            except OSError:  # either end has gone
                pass

    def _with_own_ports(self, request):
        match = re.search(rb"client_port=(\d+)-(\d+)", request)
        if not match:
            return request
        rtp, rtcp = consecutive_ports()
        self._start(self._lose, rtp, int(match[1]), True)
        self._start(self._lose, rtcp, int(match[2]), False)
        port = rtp.getsockname()[1]
        return request.replace(match[0], b"client_port=%d-%d" % (port, port + 1))

    def _lose(self, source, viewer_port, is_rtp):
        with source:
            while True:
                packet = source.recv(65536)
                if not is_rtp or self._random.random() >= self.loss:
                    source.sendto(packet, ("127.0.0.1", viewer_port))

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self._listener.close()
