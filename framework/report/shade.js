"use strict";
// Radiance to display colors: exposure and a tone curve, luminance in false color on a log scale, or the error of luminance.
(() => {
    const { state } = page;
    const stops = Number(document.documentElement.dataset.stops) || 0;
    const steps = 1 << 14;
    const encoded = Uint8ClampedArray.from({ length: steps + 1 }, (_, i) =>
        255 * (i / steps <= 0.0031308 ? (12.92 * i) / steps : 1.055 * (i / steps) ** (1 / 2.4) - 0.055));
    const toByte = (linear) => encoded[Math.round(steps * Math.min(1, Math.max(0, linear)))];

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
        const knots = colors.split(", ").map((hex) => [1, 3, 5].map((start) => parseInt(hex.slice(start, start + 2), 16)));
        const table = Array.from({ length: 256 }, (_, i) => {
            const position = (i / 255) * (knots.length - 1), before = Math.min(knots.length - 2, Math.floor(position));
            return knots[before].map((channel, c) => channel + (position - before) * (knots[before + 1][c] - channel));
        });
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
            const rightAt = (i) => page.luminanceAt(reference, page.indexIn(reference, pixels, i));
            return falseColor((i) => errorRamp.colorOf(0.5 + 0.5 * errorOf(page.luminanceAt(pixels, i), rightAt(i))));
        }
        if (state.colors === "luminance") {
            const { low, high } = luminanceRamp;
            return falseColor((i) => luminanceRamp.colorOf((Math.log10(Math.max(1e-30, page.luminanceAt(pixels, i))) - low) / (high - low)));
        }
        const { data, isExact } = pixels, count = data.length / 3, scale = 2 ** (stops + Number(state.exposure));
        const isNeutral = state.colors === "pbr_neutral" && isExact; // previews have their curve
        return (color, i) => {
            for (let c = 0; c < 3; ++c) color[c] = scale * data[c * count + i];
            if (isNeutral) pbrNeutral(color);
            for (let c = 0; c < 3; ++c) color[c] = toByte(color[c]);
        };
    }

    // An image of what the page's state says of pixels; with a reference the error against it.
    page.shade = (pixels, reference) => {
        const image = new ImageData(pixels.width, pixels.height), color = [0, 0, 0];
        const write = shader(pixels, reference), { data } = image;
        for (let i = 0, byte = 0; byte < data.length; ++i, byte += 4) {
            write(color, i);
            data[byte] = color[0];
            data[byte + 1] = color[1];
            data[byte + 2] = color[2];
            data[byte + 3] = 255;
        }
        return image;
    };
})();
