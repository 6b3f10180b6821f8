# SPDX-License-Identifier: Apache-2.0
"""A network between a camera and its viewer that loses packets: RTSP passes, RTP over UDP with losses. Loopback only."""
import random
import re
import socket

from camera_gate import CameraGate


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


class LossyProxy(CameraGate):
    """`loss`: the share of RTP packets that does not come through; may be changed."""

    def __init__(self, camera_port, loss):
        self.loss = loss
        self._random = random.Random(1)
        super().__init__(camera_port)

    def _edit_request(self, request):
        match = re.search(rb"client_port=(\d+)-(\d+)", request)
        if not match:
            return request
        rtp, rtcp = consecutive_ports()
        self._begin(self._lose, rtp, int(match[1]), True)
        self._begin(self._lose, rtcp, int(match[2]), False)
        port = rtp.getsockname()[1]
        return request.replace(match[0], b"client_port=%d-%d" % (port, port + 1))

    def _lose(self, source, viewer_port, is_rtp):
        with source:
            while True:
                packet = source.recv(65536)
                if not is_rtp or self._random.random() >= self.loss:
                    source.sendto(packet, ("127.0.0.1", viewer_port))
