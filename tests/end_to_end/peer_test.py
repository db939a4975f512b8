# The server as an independent client sees it: what PROTOCOL.md promises, and what it does to
# clients that misbehave.
import asyncio
import json
import math
import signal
import socket
import struct
import time
import unittest

import websockets

import pixels
from farlight_peer import CONVERGED, HISTORY_RESET, LOSSLESS, STILL
from farlight_peer import JPEG420, JPEG444, PNG, RAW, Peer, Server

server = None


def setUpModule():
    global server
    server = Server()


def tearDownModule():
    server.__exit__()


class Lockstep(unittest.IsolatedAsyncioTestCase):
    async def test_one_camera_one_frame(self):
        async with Peer(server) as peer:
            welcome = await peer.hello(mode="lockstep", format="raw", size=[24, 16])
            self.assertEqual(welcome["protocol"], "farlight.v1")
            self.assertEqual((welcome["mode"], welcome["format"]), ("lockstep", "raw"))
            self.assertEqual(welcome["size"], [24, 16])
            for i in range(1, 4):
                frame = await peer.draw()
                self.assertEqual((frame.frame_id, frame.format), (i, RAW))
                self.assertEqual(frame.session_epoch, 1)
                self.assertEqual((frame.width, frame.height, frame.full_width), (24, 16, 24))
                self.assertEqual(bool(frame.flags & HISTORY_RESET), i == 1)
                self.assertTrue(frame.flags & LOSSLESS)
                self.assertFalse(frame.flags & (STILL | CONVERGED))
                self.assertEqual(frame.nonfinite_count, 0)
                self.assertTrue(all(math.isfinite(value) for value in frame.floats()))
                self.assertGreater(max(frame.floats()), 0)
                self.assertEqual(pixels.xxh64(frame.payload), frame.framebuffer_hash)
                self.assertIn("path_trace", [name.split(" ")[0] for name, _ in frame.passes])

    async def test_every_format_and_its_hash(self):
        async with Peer(server) as peer:
            await peer.hello(mode="lockstep", format="png", settings={"seed": 5})
            frame = await peer.draw()
            width, height, rgb = pixels.decode_png(frame.payload)
            self.assertEqual((width, height), (frame.width, frame.height))
            self.assertEqual(pixels.xxh64(rgb), frame.framebuffer_hash)
            for name, number in (("jpeg420", 0), ("jpeg444", 1)):
                await peer.say("format", format=name)
                self.assertEqual((await peer.hear_kind("state"))["format"], name)
                frame = await peer.draw()
                self.assertEqual((frame.format, frame.payload[:2]), (number, b"\xff\xd8"))
                self.assertFalse(frame.flags & LOSSLESS)

    async def test_same_messages_same_bytes(self):
        async def play(seed):
            async with Peer(server) as peer:
                await peer.hello(mode="lockstep", format="raw", settings={"seed": seed})
                frames = [(await peer.draw(dx=i)).payload for i in range(3)]
                await peer.draw(cut=True)
                return frames

        first, second, other = await play(7), await play(7), await play(8)
        self.assertEqual(first, second)
        self.assertNotEqual(first, other)

    async def test_a_cut_starts_over(self):
        async with Peer(server) as peer:
            await peer.hello(mode="lockstep", format="raw")
            first = await peer.draw()
            await peer.draw()
            again = await peer.draw(cut=True)
            self.assertTrue(again.flags & HISTORY_RESET)
            self.assertEqual(first.payload, again.payload)

    async def test_settings_and_sizes_change_in_message_order(self):
        async with Peer(server) as peer:
            await peer.hello(mode="lockstep", format="raw")
            before = await peer.draw()
            await peer.say("set", key="samples_per_pixel", value=3)
            self.assertEqual((await peer.hear_kind("state"))["settings"]["samples_per_pixel"], 3)
            await peer.say("resize", width=20, height=10)
            self.assertEqual((await peer.hear_kind("state"))["size"], [20, 10])
            after = await peer.draw()
            self.assertEqual((after.width, after.height), (20, 10))
            self.assertGreater(after.session_epoch, before.session_epoch)
            self.assertTrue(after.flags & HISTORY_RESET)
            self.assertEqual(after.accumulated_samples, 3)

    async def test_unacknowledged_frames_hold_the_next_one_back(self):
        async with Peer(server) as peer:
            await peer.hello(mode="lockstep", max_in_flight=2)
            for _ in range(5):
                await peer.camera()
            first, second = await peer.hear_frame(), await peer.hear_frame()
            await peer.say("ping", t=1)
            answer = await peer.hear()
            self.assertEqual(answer["type"], "pong", "a third frame came unacknowledged")
            await peer.ack(second)  # covers both
            third, fourth = await peer.hear_frame(), await peer.hear_frame()
            await peer.ack(fourth)
            fifth = await peer.hear_frame()
            frames = [first, second, third, fourth, fifth]
            self.assertEqual([frame.camera_sequence for frame in frames], [1, 2, 3, 4, 5])

    async def test_too_many_waiting_cameras_end_the_session(self):
        async with Peer(server) as peer:
            await peer.hello(mode="lockstep", max_in_flight=1)
            for _ in range(80):
                await peer.camera()
            messages = []
            try:
                while True:
                    messages.append(await peer.hear())
            except websockets.exceptions.ConnectionClosed:
                pass
            self.assertEqual(messages[-1]["code"], "queue_full")
            self.assertTrue(messages[-1]["fatal"])
            self.assertEqual(peer.socket.close_code, 1008)


