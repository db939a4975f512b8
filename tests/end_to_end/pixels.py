# Pixels without the server's libraries: XXH64 and PNG from their published descriptions.
import struct
import zlib

MASK = (1 << 64) - 1
PRIME_1, PRIME_2, PRIME_3, PRIME_4, PRIME_5 = (
    11400714785074694791,
    14029467366897019727,
    1609587929392839161,
    9650029242287828579,
    2870177450012600261,
)


def _rotate(value, bits):
    return ((value << bits) | (value >> (64 - bits))) & MASK


def _round(accumulator, lane):
    return (_rotate((accumulator + lane * PRIME_2) & MASK, 31) * PRIME_1) & MASK


def xxh64(data):
    """XXH64 with seed 0, after the xxHash specification."""
    at = 0
    if len(data) >= 32:
        lanes = [(PRIME_1 + PRIME_2) & MASK, PRIME_2, 0, (-PRIME_1) & MASK]
        while at + 32 <= len(data):
            for i, lane in enumerate(struct.unpack_from("<4Q", data, at)):
                lanes[i] = _round(lanes[i], lane)
            at += 32
        digest = sum(_rotate(lane, bits) for lane, bits in zip(lanes, (1, 7, 12, 18))) & MASK
        for lane in lanes:
            digest = ((digest ^ _round(0, lane)) * PRIME_1 + PRIME_4) & MASK
    else:
        digest = PRIME_5
    digest = (digest + len(data)) & MASK
    while at + 8 <= len(data):
        digest ^= _round(0, struct.unpack_from("<Q", data, at)[0])
        digest = (_rotate(digest, 27) * PRIME_1 + PRIME_4) & MASK
        at += 8
    if at + 4 <= len(data):
        digest ^= struct.unpack_from("<I", data, at)[0] * PRIME_1 & MASK
        digest = (_rotate(digest, 23) * PRIME_2 + PRIME_3) & MASK
        at += 4
    for byte in data[at:]:
        digest ^= byte * PRIME_5 & MASK
        digest = _rotate(digest, 11) * PRIME_1 & MASK
    for shift, prime in ((33, PRIME_2), (29, PRIME_3), (32, 1)):
        digest = ((digest ^ (digest >> shift)) * prime) & MASK
    return digest


def _paeth(left, above, corner):
    estimate = left + above - corner
    distances = abs(estimate - left), abs(estimate - above), abs(estimate - corner)
    return (left, above, corner)[distances.index(min(distances))]


def decode_png(data):
    """(width, height, RGB bytes, rows top down) of an 8-bit RGB PNG that is not interlaced."""
    assert data[:8] == b"\x89PNG\r\n\x1a\n", "not a PNG"
    at, packed, head = 8, b"", None
    while at < len(data):
        length, kind = struct.unpack_from(">I4s", data, at)
        body = data[at + 8 : at + 8 + length]
        expected = struct.unpack_from(">I", data, at + 8 + length)[0]
        assert zlib.crc32(kind + body) == expected, "bad CRC"
        if kind == b"IHDR":
            head = struct.unpack(">IIBBBBB", body)
        elif kind == b"IDAT":
            packed += body
        at += 12 + length
    width, height = head[:2]
    assert head[2:] == (8, 2, 0, 0, 0), head
    rows, stride = zlib.decompress(packed), width * 3
    pixels, above = bytearray(), bytearray(stride)
    for y in range(height):
        kind = rows[y * (stride + 1)]
        row = bytearray(rows[y * (stride + 1) + 1 : (y + 1) * (stride + 1)])
        for x in range(stride):
            left = row[x - 3] if x >= 3 else 0
            corner = above[x - 3] if x >= 3 else 0
            mean = (left + above[x]) // 2
            predictions = (0, left, above[x], mean, _paeth(left, above[x], corner))
            row[x] = (row[x] + predictions[kind]) & 255
        pixels += row
        above = row
    return width, height, bytes(pixels)
