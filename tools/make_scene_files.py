#!/usr/bin/env python3
# Writes the pictures and models that the scenes in scenes/ use, and the scene of many lights.
# Everything is computed here; a second run writes the same bytes.
#
#   tools/make_scene_files.py [FOLDER]     default: scenes/ beside this folder
import json
import math
import pathlib
import struct
import sys
import zlib


# ---------------------------------------------------------------- pictures

def write_png(path, width, height, texel):
    """8 bits a channel; texel(x, y) gives 3 or 4 values from 0 to 255."""
    rows = [[texel(x, y) for x in range(width)] for y in range(height)]
    color_type = {3: 2, 4: 6}[len(rows[0][0])]
    raw = b"".join(b"\0" + bytes(round(c) for t in row for c in t) for row in rows)

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    header = struct.pack(">IIBBBBB", width, height, 8, color_type, 0, 0, 0)
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header)
                     + chunk(b"IDAT", zlib.compress(raw, 9)) + chunk(b"IEND", b""))


def write_hdr(path, width, height, radiance):
    """Radiance RGBE, run-length coded a scanline; radiance(x, y) gives linear r, g, b."""
    def rgbe(color):
        largest = max(color)
        if largest < 1e-32:
            return (0, 0, 0, 0)
        exponent = math.frexp(largest)[1]
        scale = math.ldexp(256, -exponent)
        return tuple(min(255, int(c * scale)) for c in color) + (exponent + 128,)

    def coded(values):
        out, i = bytearray(), 0
        while i < len(values):
            run = 1
            while i + run < len(values) and run < 127 and values[i + run] == values[i]:
                run += 1
            if run > 2:
                out += bytes((128 + run, values[i]))
                i += run
                continue
            start = i
            while i < len(values) and i - start < 127 and len(set(values[i:i + 3])) > 1:
                i += 1
            i = max(i, start + 1)
            out += bytes((i - start,)) + bytes(values[start:i])
        return bytes(out)

    out = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y %d +X %d\n" % (height, width)
    for y in range(height):
        row = [rgbe(radiance(x, y)) for x in range(width)]
        out += bytes((2, 2, width >> 8, width & 255))
        out += b"".join(coded([t[channel] for t in row]) for channel in range(4))
    path.write_bytes(out)


def write_exr(path, width, height, radiance):
    """OpenEXR, 32-bit float, one zip block a scanline (ZIPS)."""
    def attribute(name, kind, data):
        return name + b"\0" + kind + b"\0" + struct.pack("<I", len(data)) + data

    channels = b"".join(c + b"\0" + struct.pack("<iB3xii", 2, 0, 1, 1) for c in (b"B", b"G", b"R"))
    box = struct.pack("<4i", 0, 0, width - 1, height - 1)
    header = struct.pack("<II", 20000630, 2)
    header += attribute(b"channels", b"chlist", channels + b"\0")
    header += attribute(b"compression", b"compression", b"\x02")
    header += attribute(b"dataWindow", b"box2i", box) + attribute(b"displayWindow", b"box2i", box)
    header += attribute(b"lineOrder", b"lineOrder", b"\0")
    header += attribute(b"pixelAspectRatio", b"float", struct.pack("<f", 1))
    header += attribute(b"screenWindowCenter", b"v2f", struct.pack("<ff", 0, 0))
    header += attribute(b"screenWindowWidth", b"float", struct.pack("<f", 1)) + b"\0"

    blocks = []
    for y in range(height):
        row = [radiance(x, y) for x in range(width)]
        raw = b"".join(struct.pack("<%df" % width, *(t[c] for t in row)) for c in (2, 1, 0))
        mixed = raw[0::2] + raw[1::2]  # bytes in two halves, then differences
        delta = bytes([mixed[0]]) + bytes(
            (mixed[i] - mixed[i - 1] + 128) & 255 for i in range(1, len(mixed)))
        packed = zlib.compress(delta, 9)
        packed = packed if len(packed) < len(raw) else raw
        blocks.append(struct.pack("<iI", y, len(packed)) + packed)
    offsets, at = b"", len(header) + 8 * height
    for block in blocks:
        offsets += struct.pack("<Q", at)
        at += len(block)
    path.write_bytes(header + offsets + b"".join(blocks))


def direction(x, y, width, height):
    """Of a texel's middle: the picture's middle is -z, its top +y."""
    phi = ((x + 0.5) / width - 0.5) * 2 * math.pi
    theta = (y + 0.5) / height * math.pi
    return (math.sin(phi) * math.sin(theta), math.cos(theta), -math.cos(phi) * math.sin(theta))