class Interactive(unittest.IsolatedAsyncioTestCase):
    async def test_rest_ends_in_one_lossless_still_then_silence(self):
        async with Peer(server) as peer:
            await peer.hello(settings={"still_samples": 6})
            await peer.camera()
            frames = []
            while not frames or not frames[-1].flags & CONVERGED:
                frames.append(await peer.hear_frame())
                await peer.ack(frames[-1])
            last = frames[-1]
            self.assertEqual(last.flags & (STILL | LOSSLESS), STILL | LOSSLESS)
            self.assertEqual((last.format, last.camera_sequence), (PNG, 1))
            self.assertGreaterEqual(last.accumulated_samples, 6)
            rgb = pixels.decode_png(last.payload)[2]
            self.assertEqual(pixels.xxh64(rgb), last.framebuffer_hash)
            for frame in frames[:-1]:
                self.assertEqual(frame.format, JPEG444 if frame.flags & STILL else JPEG420)
            await asyncio.sleep(0.3)
            await peer.say("ping", t=2)
            answer = await peer.hear()
            self.assertEqual(answer["type"], "pong", "a frame came after the final one")
            await peer.camera(dx=5)
            self.assertEqual((await peer.hear_frame()).camera_sequence, 2)

    async def test_the_newest_camera_wins(self):
        async with Peer(server) as peer:
            await peer.hello(max_in_flight=1)
            first = await peer.hear_frame()
            for i in range(40):
                await peer.camera(dx=i)
            await peer.say("ping", t=3)
            await peer.hear_kind("pong")  # so the server has them all
            await peer.ack(first)
            self.assertEqual((await peer.hear_frame()).camera_sequence, 40)

    async def test_two_clients_have_cameras_of_their_own(self):
        async with Peer(server) as a, Peer(server) as b:
            await asyncio.gather(a.hello(size=[16, 16]), b.hello(size=[20, 10], format="png"))
            for i in range(5):
                await a.camera(dx=i)
                await b.camera(dx=-i)
                for peer, size in ((a, (16, 16)), (b, (20, 10))):
                    while True:
                        frame = await peer.hear_frame()
                        await peer.ack(frame)
                        self.assertEqual((frame.width, frame.height), size)
                        if frame.camera_sequence == i + 1:
                            break


