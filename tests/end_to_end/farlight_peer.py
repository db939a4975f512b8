# A farlight.v1 client and a way to start the server, written from PROTOCOL.md alone: it shares no
# code with the native client, so that the page, not the code, is what both sides agree on.
import asyncio
import http.client
import json
import os
import signal
import struct
import subprocess

import websockets

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
PATIENCE_S = 120  # the machine may be slow and busy; nothing here measures time

STILL, LOSSLESS, HISTORY_RESET, CONVERGED = 1, 2, 4, 8
JPEG420, JPEG444, PNG, RAW = range(4)

# Section 5 of the page: offset, struct code, name.
HEADER = [
    (4, "B", "version"),
    (5, "B", "format"),
    (6, "H", "header_size"),
    (8, "H", "flags"),
    (10, "H", "pass_count"),
    (12, "I", "passes_size"),
    (16, "I", "frame_id"),
    (20, "I", "camera_sequence"),
    (24, "I", "session_epoch"),
    (28, "I", "payload_size"),
    (32, "H", "width"),
    (34, "H", "height"),
    (36, "H", "full_width"),
    (38, "H", "full_height"),
    (40, "I", "accumulated_samples"),
    (44, "f", "predicted_error"),
    (48, "I", "wait_us"),
    (52, "I", "trace_us"),
    (56, "I", "denoise_us"),
    (60, "I", "encode_us"),
    (64, "I", "nonfinite_count"),
    (72, "Q", "framebuffer_hash"),
    (88, "f", "measured_error"),
    (112, "I", "frame_us"),
    (116, "H", "samples_per_pixel"),
]


class Frame:
    """A binary message taken apart; header fields are attributes."""

    def __init__(self, message):
        assert message[:4] == b"FARL", message[:4]
        for offset, code, name in HEADER:
            setattr(self, name, struct.unpack_from("<" + code, message, offset)[0])
        assert self.version == 1
        start = self.header_size + self.passes_size
        assert start + self.payload_size == len(message)
        self.payload = message[start:]
        self.passes = []
        at = self.header_size
        for _ in range(self.pass_count):
            length = message[at]
            name = message[at + 1 : at + 1 + length].decode()
            self.passes.append((name, struct.unpack_from("<f", message, at + 1 + length)[0]))
            at += 1 + length + 4
        assert at <= start

    def floats(self):
        assert self.format == RAW
        return struct.unpack("<%df" % (self.width * self.height * 3), self.payload)


class Server:
    """A farlight-server of our own; a context manager."""

    def __init__(self, scene="scenes/cornell_box.json", size="32x18", *more):
        command = [os.environ["FARLIGHT_SERVER"], "--scene", os.path.join(ROOT, scene)]
        command += ["--port", "0", "--size", size, *more]
        self.process = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
        prefix = "farlight-server: listening on http://"
        for line in self.process.stdout:
            if line.startswith(prefix):
                self.address = line[len(prefix) :].strip().rstrip("/")
                return
        raise RuntimeError("the server ended with status %s" % self.process.wait())

    def __enter__(self):
        return self

    def __exit__(self, *_):
        if self.process.poll() is None:
            self.process.send_signal(signal.SIGTERM)
            try:
                self.process.wait(30)
            except subprocess.TimeoutExpired:
                self.process.kill()
        self.process.stdout.close()

    @property
    def url(self):
        return "ws://%s/ws" % self.address

    def get(self, path, headers=None):
        """(status, headers, body) of a GET."""
        connection = http.client.HTTPConnection(self.address, timeout=PATIENCE_S)
        try:
            connection.request("GET", path, headers=headers or {})
            answer = connection.getresponse()
            return answer.status, answer.headers, answer.read()
        finally:
            connection.close()

    def resident_bytes(self):
        with open("/proc/%d/statm" % self.process.pid) as file:
            return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")


class Peer:
    """One connection; an asynchronous context manager."""

    def __init__(self, server):
        self.server = server
        self.sequence = 0

    async def __aenter__(self):
        self.socket = await websockets.connect(
            self.server.url, subprotocols=["farlight.v1"], max_size=None, compression=None
        )
        return self

    async def __aexit__(self, *_):
        await self.socket.close()

    async def say(self, kind, **fields):
        await self.socket.send(json.dumps({"type": kind, **fields}))

    async def hear(self):
        """The next message: a dict or a Frame."""
        message = await asyncio.wait_for(self.socket.recv(), PATIENCE_S)
        if not isinstance(message, str):
            return Frame(message)
        message = json.loads(message)
        # Said unasked, at any time: who does not steer by it passes over it.
        return await self.hear() if message["type"] == "frontier" else message

    async def hear_kind(self, kind):
        """The next JSON message, which must be of this kind; frames before it are acknowledged."""
        while True:
            message = await self.hear()
            if isinstance(message, dict):
                assert message["type"] == kind, message
                return message
            await self.ack(message)

    async def hear_frame(self):
        message = await self.hear()
        assert isinstance(message, Frame), message
        return message

    async def hear_close(self):
        """Reads until the connection ends; the close code."""
        try:
            while True:
                await asyncio.wait_for(self.socket.recv(), PATIENCE_S)
        except websockets.exceptions.ConnectionClosed:
            return self.socket.close_code

    async def hello(self, **fields):
        await self.say("hello", client="independent peer 1.0", **fields)
        self.welcome = await self.hear_kind("welcome")
        return self.welcome

    async def camera(self, dx=0.0, **fields):
        """The scene's camera moved sideways by dx; returns the sequence."""
        self.sequence += 1
        pose = dict(self.welcome["camera"])
        pose["position"] = [pose["position"][0] + dx, *pose["position"][1:]]
        await self.say("camera", sequence=self.sequence, **pose, **fields)
        return self.sequence

    async def ack(self, frame):
        await self.say("ack", frame_id=frame.frame_id, decode_us=100)

    async def draw(self, dx=0.0, **fields):
        """Lockstep: one camera, its frame, acknowledged."""
        sequence = await self.camera(dx, **fields)
        frame = await self.hear_frame()
        assert frame.camera_sequence == sequence
        await self.ack(frame)
        return frame
