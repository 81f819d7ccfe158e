// Writes PNG files with 1 bit per pixel, using the engine's deflate compression.
import type { Raster } from "./tools.js";

const kSignature = [137, 80, 78, 71, 13, 10, 26, 10];

/** Lookup table for the PNG checksum, indexed by byte. */
const kCrcTable = Uint32Array.from({ length: 256 }, (_, byte) => {
    let crc = byte;
    for (let bit = 0; bit < 8; ++bit) crc = crc & 1 ? 0xedb88320 ^ (crc >>> 1) : crc >>> 1;
    return crc;
});

function crcOf(bytes: Uint8Array): number {
    let crc = ~0;
    for (const byte of bytes) crc = kCrcTable[(crc ^ byte) & 255]! ^ (crc >>> 8);
    return ~crc;
}

function chunk(type: string, data: Uint8Array): Uint8Array<ArrayBuffer> {
    const bytes = new Uint8Array(12 + data.length);
    const view = new DataView(bytes.buffer);
    view.setUint32(0, data.length);
    bytes.set(new TextEncoder().encode(type), 4);
    bytes.set(data, 8);
    view.setUint32(8 + data.length, crcOf(bytes.subarray(4, 8 + data.length)));
    return bytes;
}

function header({ width_px, height_px }: Raster): Uint8Array {
    const bytes = new Uint8Array(13);
    const view = new DataView(bytes.buffer);
    view.setUint32(0, width_px);
    view.setUint32(4, height_px);
    bytes[8] = 1; // 1 bit per pixel; zeros: grey, deflate, filter type per row, no interlacing
    return bytes;
}

/**
 * Returns the contents of the pHYs chunk: the resolution in pixels per metre. Programs use it to
 * determine the true size of the page.
 */
function size(dpi: number): Uint8Array {
    const bytes = new Uint8Array(9);
    const view = new DataView(bytes.buffer);
    const per_metre = Math.round((dpi * 1000) / 25.4);
    view.setUint32(0, per_metre);
    view.setUint32(4, per_metre);
    bytes[8] = 1; // unit: metre
    return bytes;
}

/**
 * Returns the rows in PNG format: each row is a filter type byte (0, no filter), followed by the
 * pixels. A 0 bit is a black pixel.
 */
function scanlines({ width_px, height_px, bits }: Raster): Uint8Array<ArrayBuffer> {
    const stride = Math.ceil(width_px / 8);
    const lines = new Uint8Array((stride + 1) * height_px);
    for (let v = 0; v < height_px; ++v)
        for (let i = 0; i < stride; ++i) lines[v * (stride + 1) + 1 + i] = ~bits[v * stride + i]!;
    return lines;
}

async function deflate(bytes: Uint8Array<ArrayBuffer>): Promise<Uint8Array> {
    const stream = new Blob([bytes]).stream().pipeThrough(new CompressionStream("deflate"));
    return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** Returns the raster as a PNG file. */
export async function pngOf(raster: Raster): Promise<Uint8Array<ArrayBuffer>> {
    const parts = [
        Uint8Array.from(kSignature),
        chunk("IHDR", header(raster)),
        chunk("pHYs", size(raster.dpi)),
        chunk("IDAT", await deflate(scanlines(raster))),
        chunk("IEND", new Uint8Array(0)),
    ];
    return new Uint8Array(await new Blob(parts).arrayBuffer());
}