class Misbehaviour(unittest.IsolatedAsyncioTestCase):
    async def test_bad_messages_are_refused_and_the_session_goes_on(self):
        cases = [
            ("garbage", "not_json", None),
            ("[1]", "not_json", None),
            ('{"type":"teapot"}', "unknown_type", "type"),
            ('{"type":"ack"}', "missing_field", "frame_id"),
            ('{"type":"ack","frame_id":"1"}', "wrong_type", "frame_id"),
            ('{"type":"resize","width":0,"height":1}', "out_of_range", "width"),
            ('{"type":"resize","width":65000,"height":1}', "out_of_range", None),
            ('{"type":"ping","t":1e999}', "not_finite", None),
            ('{"type":"ping","t":1,"x":' + "[" * 17 + "]" * 17 + "}", "too_deep", None),
            ('{"type":"set","key":"sharpness","value":1}', "unknown_setting", "sharpness"),
            ('{"type":"set","key":"denoiser","value":"magic"}', "bad_setting", "denoiser"),
            ('{"type":"set","key":"max_depth","value":0}', "bad_setting", "max_depth"),
            ('{"type":"hello","client":"again"}', "second_hello", None),
        ]
        async with Peer(server) as peer:
            await peer.hello(mode="lockstep")
            for text, code, field in cases:
                await peer.socket.send(text)
                error = await peer.hear_kind("error")
                self.assertEqual((error["code"], error["fatal"]), (code, False), text)
                if field is not None:
                    self.assertEqual(error["field"], field, text)
            await peer.draw()

    async def test_bad_values_in_hello_leave_the_defaults(self):
        async with Peer(server) as peer:
            settings = {"sharpness": 1, "seed": 9}
            await peer.say("hello", client="x", mode="lockstep", size=[65000, 1], settings=settings)
            codes = {(await peer.hear_kind("error"))["code"] for _ in range(2)}
            self.assertEqual(codes, {"out_of_range", "unknown_setting"})
            welcome = await peer.hear_kind("welcome")
            self.assertEqual(welcome["size"], [32, 18])
            self.assertEqual([s["value"] for s in welcome["settings"] if s["key"] == "seed"], [9])

    async def test_what_ends_a_connection_and_how(self):
        async def first_message(message):
            async with Peer(server) as peer:
                await peer.socket.send(message)
                return await peer.hear_close()

        self.assertEqual(await first_message('{"type":"bye"}'), 1008)
        self.assertEqual(await first_message(b"binary"), 1003)
        oversized = json.dumps({"type": "hello", "client": "x" * 20000})
        self.assertEqual(await first_message(oversized), 1009)
        async with Peer(server) as peer:
            await peer.hello()
            await peer.say("bye")
            self.assertEqual(await peer.hear_close(), 1000)
        async with Peer(server) as peer:
            await peer.hello(mode="lockstep")
            for _ in range(100):
                await peer.socket.send("garbage")
            self.assertEqual(await peer.hear_close(), 1008)

    async def test_a_client_that_never_reads_costs_nobody_else_anything(self):
        host, port = server.address.rsplit(":", 1)
        resting = server.resident_bytes()
        silent = socket.socket()
        silent.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
        silent.connect((host, int(port)))
        silent.sendall(
            b"GET /ws HTTP/1.1\r\nHost: %s\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
            b"Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n"
            b"Sec-WebSocket-Protocol: farlight.v1\r\n\r\n"
            % server.address.encode()
        )

        def send_text(text):
            # A masked text frame whose mask is zero.
            body = json.dumps(text).encode()
            silent.sendall(struct.pack(">BBH", 0x81, 0x80 | 126, len(body)) + b"\0\0\0\0" + body)

        hello = {"type": "hello", "client": "never reads, " + "x" * 100, "format": "raw"}
        send_text({**hello, "size": [320, 180], "max_in_flight": 8})
        async with Peer(server) as other:
            await other.hello(mode="lockstep", format="raw")
            closed = False
            started = time.monotonic()
            growth = 0
            # Each of its messages asks for an answer that it does not read either.
            while not closed and time.monotonic() - started < 60:
                await other.draw()
                try:
                    for seed in range(60):
                        send_text({"type": "set", "key": "seed", "value": seed, "pad": "x" * 200})
                    await asyncio.sleep(0.05)
                except OSError:
                    closed = True
                growth = max(growth, server.resident_bytes() - resting)
            self.assertLess(growth, 64e6)
            self.assertTrue(closed, "the silent client is still connected after a minute")
            await other.draw()
        silent.close()

    async def test_silence_before_hello_is_not_waited_for_forever(self):
        async with Peer(server) as peer:
            self.assertEqual(await peer.hear_close(), 1008)


class Http(unittest.TestCase):
    def test_health_metrics_and_page(self):
        self.assertEqual(server.get("/healthz")[::2], (200, b"ok\n"))
        self.assertEqual(server.get("/readyz")[0], 200)
        self.assertIn(b"\nfarlight_", server.get("/metrics")[2])
        self.assertIn(b"<html", server.get("/")[2].lower())
        self.assertEqual(server.get("/no/such/page")[0], 404)
        self.assertEqual(server.get("/../../etc/passwd")[0], 404)

    def test_snapshot_is_a_png_of_the_default_size(self):
        status, headers, body = server.get("/snapshot.png")
        self.assertEqual((status, headers["Content-Type"]), (200, "image/png"))
        width, height, rgb = pixels.decode_png(body)
        self.assertEqual((width, height), (32, 18))
        self.assertGreater(max(rgb), 0)

    def test_upgrades_without_a_known_version_or_from_elsewhere_are_refused(self):
        upgrade = {
            "Upgrade": "websocket",
            "Connection": "Upgrade",
            "Sec-WebSocket-Version": "13",
            "Sec-WebSocket-Key": "dGhlIHNhbXBsZSBub25jZQ==",
        }
        status, _, body = server.get("/ws", {**upgrade, "Sec-WebSocket-Protocol": "farlight.v9"})
        self.assertEqual((status, b"farlight.v1" in body), (426, True))
        elsewhere = {"Sec-WebSocket-Protocol": "farlight.v1", "Origin": "http://elsewhere.example"}
        self.assertEqual(server.get("/ws", {**upgrade, **elsewhere})[0], 403)


class Shutdown(unittest.IsolatedAsyncioTestCase):
    async def test_everybody_is_told_and_the_status_is_0(self):
        with Server() as mortal:
            async with Peer(mortal) as a, Peer(mortal) as b:
                await a.hello(mode="lockstep")
                await a.draw()
                await b.hello()
                mortal.process.send_signal(signal.SIGTERM)
                for peer in (a, b):
                    bye = await peer.hear_kind("bye")
                    self.assertGreater(bye["reconnect_ms"], 0)
                    self.assertEqual(await peer.hear_close(), 1001)
            self.assertEqual(mortal.process.wait(60), 0)


if __name__ == "__main__":
    unittest.main(verbosity=2)
