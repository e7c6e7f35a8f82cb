// Radiance to display colors: exposure and a tone curve, luminance in false color on a log scale, or the error of luminance.

const displaySteps = 1 << 14;
const encoded = Uint8ClampedArray.from({ length: displaySteps + 1 }, (_, i) => {
    const linear = i / displaySteps;
    return 255 * (linear <= 0.0031308 ? 12.92 * linear : 1.055 * linear ** (1 / 2.4) - 0.055);
});
const toByte = (linear) => encoded[Math.round(displaySteps * Math.min(1, Math.max(0, linear)))];

// Khronos PBR Neutral, as framework/image/tone.h has it.
const fresnel = 0.04, start = 0.8 - fresnel, desaturation = 0.15;
function pbrNeutral(color) {
    for (let c = 0; c < 3; ++c) color[c] = Math.max(0, color[c]);
    const x = Math.min(color[0], color[1], color[2]);
    const offset = x <= 2 * fresnel ? x - (x * x) / (4 * fresnel) : fresnel;
    const peak = Math.max(color[0], color[1], color[2]) - offset;
    const newPeak = peak <= start ? peak : 1 - (1 - start) ** 2 / (peak + 1 - 2 * start);
    const saturation = 1 / (desaturation * (peak - newPeak) + 1), scale = peak > 0 ? newPeak / peak : 1;
    for (let c = 0; c < 3; ++c) color[c] = (color[c] - offset) * scale * saturation + newPeak * (1 - saturation);
}

// Colors from 0 to 1 that a legend of the toolbar names.
function rampOf(selector) {
    const { colors, low, high } = document.querySelector(selector).dataset;
    const knots = colors.split(", ");
    const between = d3.scaleLinear(d3.range(knots.length).map((i) => i / (knots.length - 1)), knots);
    const table = d3.range(256).map((i) => Object.values(d3.rgb(between(i / 255))).slice(0, 3));
    return { low: Number(low), high: Number(high), colorOf: (value) => table[Math.round(255 * Math.min(1, Math.max(0, value))) || 0] };
}
const luminanceRamp = rampOf(".only-luminance i"), errorRamp = rampOf(".only-error i");

// (a - b) / (a + b) is 0 where a is right, -1 where it is black and 1 where it is infinitely brighter. The root spreads small errors.
function errorOf(a, b) {
    const relative = a === b ? 0 : (a - b) / (Math.abs(a) + Math.abs(b));
    return Math.sign(relative) * Math.sqrt(Math.abs(relative));
}
function falseColor(colorAt) {
    return (color, i) => colorAt(i).forEach((channel, c) => { color[c] = channel; });
}
// Returns a function that writes a pixel's color as bytes.
function shader(pixels, reference) {
    if (reference) {
        const rightAt = (i) => luminanceAt(reference, indexIn(reference, pixels, i));
        return falseColor((i) => errorRamp.colorOf(0.5 + 0.5 * errorOf(luminanceAt(pixels, i), rightAt(i))));
    }
    if (state.colors === "luminance") {
        const { low, high } = luminanceRamp;
        return falseColor((i) => luminanceRamp.colorOf((Math.log10(Math.max(1e-30, luminanceAt(pixels, i))) - low) / (high - low)));
    }
    const { data: planes, isExact } = pixels, count = planes.length / 3, scale = 2 ** (configStops + Number(state.exposure));
    const isNeutral = state.colors === "pbr_neutral" && isExact; // previews have their curve
    return (color, i) => {
        for (let c = 0; c < 3; ++c) color[c] = scale * planes[c * count + i];
        if (isNeutral) pbrNeutral(color);
        for (let c = 0; c < 3; ++c) color[c] = toByte(color[c]);
    };
}

// An image of what the page's state says of pixels; with a reference the error against it.
function shade(pixels, reference) {
    const image = new ImageData(pixels.width, pixels.height), color = [0, 0, 0], write = shader(pixels, reference);
    const bytes = image.data.fill(255);
    for (let i = 0; i < bytes.length / 4; ++i) {
        write(color, i);
        for (let c = 0; c < 3; ++c) bytes[4 * i + c] = color[c];
    }
    return image;
}
