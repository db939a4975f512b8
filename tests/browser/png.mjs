// A small PNG from a function of x and y, with node's own zlib.
import { deflateSync } from "node:zlib";

/** CRC-32 as in the PNG specification, annex D; node's zlib has one from version 22 on. */
function crc32(bytes) {
    let crc = ~0;
    for (const byte of bytes) {
        crc ^= byte;
        for (let bit = 0; bit < 8; ++bit)
            crc = (crc >>> 1) ^ (crc & 1 ? 0xedb88320 : 0);
    }
    return ~crc >>> 0;
}

function chunk(type, body) {
    const typed = Buffer.concat([Buffer.from(type, "latin1"), body]);
    const framed = Buffer.alloc(typed.length + 8);
    framed.writeUInt32BE(body.length, 0);
    typed.copy(framed, 4);
    framed.writeUInt32BE(crc32(typed), typed.length + 4);
    return framed;
}

/** 8-bit RGB; `colour(x, y)` gives [r, g, b]. */
export function png(width, height, colour) {
    const rows = Buffer.alloc(height * (1 + 3 * width)); // each row begins with filter 0
    for (let y = 0; y < height; ++y)
        for (let x = 0; x < width; ++x)
            rows.set(colour(x, y), y * (1 + 3 * width) + 1 + 3 * x);
    const header = Buffer.alloc(13);
    header.writeUInt32BE(width, 0);
    header.writeUInt32BE(height, 4);
    header.set([8, 2, 0, 0, 0], 8); // 8 bits, RGB, deflate, no filter method, not interlaced
    return Buffer.concat([Buffer.from("\x89PNG\r\n\x1a\n", "latin1"), chunk("IHDR", header), chunk("IDAT", deflateSync(rows)), chunk("IEND", Buffer.alloc(0))]);
}
