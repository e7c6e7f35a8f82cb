// The radiance of images: R, G, B in planes of 32-bit floats, from half floats (images.py) or, without them, from previews.

const configStops = Number(root.dataset.stops) || 0;
const knownPixels = new Map(), maxKnown = 32; // by image, those used last at the end

const ofHalf = Float32Array.from({ length: 1 << 16 }, (_, bits) => {
    const exponent = (bits >> 10) & 31, fraction = (bits & 1023) / 1024;
    const finite = exponent ? (1 + fraction) * 2 ** (exponent - 15) : fraction * 2 ** -14;
    return (bits >> 15 ? -1 : 1) * (exponent < 31 ? finite : fraction ? NaN : Infinity);
});
const toLinear = Float32Array.from({ length: 256 }, (_, byte) => {
    const display = byte / 255;
    return 2 ** -configStops * (display <= 0.04045 ? display / 12.92 : ((display + 0.055) / 1.055) ** 2.4);
});

async function fromHalfFloats(text) {
    const packed = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
    const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"));
    const bytes = new Uint8Array(await new Response(stream).arrayBuffer());
    const values = new Float32Array(bytes.length / 2);
    for (let i = 0, bits = 0; i < values.length; ++i) {
        const zigzag = (bytes[i] << 8) | bytes[values.length + i];
        bits = (bits + ((zigzag >> 1) ^ -(zigzag & 1))) & 0xffff;
        values[i] = ofHalf[bits];
    }
    return values;
}
async function fromPreview(image, width, height) {
    await image.decode();
    const context = element("canvas", { width, height }).getContext("2d");
    context.drawImage(image, 0, 0);
    const bytes = context.getImageData(0, 0, width, height).data, count = width * height;
    return Float32Array.from({ length: 3 * count }, (_, i) => toLinear[bytes[4 * (i % count) + Math.floor(i / count)]]);
}
async function readPixels(image) {
    const width = Number(image.getAttribute("width")), height = Number(image.getAttribute("height"));
    const isExact = Boolean(image.dataset.floats) && "DecompressionStream" in window;
    return { width, height, isExact, data: await (isExact ? fromHalfFloats(image.dataset.floats) : fromPreview(image, width, height)) };
}

// A promise of an image's pixels; previews are clipped and have 8 bits, so that theirs are not exact.
function pixelsOf(image) {
    const pixels = knownPixels.get(image) ?? readPixels(image);
    knownPixels.delete(image);
    knownPixels.set(image, pixels); // last
    if (knownPixels.size > maxKnown) knownPixels.delete(knownPixels.keys().next().value);
    return pixels;
}
// The index of the pixel of `other` where that of index `i` in `pixels` is.
function indexIn(other, pixels, i) {
    const row = Math.floor(((Math.floor(i / pixels.width) + 0.5) / pixels.height) * other.height);
    return row * other.width + Math.floor((((i % pixels.width) + 0.5) / pixels.width) * other.width);
}
function luminanceAt({ data: planes }, i) {
    const count = planes.length / 3;
    return 0.2126 * planes[i] + 0.7152 * planes[count + i] + 0.0722 * planes[2 * count + i];
}