def noise(x, y):
    """A fixed value in [0, 1) for each pair of whole numbers."""
    bits = (x * 374761393 + y * 668265263) & 0xffffffff
    bits = ((bits ^ (bits >> 13)) * 1274126177) & 0xffffffff
    return ((bits ^ (bits >> 16)) & 0xffff) / 65536


def tiles(x, y):
    """Two by two floor tiles with grout between them."""
    if x % 64 < 2 or y % 64 < 2:
        return (120, 116, 110)
    light = (x // 64 + y // 64) % 2 == 0
    grain = 8 * noise(x // 4, y // 4)
    return tuple(c + grain for c in ((222, 214, 198) if light else (110, 62, 48)))


LETTER = ("........", ".######.", ".#......", ".####...", ".#......", ".#......", ".#......", "........")


def letter(x, y):
    """An F, so that a mirrored or turned picture shows."""
    return (240, 190, 40) if LETTER[y][x] == "#" else (30, 60, 130)


def brick_height(x, y):
    row = (y // 32) % 4
    u, v = (x + 32 * (row % 2)) % 64, y % 32
    edge = min(u, 63 - u, v, 31 - v)
    return min(edge, 5) / 5 * 2.5


def brick_normal(x, y):
    """Tangent space, green up; heights in texels."""
    dx = brick_height((x + 1) % 128, y) - brick_height((x - 1) % 128, y)
    dy = brick_height(x, (y + 1) % 128) - brick_height(x, (y - 1) % 128)
    n = (-dx / 2, dy / 2, 1)
    length = math.sqrt(sum(c * c for c in n))
    return tuple(127.5 + 127.5 * c / length for c in n)


def leaf(x, y):
    """A leaf with a stem on nothing; alpha falls off over two texels."""
    u, v = (x + 0.5) / 32 - 1, 1 - (y + 0.5) / 32
    blade = 0.62 * math.sqrt(max(0, 1 - v * v)) * (1 - 0.45 * v) - abs(u)
    stem = 0.05 - abs(u) if v < -0.6 else -1
    vein = abs(abs(u) - 0.35 * ((v * 3) % 1)) < 0.03 or abs(u) < 0.03
    alpha = min(1, max(0, 16 * max(blade, stem) + 0.5))
    color = (150, 190, 90) if vein else (70, 130, 40)
    return color + (255 * alpha,)


def scratches(x, y):
    """Roughness in green, metal everywhere: polished squares on brushed metal."""
    polished = (x // 16 + y // 16) % 2 == 0
    return (255, 40 if polished else 120 + 50 * noise(0, y), 255)


def sky(x, y):
    """A clear evening: blue above, warm at the horizon, a low sun, dark ground."""
    d = direction(x, y, 128, 64)
    sun = (0.55, 0.42, 0.72)
    cosine = sum(a * b for a, b in zip(d, sun)) / math.sqrt(sum(c * c for c in sun))
    if cosine > math.cos(math.radians(5)):
        return (190, 150, 100)
    if d[1] < 0:
        return tuple(c * (1 + d[1]) + 0.04 for c in (0.24, 0.2, 0.16))
    glow = 0.5 * max(0, cosine) ** 8
    t = d[1] ** 0.5
    low, high = (0.95, 0.78, 0.6), (0.16, 0.3, 0.62)
    return tuple((1 - t) * a + t * b + glow * g for a, b, g in zip(low, high, (1, 0.7, 0.4)))


def linear_sky(x, y):
    """1 + 0.8 y, averaged over the texel's row by solid angle: its SH1 is exact at any size."""
    top, bottom = math.cos(math.pi * y / 32), math.cos(math.pi * (y + 1) / 32)
    value = 1 + 0.8 * 0.5 * (top + bottom)
    return (value, value, value)


# ---------------------------------------------------------------- models

class Glb:
    """A glTF document and its one buffer."""

    KINDS = {"f": 5126, "H": 5123, "B": 5121}

    def __init__(self):
        self.bytes = b""
        self.document = {"asset": {"version": "2.0", "generator": "make_scene_files.py"}, "scene": 0,
                         "bufferViews": [], "accessors": []}

    def add(self, rows, kind, shape, bounds=False):
        self.bytes += b"\0" * (-len(self.bytes) % 4)
        flat = [v for row in rows for v in (row if isinstance(row, (tuple, list)) else (row,))]
        data = struct.pack("<%d%s" % (len(flat), kind), *flat)
        self.document["bufferViews"].append(
            {"buffer": 0, "byteOffset": len(self.bytes), "byteLength": len(data)})
        self.bytes += data
        accessor = {"bufferView": len(self.document["bufferViews"]) - 1,
                    "componentType": self.KINDS[kind], "count": len(rows), "type": shape}
        if bounds:
            columns = list(zip(*[r if isinstance(r, (tuple, list)) else (r,) for r in rows]))
            rounded = [[struct.unpack("<f", struct.pack("<f", v))[0] for v in c] for c in columns]
            accessor["min"] = [min(c) for c in rounded]
            accessor["max"] = [max(c) for c in rounded]
        self.document["accessors"].append(accessor)
        return len(self.document["accessors"]) - 1

    def write(self, path):
        binary = self.bytes + b"\0" * (-len(self.bytes) % 4)
        self.document["buffers"] = [{"byteLength": len(self.bytes)}]
        text = json.dumps(self.document, separators=(",", ":")).encode()
        text += b" " * (-len(text) % 4)
        path.write_bytes(struct.pack("<III", 0x46546C67, 2, 28 + len(text) + len(binary))
                         + struct.pack("<II", len(text), 0x4E4F534A) + text
                         + struct.pack("<II", len(binary), 0x004E4942) + binary)


def about_z(degrees):
    half = math.radians(degrees) / 2
    return (0, 0, math.sin(half), math.cos(half))


def tube(rings, sides, radius_of, height):
    """Positions, normals and triangles of a closed tube along y."""
    positions, normals, triangles = [], [], []
    for ring in range(rings + 1):
        y, r = height * ring / rings, radius_of(ring / rings)
        for side in range(sides):
            phi = 2 * math.pi * side / sides
            positions.append((r * math.cos(phi), y, r * math.sin(phi)))
            normals.append((math.cos(phi), 0, math.sin(phi)))
            if ring:
                a, b = (ring - 1) * sides + side, (ring - 1) * sides + (side + 1) % sides
                triangles += [a, a + sides, b, b, a + sides, b + sides]
    top = len(positions) - sides
    for side in range(1, sides - 1):
        triangles += [top, top + side + 1, top + side]
    return positions, normals, triangles


def write_arm(path):
    """A bending arm: 3 joints, 2 s a loop."""
    glb = Glb()
    positions, normals, triangles = tube(12, 10, lambda t: 0.28 - 0.14 * t, 1.8)
    joints, weights = [], []
    for _, y, _ in positions:
        at = min(max(y / 0.6 - 0.5, 0), 2)  # a joint each 0.6, blended half way between
        low = min(int(at), 1)
        joints.append((low, low + 1, 0, 0))
        weights.append((1 - (at - low), at - low, 0, 0))
    attributes = {"POSITION": glb.add(positions, "f", "VEC3", True),
                  "NORMAL": glb.add(normals, "f", "VEC3"),
                  "JOINTS_0": glb.add(joints, "B", "VEC4"), "WEIGHTS_0": glb.add(weights, "f", "VEC4")}
    inverse = [(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -0.6 * i, 0, 1) for i in range(3)]
    times = glb.add([0, 0.5, 1.5, 2], "f", "SCALAR", True)
    swings = [glb.add([about_z(a) for a in (0, angle, -angle, 0)], "f", "VEC4") for angle in (12, 35, 45)]
    glb.document |= {
        "scenes": [{"nodes": [0, 1]}],
        "nodes": [{"name": "arm", "mesh": 0, "skin": 0},
                  {"name": "shoulder", "children": [2]},
                  {"name": "elbow", "translation": [0, 0.6, 0], "children": [3]},
                  {"name": "wrist", "translation": [0, 0.6, 0]}],
        "materials": [{"name": "clay", "pbrMetallicRoughness":
                       {"baseColorFactor": [0.7, 0.35, 0.2, 1], "metallicFactor": 0}}],
        "meshes": [{"name": "arm", "primitives": [
            {"attributes": attributes, "indices": glb.add(triangles, "H", "SCALAR"), "material": 0}]}],
        "skins": [{"joints": [1, 2, 3], "inverseBindMatrices": glb.add(inverse, "f", "MAT4")}],
        "animations": [{"name": "wave",
                        "samplers": [{"input": times, "output": swing} for swing in swings],
                        "channels": [{"sampler": i, "target": {"node": i + 1, "path": "rotation"}}
                                     for i in range(3)]}]}
    glb.write(path)


def write_ball(path):
    """A ball that becomes a cushion and back: one morph target, 2 s a loop."""
    glb = Glb()
    rings, sides = 10, 16
    normals, triangles = [], []
    for ring in range(rings + 1):
        theta = math.pi * ring / rings
        for side in range(sides):
            phi = 2 * math.pi * side / sides
            normals.append((math.sin(theta) * math.cos(phi), math.cos(theta), math.sin(theta) * math.sin(phi)))
            if ring:
                a, b = (ring - 1) * sides + side, (ring - 1) * sides + (side + 1) % sides
                if ring > 1:
                    triangles += [a, b, a + sides]
                if ring < rings:
                    triangles += [b, b + sides, a + sides]
    positions = [(0.6 * x, 0.6 * y, 0.6 * z) for x, y, z in normals]
    squashed = [(0.45 * x, -0.33 * y, 0.45 * z) for x, y, z in positions]
    turned = []
    for (x, y, z) in normals:  # a normal's transform is the inverse of the position's
        n = (x / 1.45, y / 0.67, z / 1.45)
        length = math.sqrt(sum(c * c for c in n))
        turned.append(tuple(a / length - b for a, b in zip(n, (x, y, z))))
    attributes = {"POSITION": glb.add(positions, "f", "VEC3", True), "NORMAL": glb.add(normals, "f", "VEC3")}
    target = {"POSITION": glb.add(squashed, "f", "VEC3", True), "NORMAL": glb.add(turned, "f", "VEC3")}
    times = glb.add([0, 1, 2], "f", "SCALAR", True)
    weights = glb.add([0, 1, 0], "f", "SCALAR")
    glb.document |= {
        "scenes": [{"nodes": [0]}],
        "nodes": [{"name": "ball", "mesh": 0}],
        "materials": [{"name": "rubber", "pbrMetallicRoughness":
                       {"baseColorFactor": [0.2, 0.4, 0.7, 1], "metallicFactor": 0}}],
        "meshes": [{"name": "ball", "weights": [0], "primitives": [
            {"attributes": attributes, "targets": [target],
             "indices": glb.add(triangles, "H", "SCALAR"), "material": 0}]}],
        "animations": [{"name": "squash", "samplers": [{"input": times, "output": weights}],
                        "channels": [{"sampler": 0, "target": {"node": 0, "path": "weights"}}]}]}
    glb.write(path)


# ---------------------------------------------------------------- a scene

def write_many_lights(path):
    """A grid of small lamps in three colours over a floor with posts."""
    lamps = []
    for row in range(12):
        for column in range(12):
            color = ("amber lamp", "green lamp", "blue lamp")[int(3 * noise(row, column))]
            x, z = -5.5 + column, -5.5 + row
            lamps.append({"name": "lamp %d.%d" % (row, column), "material": color, "quad": {
                "corner": [x - 0.05, 1.2, z - 0.05], "edge_u": [0.1, 0, 0], "edge_v": [0, 0, 0.1]}})
    posts = [{"name": "post %d" % i, "material": "white", "box": {
        "lower": [round(x - 0.1, 3), 0, round(z - 0.1, 3)], "upper": [round(x + 0.1, 3), 0.8, round(z + 0.1, 3)]}}
        for i, (x, z) in enumerate([(-3, -3), (3, -3), (-3, 3), (3, 3), (0, 0)])]
    lines = [json.dumps(o) for o in lamps + posts + [{"name": "floor", "material": "white", "quad": {
        "corner": [-7, 0, 7], "edge_u": [14, 0, 0], "edge_v": [0, 0, -14]}}]]
    path.write_text("""{
  "$schema": "schema/farlight-scene.schema.json",
  "version": 1,
  "name": "Many lights",
  "description": "144 small lamps, each of which lights its own patch of the floor. Written by tools/make_scene_files.py.",
  "materials": {
    "white": { "albedo": [0.75, 0.75, 0.75] },
    "amber lamp": { "albedo": [0, 0, 0], "emission": [36, 20.4, 6], "emits_both_sides": true },
    "green lamp": { "albedo": [0, 0, 0], "emission": [7.2, 30, 12], "emits_both_sides": true },
    "blue lamp": { "albedo": [0, 0, 0], "emission": [8.4, 14.4, 42], "emits_both_sides": true }
  },
  "objects": [
    %s
  ],
  "camera": { "position": [0, 2.6, 9], "target": [0, 0.5, 0], "vertical_fov_degrees": 45 }
}
""" % ",\n    ".join(lines))


def main():
    folder = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else pathlib.Path(__file__).parent.parent / "scenes"
    write_png(folder / "tiles.png", 128, 128, tiles)
    write_png(folder / "letter.png", 8, 8, letter)
    write_png(folder / "brick_normal.png", 128, 128, brick_normal)
    write_png(folder / "leaf.png", 64, 64, leaf)
    write_png(folder / "scratches.png", 64, 64, scratches)
    write_hdr(folder / "evening.hdr", 128, 64, sky)
    write_exr(folder / "linear_sky.exr", 8, 32, linear_sky)
    write_arm(folder / "bending_arm.glb")
    write_ball(folder / "squashed_ball.glb")
    write_many_lights(folder / "many_lights.json")


main()
